/// One wire on three benches, by independent generators: what they say together predicts what was on none of them,
/// and a falsified wire does not.
#include "data/identification/characterisation/characterise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/base/units.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/write_file.h"
#include "data/identification/characterisation/characterisation_report.h"
#include "data/identification/measurement/measurement_reader.h"
#include "tests/support/sets/bench_set.h"
#include "tests/support/sets/bend_set.h"
#include "tests/support/sets/push_set.h"
#include "tests/support/sets/synthetic_set.h"
#include "tests/support/sets/torque_set.h"
#include "tests/support/sets/undeclared_views.h"

namespace ostium::data {
namespace {

using synthetic::BenchWire;
using units::Nmm2;

/// Stiffness and friction are declared wrong, by a quarter and more.
constexpr BenchWire wire{24, 18, 0.1, 30, 14, 0.07};

class Characterise : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& json) const {
    write_file((folder_ / name / "measurement.json").string(), json);
    return (folder_ / name).string();
  }
  JsonValue read(const std::string& set) const { return load_json(measurement_file(set)); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("ostium-characterise-" + std::to_string(::getpid()));
};

/// The wire with its bending stiffness, torsional stiffness and friction multiplied.
CharacterisedWire falsified(CharacterisedWire w, double EI, double GJ, double friction) {
  for (Stretch& s : w.stretches) s.EI_N_m2.value *= EI, s.GJ_N_m2.value *= GJ;
  w.friction.value *= friction;
  return w;
}

TEST_F(Characterise, AWireFromThreeBenchesPredictsWhatItsBenchesDidNotSee) {
  const Characterisation found = characterise(
      {write("bend", synthetic::bend_of(wire, 1).json), write("torque", synthetic::torque_of(wire, 1).json),
       write("views", synthetic::to_json(synthetic::views_of(wire, 1)))},
      "", {});
  for (const CharacterisedSet& s : found.sets) EXPECT_TRUE(s.used()) << s.name << ": " << s.why_unused;
  ASSERT_EQ(found.wire.stretches.size(), 2u);  // the torque bench had 1000 of 1500 mm
  const Stretch& tip = found.wire.stretches[0];
  EXPECT_EQ(tip.EI_N_m2.sets.size(), 2u);
  EXPECT_EQ(tip.GJ_N_m2.sets.size(), 1u);
  EXPECT_NEAR(tip.EI_N_m2.value / Nmm2, wire.EI, 3 * tip.EI_N_m2.sigma * wire.EI);
  EXPECT_LT(tip.EI_N_m2.sigma, 0.02);
  EXPECT_NEAR(tip.GJ_N_m2.value / Nmm2, wire.GJ, 3 * tip.GJ_N_m2.sigma * wire.GJ);
  EXPECT_LT(tip.GJ_N_m2.sigma, 0.03);
  ASSERT_TRUE(found.wire.friction.measured());
  EXPECT_NEAR(found.wire.friction.value, wire.friction, 3 * found.wire.friction.sigma * wire.friction);

  // Through the file, as a person does it.
  const std::string file = (folder_ / "found.json").string();
  write_file(file, instrument_json(found, "found"));
  const CharacterisedWire known = wire_in(load_instrument(file));
  const JsonValue push = read(write("push", synthetic::push_of(wire, 2).json)),
                  turned = read(write("turned", synthetic::torque_of(wire, 2).json)),
                  free = read(write("free", synthetic::to_json(synthetic::free_shapes_of(wire, 2))));
  for (const JsonValue& set : {push, turned, free}) {
    const WireCheck c = check(set, known);
    EXPECT_TRUE(c.agrees()) << *set.file << " " << words_of(c);
  }
  EXPECT_FALSE(check(free, falsified(known, 1.3, 1, 1)).agrees());
  EXPECT_FALSE(check(push, falsified(known, 1, 1, 1.3)).agrees());
  EXPECT_FALSE(check(turned, falsified(known, 1, 1, 1.3)).agrees());
  EXPECT_FALSE(check(turned, falsified(known, 1, 1.3, 1)).agrees());
}

/// The error of `explain` is that of scatter, over sets made with other dice. That of `characterise` holds calibration,
/// too, and says so.
TEST_F(Characterise, ErrorsAreOfScatterAndThenOfCalibration) {
  double squares = 0;
  constexpr unsigned sets = 10;
  for (unsigned seed = 100; seed < 100 + sets; ++seed) {
    const auto x = curves::explain_curves(parse_json("set.json", synthetic::bend_of(wire, seed).json), {});
    const curves::Fitted& EI = x.declared.parameters[0];
    ASSERT_EQ(EI.label, "EI_scale[0]");
    const double off = (EI.value * wire.declared_EI - wire.EI) / (EI.sigma * wire.declared_EI);
    squares += off * off;
  }
  // Chi-square of so many numbers, within three of its standard deviations.
  EXPECT_NEAR(squares / sets, 1, 3 * std::sqrt(2.0 / sets));
  const Characterisation together =
      characterise({write("bend", synthetic::bend_of(wire, 1).json)}, to_json(load_json(instrument_file("rosen"))), {});
  const curves::Fitted& alone = std::get<curves::CurveExplanation>(together.sets[0].found).declared.parameters[0];
  const LogScale own = without_prior(alone.value, alone.sigma, alone.parameter.spread);
  EXPECT_NEAR(together.wire.stretches[0].EI_N_m2.sigma, std::hypot(own.sigma, 0.01), 1e-9);
  EXPECT_NE(together.text[1].find("1 % of calibration"), std::string::npos);
}

TEST_F(Characterise, SetsThatDisagreeAreSaidToAndWidenTheError) {
  BenchWire other = wire;
  other.EI *= 1.3;
  const Characterisation found = characterise({write("bend", synthetic::bend_of(wire, 3).json),
                                               write("views", synthetic::to_json(synthetic::views_of(other, 3)))},
                                              "", {});
  const Combined& EI = found.wire.stretches[0].EI_N_m2;
  EXPECT_TRUE(EI.disagree());
  EXPECT_GT(EI.sigma, 0.05);
  ASSERT_TRUE(found.sets[0].check);
  EXPECT_FALSE(found.sets[0].check->agrees());
}

TEST_F(Characterise, WithoutWeightAndSizesAnInstrumentIsAskedFor) {
  try {
    characterise({write("bend", synthetic::bend_of(wire, 4).json)}, "", {});
    FAIL();
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("--like"), std::string::npos);
  }
}

