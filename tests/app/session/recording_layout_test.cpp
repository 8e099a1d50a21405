/// What a recording says of itself, and that what it holds is what happened.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>

#include "app/session/run/replay.h"
#include "core/rod/introducer.h"
#include "data/formats/write_file.h"
#include "data/recording/recording.h"
#include "tests/app/session/recorded.h"
#include "tests/data/refusals.h"

namespace ostium::app {
namespace {

/// It differs in how the step's length is written, and in what it does not say.
TEST(Recording, OfVersion2IsRead) {
  const Folder folder;
  const PlayReport report = recorded(folder("run.h5"), RecordMode::full);
  copy_with(folder("run.h5"), folder("older.h5"), "", {}, true);
  EXPECT_NO_THROW(data::read_to_end(folder("older.h5")));
  Replay older(folder("older.h5"), tube_vessel());
  EXPECT_FALSE(verify(older).first_step);
  EXPECT_EQ(hash(older.state), report.hash);
  EXPECT_DOUBLE_EQ(older.recording.step_s(), 1e-3);
}

/// The parser's own words begin with its name and number.
TEST(Recording, ASetupWithAByte0IsRefusedInWords) {
  const Folder folder;
  recorded(folder("run.h5"), RecordMode::full);
  std::string setup = data::RecordingReader(folder("run.h5")).setup();
  EXPECT_NO_THROW(setup_from_json("run.h5", setup));
  setup[setup.find(':')] = '\0';
  try {
    setup_from_json("run.h5", setup);
    FAIL() << "it was read";
  } catch (const data::LoadError& error) {
    const std::string words = error.what();
    EXPECT_TRUE(words.starts_with("run.h5: its setup cannot be read: parse error at line ")) << words;
  }
}

/// Replaying gives the same nodes: those in the body, at the steps and with the lengths that the recording says.
TEST(Recording, HoldsTheNodesOfEachTool) {
  const Folder folder;
  const PlayReport report = recorded(folder("run.h5"), RecordMode::full, tube_setup(), 30);
  EXPECT_EQ(report.hash, recorded(folder("plain.h5"), RecordMode::full).hash);
  EXPECT_NO_THROW(data::read_to_end(folder("run.h5")));
  Replay replay(folder("run.h5"), tube_vessel());
  const data::TableFile& file = replay.recording.tables();
  const std::vector<std::uint64_t> steps = file.integers("shapes_step", 0, file.rows("shapes_step"));
  const std::vector<double> inserted_m = file.numbers("shapes_inserted", 0, steps.size());
  ASSERT_EQ(steps.size(), 1 + replay.recording.steps() / 33);  // 30 Hz are 33 steps
  ASSERT_EQ(replay.recording.tools().size(), replay.model.tools.size());
  for (std::size_t row = 0; row < steps.size(); ++row) {
    ASSERT_EQ(steps[row], 33 * row);
    while (replay.state.rods.step < steps[row]) ASSERT_TRUE(replay.tick());
    for (std::size_t t = 0; t < replay.model.tools.size(); ++t) {
      const core::RodState& rod = replay.state.rods.rods[t];
      const std::string table = data::shape_table(replay.model.tools[t].name);
      const std::vector<double> nodes = file.numbers(table, row, 1);
      const int first = in_body(replay.model.rods.rods[t], rod) ? rod.first : rod.position.size();
      ASSERT_EQ(nodes.size(), 3 * static_cast<std::size_t>(rod.position.size()));
      ASSERT_EQ(inserted_m[row * replay.model.tools.size() + t], rod.inserted_m);
      for (int i = 0; i < rod.position.size(); ++i)
        for (int c = 0; c < 3; ++c) {
          const double number = nodes[3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(c)];
          if (i < first)
            ASSERT_TRUE(std::isnan(number));
          else
            ASSERT_EQ(number, static_cast<float>(rod.position.at(c)[i]));
        }
    }
  }
}

TEST(Recording, SaysWhatItsNumbersAre) {
  const Folder folder;
  recorded(folder("run.h5"), RecordMode::events, tube_setup(), 1000);
  const data::RecordingReader reader(folder("run.h5"));
  const data::TableFile& file = reader.tables();
  EXPECT_DOUBLE_EQ(file.number("step_s"), 1e-3);
  EXPECT_EQ(file.rows("shapes_step"), 1 + reader.steps()) << "of each step";
  EXPECT_EQ(reader.tools(), std::vector<std::string>{"wire"});
  EXPECT_EQ(file.texts("events", "names").at(static_cast<std::size_t>(data::EventCode::tool_in)), "tool_in");
  const std::vector<std::string> steps = file.texts("", "script_steps");
  EXPECT_EQ(steps.at(0), "fluoroscopy");
  EXPECT_NE(std::find(steps.begin(), steps.end(), "mark: there"), steps.end());
  EXPECT_FALSE(file.texts("", "branches").empty());
  const auto unit_of = [&](const char* table, const std::string& column) {
    const std::vector<std::string> columns = file.columns(table), units = file.texts(table, "units");
    const auto at = std::find(columns.begin(), columns.end(), column);
    return at == columns.end() || units.size() != columns.size()
               ? "none"
               : units[static_cast<std::size_t>(at - columns.begin())];
  };
  EXPECT_EQ(unit_of("signals", "wire.push_N"), "N");
  for (const auto& [column, unit] : {std::pair{"wire.advance_m_s", "m/s"},
                                     {"wire.turn_rad_s", "rad/s"},
                                     {"lao_rad", "rad"},
                                     {"isocentre_m[1]", "m"},
                                     {"fluoroscopy", "1"},
                                     {"heart_rate_1_min", "1/min"},
                                     {"injection_m3_s", "m3/s"},
                                     {"iodine_kg_m3", "kg/m3"},
                                     {"gauge_Pa", "Pa"},
                                     {"second_gauge_Pa", "Pa"},
                                     {"heparin_U", "U"},
                                     {"nitrate_ug", "ug"}})
    EXPECT_EQ(unit_of("inputs", column), unit) << column;
}

TEST(TableFile, BringsBackWhatWasWritten) {
  const Folder folder;
  const std::vector<double> rows = {1, 2, 3, 4, -0.0, 1e300};
  const std::vector<std::uint64_t> hashes = {0, ~0ULL};
  {
    data::TableFile file = data::TableFile::create(folder("t.h5"));
    file.add_table({"rows", data::NumberType::float64, {"a_m", "b"}, 2, 2});
    file.add_table({"hashes", data::NumberType::uint64, {}, 1, 4});
    file.append("rows", rows.data(), 2);
    file.append("rows", rows.data() + 4, 1);
    file.append("hashes", hashes.data(), 2);
    file.set_text("note", "first");
    file.set_text("note", "Grüße");
    file.set_text("empty", "");
    file.set_number("pi", 3.25);
    file.add_table(
        {"group/points", data::NumberType::float32, {}, 6, 2, 3, {{"names", std::vector<std::string>{"é", ""}}}});
    const std::vector<float> points = {1, 2, 3, 4, 5, 6};
    file.append("group/points", points.data(), 1);
    file.set_attribute("", {"frame", std::string("mine")});
    file.set_attribute("group/points", {"s_m", std::vector<double>{0.5, 0}});
    file.set_attribute("group/points", {"nothing", std::vector<std::string>()});
    file.close();
  }
  const data::TableFile file = data::TableFile::open(folder("t.h5"));
  EXPECT_EQ(file.numbers("rows", 0, 3), rows);
  EXPECT_TRUE(std::signbit(file.numbers("rows", 2, 1)[0]));
  EXPECT_EQ(file.integers("hashes", 0, 2), hashes);
  EXPECT_EQ(file.columns("rows"), (std::vector<std::string>{"a_m", "b"}));
  EXPECT_EQ(file.text("note"), "Grüße");
  EXPECT_EQ(file.text("empty"), "");
  EXPECT_EQ(file.number("pi"), 3.25);
  EXPECT_THROW(file.number("note"), data::LoadError);
  EXPECT_EQ(file.width("group/points"), 6);
  EXPECT_EQ(file.numbers("group/points", 0, 1), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(file.texts("group/points", "names"), (std::vector<std::string>{"é", ""}));
  EXPECT_TRUE(file.texts("group/points", "nothing").empty());
  EXPECT_FALSE(file.has("group/none"));
  EXPECT_FALSE(file.has("none/points"));
  EXPECT_THROW(file.numbers("rows", 2, 2), data::LoadError);
  EXPECT_THROW(file.rows("none"), data::LoadError);
}

/// With room for one of its two files, or for none, a recording is refused; an older one stays, and nothing beside it.
TEST(TableFile, WithoutRoomToBeginARecordingIsRefused) {
  const Folder folder;
  std::ofstream(folder("run.h5")) << "older";
  data::RecordingHeader header;
  header.input_columns = header.signal_columns = {"x"};
  header.setup = std::string(100'000, ' ');
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  for (const rlim_t most : {rlim_t{0}, rlim_t{50'000}}) {
    const rlimit limit{most, before.rlim_max};  // of a file's size, which for this program acts like a full disk
    setrlimit(RLIMIT_FSIZE, &limit);
    EXPECT_THROW(data::RecordingWriter(folder("run.h5"), header), data::WriteError) << most;
    setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_EQ(std::filesystem::file_size(folder("run.h5")), 5u);
    EXPECT_FALSE(std::filesystem::exists(folder("run.h5.next")));
    EXPECT_FALSE(std::filesystem::exists(folder("run.h5.before")));
  }
  std::signal(SIGXFSZ, handler);
}

data::RecordingHeader small_header() {
  data::RecordingHeader header;
  header.full = false;
  header.input_columns = header.signal_columns = {"x"};
  return header;
}

data::RecordingBlock forty_steps() {
  data::RecordingBlock block;
  block.inputs.resize(40), block.hashes.resize(40), block.signals.resize(4);
  return block;
}

TEST(Recording, WithFewerSignalsThanItsStepsHaveIsCutShort) {
  const Folder folder;
  {
    data::RecordingWriter writer(folder("run.h5"), small_header());
    writer.commit(forty_steps());
    writer.finish("{}");
  }
  EXPECT_EQ(data::RecordingReader(folder("run.h5")).steps(), 40u);
  {
    data::TableFile file = data::TableFile::open(folder("run.h5"), true);
    file.shorten("signals", 3);
    file.close();
  }
  const std::string said = data::refusal_of([&] { data::RecordingReader reader(folder("run.h5")); });
  data::expect_words(said, {"run.h5: has signals of 30 of its 40 steps", "cut short"});
}

TEST(Recording, TakesNoPlaceOfALinkOrOfWhatIsNoFile) {
  const Folder folder;
  fs::create_directories(folder("far"));
  fs::create_symlink("far/run.h5", folder("run.h5"));
  {
    data::RecordingWriter writer(folder("run.h5"), small_header());
    writer.commit(forty_steps());
    writer.finish("{}");
  }
  EXPECT_TRUE(fs::is_symlink(folder("run.h5")));
  EXPECT_EQ(data::RecordingReader(folder("far/run.h5")).steps(), 40u);
  ASSERT_EQ(mkfifo(folder("pipe").c_str(), 0600), 0);
  EXPECT_THROW(data::RecordingWriter(folder("pipe"), small_header()), data::WriteError);
  EXPECT_TRUE(fs::is_fifo(folder("pipe")));
}

TEST(Recording, WhoseFolderVanishesSaysSo) {
  const Folder folder;
  std::filesystem::create_directory(folder("out"));
  auto begun = std::make_unique<data::RecordingWriter>(folder("out/run.h5"), small_header());
  data::RecordingWriter& writer = *begun;
  writer.commit(forty_steps());
  std::filesystem::rename(folder("out"), folder("elsewhere"));
  for (const bool ends : {false, true}) try {
      ends ? writer.finish("{}") : writer.commit(forty_steps());
      ADD_FAILURE();
    } catch (const data::WriteError& error) {
      data::expect_words(error.what(), {"out/run.h5: cannot be written on", "its folder removed or renamed?"});
    }
  EXPECT_EQ(data::RecordingReader(folder("elsewhere/run.h5")).steps(), 40u) << "what there was went with it";

  // Another run may have begun in its place.
  std::filesystem::create_directory(folder("out"));
  data::RecordingWriter other(folder("out/run.h5"), small_header());
  EXPECT_THROW(writer.commit(forty_steps()), data::WriteError);
  other.commit(forty_steps());
  begun.reset();
  other.commit(forty_steps());
  EXPECT_EQ(data::RecordingReader(folder("out/run.h5")).steps(), 80u);
}

}  // namespace
}  // namespace ostium::app
