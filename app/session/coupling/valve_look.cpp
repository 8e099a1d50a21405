#include <algorithm>
#include <cmath>

#include "app/session/coupling/looks.h"
#include "core/rod/introducer.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double irritates_N = 0.05;   // of a wire on the ventricle's wall that surely gives extrasystoles [estimate]
constexpr double at_valve_m = 4.5e-3;  // above the annulus within which a tip may be on its way through the valve

/// Whether a point is in the ventricle as it is at that moment.
bool in_ventricle(const Vessel& vessel, const vascular::LumenMoment& moment, const Vector3d& p_P) {
  const vascular::Ventricle& v = vessel.ventricle;
  if (v.spheres.empty()) return false;
  const Vector3d p =
      p_P - vascular::HeartMotion(vessel.patient->anatomy.landmarks).breath_displacement(p_P, moment.breath);
  const auto frames = static_cast<double>(v.centres.size());
  const auto& centres = v.centres[static_cast<std::size_t>(std::lround(moment.phase * frames)) % v.centres.size()];
  for (std::size_t k = 0; k < centres.size(); ++k)
    if ((p - centres[k]).norm() < v.spheres[k].radius_m + 1e-3) return true;
  return false;
}

}  // namespace

void look_at_valve(const CouplingModel& model, const core::State& rods, const core::StepReport& report,
                   const vascular::LumenMoment& moment, const Vector3d& root_shift, CouplingState& s) {
  const vascular::Landmarks& marks = model.vessel.patient->anatomy.landmarks;
  bool through = false;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const core::Rod& rod = model.rods.rods[t];
    if (!in_body(rod, rods.rods[t]) || rod.radius.at(0)[rod.elements] > vascular::valve_passes_m) continue;
    const Vector3d p = rods.rods[t].position[rod.elements], from = p - root_shift - marks.p_annulus;
    const double above_m = from.dot(marks.root_axis), aside_m = (from - above_m * marks.root_axis).norm();
    const bool inside = in_ventricle(model.vessel, moment, p);
    // The valve stays open only for what came while it was.
    if (vascular::valve_is_open(moment.phase) || s.through_valve)
      through = through || inside || (aside_m < vascular::valve_radius_m + 1e-3 && std::fabs(above_m) < at_valve_m);
    if (!inside) continue;
    double pressed_N = 0;
    for (const core::Touch& touch : report.touches)
      if (touch.rod == static_cast<int>(t) && in_ventricle(model.vessel, moment, touch.p_W))
        pressed_N += touch.normal_W_N.norm();
    s.irritation = std::max(s.irritation, std::min(1.0, pressed_N / irritates_N));
  }
  s.through_valve = through && !model.vessel.ventricle.spheres.empty();
}

}  // namespace ostium::app
