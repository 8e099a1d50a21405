/// No-reflow over many people, and what each drug of the catalogue does about it.
#include <gtest/gtest.h>

#include "data/catalogue/drug/drug_file.h"
#include "data/formats/read_file.h"
#include "tests/vascular/treatment/treatment_bench.h"

namespace ostium::data {
namespace {

using vascular::Bench, vascular::Doses, vascular::Provoked;

vascular::Drug drug(const std::string& name) {
  for (const std::string& file : drug_files())
    if (file.find("/" + name + ".json") != std::string::npos) return read_drug(file, read_file(file));
  throw std::invalid_argument(name);
}

/// An artery of 80 mm without a lesion, whose muscle may be closed and opened again.
struct Muscle : Bench {
  Muscle(std::uint64_t seed, const std::string& name) : Bench({.stenosis = 0.1, .seed = seed}) {
    model.drugs.seed = seed;
    if (!name.empty()) model.drugs.others = {drug(name)};
    state = make_state(model, physiology.flow.tree);
    device.balloons[0].balloon = -1;
    run(0, 20);
  }
  void give(const Doses& doses, double then_s) {
    device.doses = doses;
    run(0, 1e-3);
    device.doses = {};
    run(0, then_s);
  }
  /// At 30 a second, from the first contrast at the ostium to the first at 72 mm; the state is as before.
  double frames() {
    const vascular::PhysiologyState kept = blood;
    auto& contrast = inputs.contrast;
    contrast.tip = {vascular::TipPlace::coronary, 2, 1};
    contrast.injection_m3_s = 2e-6, contrast.iodine_kg_m3 = 350;
    std::fill(blood.contrast.line_kg.begin(), blood.contrast.line_kg.end(), 350 * 2.5e-6 / vascular::line_cells);
    const auto seen = [&](int cell) {
      const double area = units::pi * std::pow(blood.radius_m[static_cast<std::size_t>(cell)], 2);
      return vascular::concentration(blood.contrast, physiology.flow, cell, area) > 60;
    };
    double first = -1, t = 0;
    for (; t < 20 && !seen(180); t += 0.005) {
      run(0, 0.005);
      if (first < 0 && seen(3)) first = t;
    }
    contrast.injection_m3_s = 0;
    blood = kept;
    return 30 * (t - first);
  }
};

struct Result {
  double before = 0, closed = 0, after = 0;  ///< frames
};

/// Closes 90 to 97 % of the muscle, and gives the doses, 30 s apart.
Result treated(std::uint64_t seed, const std::string& name, const std::vector<Doses>& doses) {
  Muscle m(seed, name);
  Result r;
  r.before = m.frames();
  m.device.provocation = {Provoked::no_reflow, 0, 0.90 + 0.07 * static_cast<double>(seed % 10) / 9};
  m.run(0, 1e-3);
  m.device.provocation = {};
  m.run(0, 30);
  r.closed = m.frames();
  for (const Doses& one : doses) m.give(one, 30);
  m.run(0, 30);
  r.after = m.frames();
  return r;
}

struct Summary {
  double closed = 0, after = 0;  ///< medians, over what each person had before
  int normal = 0;                ///< at most 1.3 times as many frames as before: TIMI 3
};

constexpr int people = 20;

Summary of_people(const std::string& name, const std::vector<Doses>& doses) {
  std::vector<double> closed, after;
  Summary s;
  for (int seed = 1; seed <= people; ++seed) {
    const Result r = treated(static_cast<std::uint64_t>(seed), name, doses);
    closed.push_back(r.closed / r.before), after.push_back(r.after / r.before);
    s.normal += r.after <= 1.3 * r.before;
  }
  const auto median = [](std::vector<double>& v) {
    std::sort(v.begin(), v.end());
    return (v[people / 2 - 1] + v[people / 2]) / 2;
  };
  s.closed = median(closed), s.after = median(after);
  return s;
}

Doses of_drug(double dose) { return {.drug = 0, .dose = dose}; }

TEST(NoReflow, NicardipineOpensNearlyAll) {
  const Summary s = of_people("nicardipine", {of_drug(200), of_drug(200), of_drug(100)});
  EXPECT_LE(s.after, 0.5 * s.closed);
  EXPECT_GE(s.normal, 18);  // 90 %
}

TEST(NoReflow, AdenosineOpensSevenToNineOfTen) {
  const std::vector<Doses> boluses(6, {.adenosine_ug = 120});
  const Summary s = of_people("", boluses);
  EXPECT_LE(s.after, 0.5 * s.closed);
  EXPECT_GE(s.normal, 14);
  EXPECT_LE(s.normal, 18);
}

TEST(NoReflow, NitroprussideAndVerapamilOpenMost) {
  EXPECT_GE(of_people("nitroprusside", {of_drug(100), of_drug(100), of_drug(100)}).normal, 13);
  EXPECT_GE(of_people("verapamil", {of_drug(250), of_drug(250), of_drug(250)}).normal, 13);
}

TEST(NoReflow, NitrateAndNothingChangeNothing) {
  for (const std::vector<Doses>& doses : {std::vector<Doses>(3), std::vector<Doses>(3, {.nitrate_ug = 200})}) {
    const Summary s = of_people("", doses);
    EXPECT_EQ(s.normal, 0);
    EXPECT_GT(s.after, 0.9 * s.closed);
  }
}

}  // namespace
}  // namespace ostium::data