/// The templates have their samples in tables beside them.
TEST_F(Characterise, SetsOfInstrumentsOfTwoWidthsAreRefused) {
  const std::string bend = write("bend", synthetic::bend_of(wire, 1).json);
  std::string other = synthetic::torque_of(wire, 1).json;
  const std::size_t at = other.find("\"outer_radius_mm\":") + 18;
  other.replace(at, other.find_first_of(",}\n", at) - at, " 1.0");
  try {
    characterise({bend, write("torque", other)}, "", {});
    ADD_FAILURE() << "a wire and a catheter";
  } catch (const LoadError& error) {
    EXPECT_NE(std::string(error.what()).find("outer radius of 1 mm"), std::string::npos) << error.what();
  }
}

TEST_F(Characterise, AnEndedSearchSaysNothingOfTheInstrument) {
  std::string text;
  for (const synthetic::BenchKind& k : synthetic::bench_kinds())
    if (k.name == "three_point_bend") text = k.make("span_error", 4, 101).json;
  CharacteriseOptions options;
  bool first = true;
  options.progress = [&](const std::string&) { first = false; };
  options.stop = [&] { return !first; };
  try {
    characterise({write("bend", text)}, to_json(load_json(instrument_file("rosen"))), options);
    ADD_FAILURE() << "written";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("ended before everything was tried"), std::string::npos) << error.what();
  }
}

TEST_F(Characterise, TablesOfSamplesAreRead) {
  const std::string templates = data_folder() + "/templates/", like = instrument_file("wire-014-workhorse");
  const Characterisation found =
      characterise({templates + "three_point_bend", templates + "torque_response"}, to_json(load_json(like)), {});
  for (const CharacterisedSet& s : found.sets) EXPECT_FALSE(s.stiffness.empty()) << s.name << ": " << s.why_unused;
  EXPECT_GT(check(read(templates + "push_pull"), found.wire).runs.size(), 1u);
}

TEST(WithoutPrior, IsWhatTheDataAloneSay) {
  // Data of mean 0.2 and deviation 0.1 with a prior of deviation 0.3.
  const double variance = 1 / (1 / 0.01 + 1 / 0.09), mean = variance * 0.2 / 0.01;
  const LogScale own = without_prior(std::exp(mean), std::exp(mean) * std::sqrt(variance), 0.3);
  EXPECT_NEAR(own.mean, 0.2, 1e-12);
  EXPECT_NEAR(own.sigma, 0.1, 1e-12);
  EXPECT_EQ(without_prior(1, 0.29, 0.3).sigma, 0);
}

TEST(CombinedWire, WeighsSetsByTheirErrors) {
  const std::vector<DeclaredStretch> declared = {{0, 1, 1e-5, 1e-5}};
  const auto of = [](double value, double sigma) {
    return std::vector<StiffnessEstimate>{{Stiffness::bending, 0.2, 1, value, sigma}};
  };
  const CharacterisedWire w = combined(declared, {of(1e-5, 0.01), of(1.03e-5, 0.02)}, {{}, {}});
  ASSERT_EQ(w.stretches.size(), 2u);
  EXPECT_FALSE(w.stretches[0].EI_N_m2.measured());
  const Combined& EI = w.stretches[1].EI_N_m2;
  // 1 % of calibration is added to each.
  const double first = 1e-4 + 1e-4, second = 4e-4 + 1e-4, both = first * second / (first + second);
  EXPECT_NEAR(std::log(EI.value / 1e-5), both * std::log(1.03) / second, 1e-12);
  const double chi2 = std::log(1.03) * std::log(1.03) / (first + second);
  EXPECT_NEAR(EI.sigma, std::sqrt(both * std::max(1.0, chi2)), 1e-12);
  EXPECT_NEAR(w.stretches[1].GJ_N_m2.value / 1e-5, EI.value / 1e-5, 1e-12);  // in the declared ratio
}

}  // namespace
}  // namespace ostium::data
