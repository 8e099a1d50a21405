#pragma once
/// A straight artery with a lesion, and devices in it, for tests of treatment.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/base/units.h"
#include "vascular/treatment/treatment.h"

namespace ostium::vascular {

using units::atm, units::mL_min, units::mm;

struct Setting {
  double stenosis = 0.7, length_mm = 10, healthy_mm = 3;  ///< diameter
  bool calcified = false, eccentric = false;
  Compliance compliance = Compliance::semi;
  double balloon_mm = 3, balloon_length_mm = 15;
  bool stent = false;
  double shift_mm = 0;  ///< of the device from the lesion's middle
  std::uint64_t seed = 0;
  std::function<void(TreatmentModel&)> change = {};
};

/// A straight artery of 80 mm with a lesion in the middle, and its treatment.
struct Bench {
  PhysiologyModel physiology{.heart = {}, .ischaemia = {}, .flow = {}, .contrast = {}, .line = {}};
  TreatmentModel model;
  PhysiologyState blood;
  TreatmentState state;
  PhysiologyInputs inputs;
  TreatmentInputs device;
  PhysiologyScratch blood_scratch;
  TreatmentScratch scratch;
  TreatmentReport report;
  double middle_m = 40 * mm;

  explicit Bench(const Setting& o) {
    FlowTree tree = plain_tree({{-1, 200, 0.4 * mm, o.healthy_mm / 2 * mm, Territory::rca}});
    for (FlowCell& cell : tree.cells) {
      const double x = std::fabs(cell.s_m - middle_m) / (o.length_mm / 2 * mm);
      if (x < 1) cell.diseased_m *= 1 - o.stenosis * std::min(1.0, (1 - x) / 0.3);
    }
    physiology.flow = make_flow_model(tree, 60 * mL_min);
    physiology.contrast = make_contrast_model(physiology.flow);
    const Lesion lesion{.branch = "branch 0",
                        .from_m = middle_m - o.length_mm / 2 * mm,
                        .length_m = o.length_mm * mm,
                        .stenosis = o.stenosis,
                        .eccentric = o.eccentric,
                        .made_of = typical_composition(o.calcified)};
    model.plaque = make_plaque_model(tree, {lesion});
    model.injury.seed = o.seed;
    model.balloons = {make_balloon(o.compliance, o.balloon_mm * mm, o.balloon_length_mm * mm)};
    model.balloons[0].seed = o.seed;
    model.stent_on = {-1};
    if (o.stent) model.stents = {make_stent(o.balloon_mm * mm, o.balloon_length_mm * mm)}, model.stent_on = {0};
    if (o.change) o.change(model);
    model.paths = all_paths(tree);
    blood = make_state(physiology);
    state = make_state(model, tree);
    device.balloons[0].balloon = 0, device.balloons[0].branch = 0,
    device.balloons[0].shaft.middle_m = middle_m + o.shift_mm * mm;
  }
  void run(double gauge_atm, double seconds) {
    device.balloons[0].gauge_Pa = gauge_atm * atm;
    for (int n = 0; n < 1000 * seconds; ++n) {
      report = step(model, device, 1e-3, state, {physiology.flow, blood, inputs.occupied_m}, scratch);
      step(physiology, inputs, 1e-3, blood, blood_scratch);
    }
  }
  /// Inflates, holds, and deflates under vacuum.
  void inflate(double gauge_atm) { run(gauge_atm, 5), run(-1, 9), run(0, 0.1); }
  /// How far the balloon has slid along the artery, on its shaft.
  double slip_m() const { return state.balloons[0].seat_m - device.balloons[0].shaft.middle_m; }
  double mld_mm() const {
    return 2e3 * *std::min_element(state.wall.radius_m.begin() + 50, state.wall.radius_m.begin() + 150);
  }
  double stent_mm() const {
    const auto& r = state.stents[0].radius_m;
    return 2e3 * std::accumulate(r.begin() + 2, r.end() - 2, 0.0) / static_cast<double>(r.size() - 4);
  }
  double recoil() const {
    const StentState& s = state.stents[0];
    double sum = 0;
    for (std::size_t k = 0; k < s.radius_m.size(); ++k) sum += 1 - s.radius_m[k] / s.peak_m[k];
    return sum / static_cast<double>(s.radius_m.size());
  }
};

inline double mld_after(double gauge_atm, const Setting& setting) {
  Bench bench(setting);
  bench.inflate(gauge_atm);
  return bench.mld_mm();
}

inline Bench stented(double gauge_atm, Setting setting = {}) {
  setting.stent = true, setting.balloon_length_mm = 18;
  Bench bench(setting);
  bench.inflate(gauge_atm);
  return bench;
}

}  // namespace ostium::vascular
