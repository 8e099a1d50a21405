/// Contact with walls: friction and buckling against closed forms.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "core/samples/tube.h"

namespace ostium::app::gates {

namespace {

using Eigen::Vector3d;
using units::pi;

core::RodDescription wire(double length_m, double EI_N_m2, double radius_m, double kg_per_m, int elements) {
  core::RodDescription d;
  d.name = "wire";
  core::Section s;
  s.to_tip_m = length_m;
  s.EI1_N_m2 = s.EI2_N_m2 = EI_N_m2;
  s.GJ_N_m2 = EI_N_m2 / 1.3;
  s.kg_per_m = kg_per_m, s.radius_m = radius_m;
  d.sections = {s};
  d.element_lengths_m = equal_elements(d.sections, elements);
  return d;
}

struct Bed {
  Bed(const core::RodDescription& rod, const core::SurfaceDescription& wall, const Vector3d& gravity_W) {
    model.rods = {make_rod(rod)};
    model.surfaces = {std::make_shared<core::Surface>(make_surface(wall))};
    model.gravity_W = gravity_W;
    state = make_state(model, {core::along_x()});
    inputs.rods.resize(1);
  }
  void step(core::Scratch& scratch, int steps = 1) {
    for (int i = 0; i < steps; ++i) core::step(model, inputs, state, scratch, report);
  }
  core::Model model;
  core::State state;
  core::Inputs inputs;
  core::StepReport report;
};

/// A wire pulled through a bent tube: T2 / T1 = exp(mu phi) (Euler, Eytelwein).
data::GateResult capstan(double mu, double phi) {
  constexpr double R = 0.05, lumen = 2e-3, radius = 0.45e-3, tension = 1, lead = 0.05;
  const double inside = lead + R * phi + 0.05;
  core::SurfaceDescription wall = core::tube(core::bend(R, phi, lead + 0.02, 0.15, lumen, 1.5e-3), 48);
  wall.friction = mu;
  for (Vector3d& v : wall.frames[0]) v.x() -= 0.02;
  core::RodDescription d = wire(inside + 0.1, 2e-5, radius, 4e-3, 300);  // EI / R^2 is 0.8 % of the tension
  d.damping = {0.5, 0.25, 1e-3};
  Bed bed(d, wall, Vector3d::Zero());
  // Placed along the middle of the tube.
  core::RodDescription bent = d;
  const double tip_straight = 0.05;
  core::Section s = d.sections[0];
  bent.sections.clear();
  for (const auto& [from, to, k] : {std::tuple{0.0, tip_straight, 0.0},
                                    {tip_straight, tip_straight + R * phi, -1 / R},
                                    {tip_straight + R * phi, inside + 0.1, 0.0}}) {
    s.from_tip_m = from, s.to_tip_m = to, s.rest_curvature_per_m = {0, k, 0};
    bent.sections.push_back(s);
  }
  core::Model laid = bed.model;
  laid.rods = {make_rod(bent)};
  bed.state = make_state_at_rest_shape(laid, {core::along_x()}, {inside});
  core::Scratch scratch(bed.model);
  const Vector3d out(std::cos(phi), 0, std::sin(phi));
  for (int n = 0; n < 500; ++n) bed.inputs.rods[0].tip_force_W_N = n * tension / 500 * out, bed.step(scratch);
  bed.inputs.rods[0].tip_force_W_N = tension * out;
  bed.inputs.rods[0].feed_m_s = -0.02;
  bed.step(scratch, 1000);
  double sum = 0;
  for (int n = 0; n < 500; ++n) bed.step(scratch), sum -= bed.report.rods[0].push_N / 500;
  const double reference = std::exp(mu * phi);
  return {"contact-capstan", sum / tension, reference, 0.05 * reference, "1"};
}

/// A flat floor: the bottom of a wide box.
core::SurfaceDescription box(double half_m) {
  core::SurfaceDescription d;
  auto& v = d.frames.emplace_back();
  for (double x : {-half_m, half_m})
    for (double y : {-half_m, half_m})
      for (double z : {0.0, 2 * half_m}) v.emplace_back(x, y, z);
  d.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                 {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return d;
}

/// The slope at which a resting wire with free ends begins to slide, against mu.
data::GateResult slope() {
  constexpr double mu = 0.3, radius = 0.45e-3, length = 0.1;
  core::SurfaceDescription floor = box(0.5);
  floor.friction = mu;
  Bed bed(wire(length, 1e-3, radius, 4e-3, 50), floor, Vector3d(0, 0, -9.81));
  core::EndState at = core::along_x();
  at.p_W = Vector3d(0, 0, radius);
  bed.state = make_state(bed.model, {at});
  bed.inputs.rods[0].base.hold = core::Hold::free;
  core::Scratch scratch(bed.model);
  bed.step(scratch, 200);
  const double start = bed.state.rods[0].position[25].x();
  for (double t = 0; t < 1.1 * mu; t += (t < 0.9 * mu ? 0.001 : 0.0001) * mu) {
    const double angle = std::atan(t);
    bed.model.gravity_W = 9.81 * Vector3d(std::sin(angle), 0, -std::cos(angle));
    bed.step(scratch, 5);
    // Friction gives elastically by about 20 um before slip.
    if (bed.state.rods[0].position[25].x() - start > 50e-6) return {"contact-slope", t / mu, 1, 0.01, "1"};
  }
  return {"contact-slope", 0, 1, 0.01, "1"};
}

/// A heavy rod pushed in a straight horizontal tube: it buckles off the bottom in a sine wave (Dawson, Paslay 1984).
data::GateResult sinusoidal_buckling(bool quick) {
  constexpr double EI = 8e-6, weight = 8.04e-3, clearance = 0.5e-3, radius = 0.2e-3, length = 1.7;
  const double reference = 2 * std::sqrt(EI * weight / clearance);
  core::RodDescription d = wire(length, EI, radius, weight / 9.81, 512);
  d.damping = {0.002, 0.001, 0};
  core::SurfaceDescription wall =
      core::tube({{Vector3d(-0.1, 0, 0), clearance + radius}, {Vector3d(length + 0.1, 0, 0), clearance + radius}}, 360);
  Bed bed(d, wall, Vector3d(0, 0, -9.81));
  core::EndState at = core::along_x();
  at.p_W.z() = -clearance;
  bed.state = make_state(bed.model, {at});
  // Perturbations of a micrometre at every wavelength.
  core::RodState& rod = bed.state.rods[0];
  for (int i = 0; i < 512; ++i) {
    const double y = 1e-3 * std::sin(0.9 * i) * std::cos(0.23 * i * i);
    rod.velocity.set(i, Vector3d(0, y, 0));
  }
  bed.inputs.rods[0].base.hold = core::Hold::pinned;
  bed.inputs.rods[0].tip.hold = core::Hold::guided;
  core::Scratch scratch(bed.model);
  const double rate = quick ? 0.2 : 0.1;  // of the load, per second
  for (double share = 0.85; share < 1.3; share += 1e-3 * rate) {
    bed.inputs.rods[0].tip_force_W_N = Vector3d(-share * reference, 0, 0);
    bed.step(scratch);
    double side = 0;
    for (int i = 50; i < 462; ++i) side = std::max(side, std::fabs(bed.state.rods[0].position[i].y()));
    if (side > 0.1e-3) return {"contact-sinusoidal-buckling", share * reference, reference, 0.1 * reference, "N"};
  }
  return {"contact-sinusoidal-buckling", 0, reference, 0.1 * reference, "N"};
}

}  // namespace

std::vector<data::GateResult> contact(bool quick) { return {capstan(0.2, pi), slope(), sinusoidal_buckling(quick)}; }

}  // namespace ostium::app::gates
