#include "tests/support/sets/undeclared_tube.h"

#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "core/samples/tube.h"
#include "tests/support/dice.h"
#include "tests/support/pushed_chain.h"

namespace ostium::synthetic {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using units::mm, units::Nmm2;
constexpr double plastic_kg_m3 = 1200;
constexpr double coil_kg_m3 = 12000;  // platinum wound around nitinol, including the air between
constexpr double base_x_m = 12e-3, push_noise = 0.03;

/// A wire so soft and heavy that friction moves it, or a catheter stiff enough to indent the wall.
pushed_chain::Wire drawn(Dice& dice, bool catheter) {
  const double radius = (catheter ? dice.uniform(0.7, 0.95) : dice.uniform(0.17, 0.25)) * mm;
  const double shaft = (catheter ? dice.log_uniform(150, 500) : dice.log_uniform(3, 10)) * Nmm2;
  const double soft = catheter ? dice.uniform(0.3, 0.7) : dice.uniform(0.12, 0.35);
  const double weight = (catheter ? 0.6 * plastic_kg_m3 : coil_kg_m3) * units::pi * radius * radius;
  const double tip = rounded_m(dice.uniform(30, 60) * mm), bend = dice.uniform(0, 9);
  return {{{tip, soft * shaft, weight, bend}, {1, shaft, weight, 0}}, radius};
}

}  // namespace

data::MeasuredInstrument declared(const pushed_chain::Wire& wire, const std::string& name, double length_m) {
  data::MeasuredInstrument out{name, length_m, wire.radius_m, 0, {}};
  double from = 0;
  for (const pushed_chain::Piece& p : wire.pieces) {
    core::Section s;
    s.from_tip_m = from, s.to_tip_m = from = std::min(p.to_tip_m, out.length_m);
    s.EI1_N_m2 = s.EI2_N_m2 = p.EI_N_m2, s.GJ_N_m2 = 0.75 * p.EI_N_m2;
    s.kg_per_m = p.kg_per_m, s.radius_m = wire.radius_m;
    s.rest_curvature_per_m = {0, p.curvature_per_m, 0};
    out.sections.push_back(s);
  }
  return out;
}

core::EndState base_along_x(const Eigen::Vector2d& xz_m) {
  Eigen::Matrix3d R;
  R << 0, 0, 1, 0, -1, 0, 1, 0, 0;
  const Eigen::Quaterniond q(R);
  core::EndState out;
  out.q_W = {q.w(), q.x(), q.y(), q.z()};
  out.p_W = {xz_m.x(), 0, xz_m.y()};
  return out;
}

Undeclared undeclared_in_tube(const std::string& kind, unsigned seed) {
  Dice dice(kind, seed);
  const std::string effect = kind.substr(std::string(in_tube).size());
  const bool soft_wall = effect == "wall_compliance", rubs = effect == "wall_friction";
  const bool catheter = soft_wall || (!rubs && dice.uniform(0, 1) < 0.5);
  pushed_chain::Wire wire = drawn(dice, catheter);
  const pushed_chain::Tube tube{rounded_m(dice.uniform(40, 65) * mm), dice.uniform(35, 55) * mm,
                                catheter ? dice.uniform(1.0, 1.6) : dice.uniform(1.4, 2.2),
                                (catheter ? dice.uniform(2.5, 3.5) : dice.uniform(5, 8)) * mm};
  const double friction = dice.uniform(0.03, 0.08);

  Undeclared u;
  data::MeasurementSet& set = u.set;
  set.title = "made by a pushed chain", set.source = "tests";
  set.instruments = {declared(wire, "instrument", 0.4)};
  set.gravity_m_s2 = {0, 0, -9.81};
  set.imaging.noise_sigma_m = (catheter ? dice.uniform(0.06, 0.12) : dice.uniform(0.1, 0.2)) * mm;
  const auto points = core::bend(tube.bend_radius_m, tube.angle_rad, tube.lead_m, 0.12, tube.radius_m, 1e-3);
  set.vessel = data::MeasuredVessel{"tube.ply", "m", friction,
                                    std::make_shared<const core::SurfaceDescription>(core::tube(points, 48))};

  pushed_chain::Setting setting{friction, {base_x_m, 0}, 9.81, segment_m};
  for (std::size_t i = 0; i < wire.pieces.size(); ++i)
    wire.pieces[i].EI_N_m2 *= u.truth["EI_scale[0][" + std::to_string(i) + "]"] = dice.uniform(0.7, 1.3);
  if (rubs) u.truth[effect + ".coefficient"] = setting.friction = dice.log_uniform(0.22, 0.42);
  if (soft_wall) {
    setting.wall_N_m2 = dice.log_uniform(2e4, 6e4);
    u.truth[effect + ".stiffness_N_per_mm2"] = 1e-6 * setting.wall_N_m2;
  }
  if (rubs || soft_wall) u.effects = {effect};

  const double deepest = tube.lead_m - base_x_m + tube.bend_radius_m * tube.angle_rad + dice.uniform(0, 25) * mm;
  std::vector<double> inserted;
  for (const double part : {0.6, 0.82, 1.0, 0.86, 0.7})
    inserted.push_back(rounded_m(part * deepest + dice.uniform(-4, 4) * mm));
  const auto rests = pushed_chain::push(tube, wire, setting, inserted);
  double hardest = 0;
  for (const pushed_chain::Rest& r : rests) hardest = std::max(hardest, std::fabs(r.push_N));
  for (std::size_t k = 0; k < rests.size(); ++k) {
    if (!rests[k].converged) throw std::runtime_error("the pushed chain comes to no rest");
    data::Experiment e;
    e.id = "d" + std::to_string(k);
    e.place = "experiments[" + std::to_string(k) + "]";
    e.base = base_along_x({base_x_m, 0}), e.specimen.resize(1);
    e.set = {{inserted[k], 0, 0}};
    for (std::size_t i = 0; i < rests[k].curve.size(); i += static_cast<std::size_t>(points_m / segment_m)) {
      const Vector2d& p = rests[k].curve[i];
      e.points_m.push_back(Vector3d(p.x(), 0, p.y()) + *set.imaging.noise_sigma_m * dice.normals());
    }
    // The push is measured for a catheter, not for a wire. Without it, a stiff instrument in a stiff wall cannot be
    // distinguished from a soft one in a soft wall.
    if (catheter) e.proximal_force_N = rests[k].push_N + push_noise * hardest * dice.normals().x();
    set.experiments.push_back(e);
  }
  return u;
}

}  // namespace ostium::synthetic
