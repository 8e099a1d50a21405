/// The shipped catalogue, its schema, and that loading is all or nothing.
#include "data/catalogue/catalogue.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/model/rod.h"
#include "data/catalogue/instrument/instrument_keys.h"
#include "data/catalogue/instrument/instrument_picture.h"
#include "data/catalogue/instrument/instrument_report.h"
#include "data/formats/write_file.h"
#include "tests/data/catalogue/instrument_files.h"
#include "tests/data/refusals.h"

namespace ostium::data {
namespace {

namespace fs = std::filesystem;

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / ("ostium-catalogue-" + std::to_string(getpid()))) {
    fs::create_directories(path_ / "instruments");
  }
  ~Folder() { fs::remove_all(path_); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / "instruments" / name) << text;
  }
  std::string data() const { return path_.string(); }
  std::string instruments() const { return (path_ / "instruments").string(); }

 private:
  fs::path path_;
};

std::string message(const std::string& folder) {
  try {
    load_catalogue(folder);
  } catch (const LoadError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Catalogue, HoldsTheStudysNineAndWhatCoronaryWorkNeeds) {
  const std::vector<Instrument> all = load_catalogue();
  for (const char* name : {"amplatz-super-stiff",
                           "cook-straight",
                           "bentson",
                           "terumo-stiff-angled",
                           "cook-j",
                           "rosen",
                           "beacon-tip-5f",
                           "terumo-4f",
                           "terumo-5f",
                           "sheath-6f",
                           "j-wire-035-150",
                           "j-wire-035-260",
                           "guide-jr4-6f",
                           "guide-jl4-6f",
                           "guide-jl35-6f",
                           "guide-ebu35-6f",
                           "guide-al1-6f",
                           "diagnostic-jl4-5f",
                           "diagnostic-jr4-5f",
                           "wire-014-workhorse",
                           "wire-014-workhorse-wide",
                           "wire-014-support",
                           "wire-014-polymer-jacket",
                           "balloon-15x10",
                           "balloon-20x10",
                           "balloon-25x15",
                           "stent-20x12",
                           "stent-30x18"})
    EXPECT_NO_THROW(find_instrument(all, name));
  try {
    find_instrument(all, "guide-jl9");
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("guide-jl4-6f"), std::string::npos) << error.what();
  }
}

TEST(Catalogue, PublishedStiffnessIsUsedWhereThereIsOne) {
  // Harrison 2011: 60.3 GPa over a section of 0.889 mm, I = 0.03066 mm^4, so 1849 N mm2; three digits in the file.
  const std::vector<Instrument> all = load_catalogue();
  EXPECT_NEAR(find_instrument(all, "amplatz-super-stiff").sections.back().EI1_N_m2 * 1e6, 60.3e3 * 0.03066, 2);
}

TEST(Catalogue, EveryInstrumentIsARodForCore) {
  for (const Instrument& i : load_catalogue()) {
    SCOPED_TRACE(i.name);
    const int millimetres = static_cast<int>(std::lround(1e3 * i.length_m));  // elements as short as a J tip needs
    const core::Rod rod = core::make_rod(rod_description(i, equal_elements(i.sections, millimetres)));
    EXPECT_NEAR(rod.total_length_m, i.length_m, 1e-9);
    EXPECT_GE(i.sources.size(), 3u);
    // Tips are softer than shafts, except the plain tube of a sheath.
    if (i.kind != InstrumentKind::sheath) {
      EXPECT_LT(i.sections.front().EI1_N_m2, 0.5 * i.sections.back().EI1_N_m2);
    }
    EXPECT_EQ(i.shapeable_tip.has_value(), i.name.rfind("wire-014", 0) == 0);
    EXPECT_EQ(i.wire_lumen.has_value(), i.name.rfind("balloon", 0) == 0 || i.name.rfind("stent", 0) == 0);
    EXPECT_NE(instrument_details(i).find(i.sources.front().citation), std::string::npos);
  }
}

TEST(Catalogue, IsAllOrNothing) {
  const Folder folder;
  EXPECT_NE(message(folder.instruments()).find("no instrument file"), std::string::npos);
  EXPECT_NE(message(folder.data() + "/nowhere").find("no instrument file"), std::string::npos);
  folder.write("hook.json", small_catheter);
  folder.write("notes.txt", "not an instrument");
  EXPECT_EQ(load_catalogue(folder.instruments()).size(), 1u);
  folder.write("zebra.json",
               with(with(small_catheter, "\"hook\"", "\"zebra\""), "\"EI_Nmm2\": 30", "\"EI_Nmm2\": -30"));
  EXPECT_NE(message(folder.instruments()).find("zebra.json:12: sections.list[0].EI_Nmm2 is -30"), std::string::npos)
      << message(folder.instruments());
  folder.write("apple.json", "{}");  // the first error in the order of names is reported
  EXPECT_NE(message(folder.instruments()).find("apple.json:1:"), std::string::npos) << message(folder.instruments());
}

TEST(Catalogue, AnEnvironmentVariableLeadsElsewhere) {
  const Folder folder;
  folder.write("hook.json", small_catheter);
  const char* before = std::getenv("OSTIUM_DATA");
  const std::string kept = before ? before : "";
  setenv("OSTIUM_DATA", folder.data().c_str(), 1);
  EXPECT_EQ(load_catalogue().size(), 1u);
  setenv("OSTIUM_DATA", (folder.data() + "/nowhere").c_str(), 1);
  EXPECT_THROW(data_folder(), LoadError);
  before ? setenv("OSTIUM_DATA", kept.c_str(), 1) : unsetenv("OSTIUM_DATA");
}

TEST(Catalogue, JsonHasTheSchemasKeys) {
  const auto schema =
      nlohmann::json::parse(std::ifstream(fs::path(data_folder()) / "schemas" / "instruments.schema.json"));
  const auto json = nlohmann::json::parse(to_json(load_catalogue()));
  for (const auto& instrument : json) {
    EXPECT_EQ(instrument.size(), schema["items"]["required"].size());
    for (const auto& key : schema["items"]["required"]) EXPECT_TRUE(instrument.contains(key)) << key;
    for (const auto& key : schema["items"]["properties"]["sections"]["items"]["required"])
      EXPECT_TRUE(instrument["sections"][0].contains(key)) << key;
  }
}

/// Same text, and numbers equal to `tolerance`: another mathematics library may round the last digit differently.
bool alike(const std::string& a, const std::string& b, double tolerance) {
  const char *p = a.c_str(), *q = b.c_str();
  while (*p && *q) {
    char *p_end, *q_end;
    const double x = std::strtod(p, &p_end), y = std::strtod(q, &q_end);
    if (p_end == p || q_end == q) {
      if (*p++ != *q++) return false;
    } else {
      if (std::abs(x - y) > tolerance) return false;
      p = p_end, q = q_end;
    }
  }
  return !*p && !*q;
}

TEST(Catalogue, ThePictureThatIsKeptIsUpToDate) {
  const Folder folder;
  const std::string fresh = folder.data() + "/fresh.svg";
  draw_instruments(load_catalogue(), fresh);
  const auto read = [](const std::string& file) {
    std::ifstream stream(file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_TRUE(alike(read(fresh), read(data_folder() + "/instruments/instruments.svg"), 0.011))
      << "draw it anew: ostium instruments --picture data/instruments/instruments.svg";
  EXPECT_THROW(draw_instruments(load_catalogue(), "/proc/nowhere/x.svg"), WriteError);
}

}  // namespace
}  // namespace ostium::data
