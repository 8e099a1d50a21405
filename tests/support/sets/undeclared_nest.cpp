#include "tests/support/sets/undeclared_nest.h"

#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "tests/support/dice.h"
#include "tests/support/nested_chains.h"
#include "tests/support/sets/undeclared_tube.h"

namespace ostium::synthetic {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

using units::mm;
constexpr int experiments = 12;

nested_chains::Tube chain_of(const data::MeasuredInstrument& tube, double stiffer, double inserted_m, double side) {
  nested_chains::Tube out;
  out.inserted_m = inserted_m;
  for (const core::Section& s : tube.sections)
    out.pieces.push_back({s.to_tip_m, stiffer * s.EI1_N_m2, side * s.rest_curvature_per_m.y()});
  return out;
}

}  // namespace

Undeclared undeclared_play(unsigned seed) {
  Dice dice("nesting_clearance", seed);
  Undeclared u;
  data::MeasurementSet& set = u.set;
  set = two_tubes(1);
  set.title = "made by two chains";
  set.imaging = {};
  set.imaging.noise_sigma_m = dice.uniform(0.05, 0.1) * mm;
  set.gravity_m_s2.setZero();
  double stiffer[2];
  for (int i = 0; i < 2; ++i) {
    auto& s = set.instruments[i].sections;
    const double nominal = dice.uniform(0.8, 1.25);
    for (core::Section& c : s) c.EI1_N_m2 *= nominal, c.EI2_N_m2 *= nominal, c.GJ_N_m2 *= nominal;
    s[0].to_tip_m = s[1].from_tip_m = rounded_m(dice.uniform(40, 60) * mm);
    s[0].rest_curvature_per_m = {0, i == 0 ? dice.uniform(8, 14) : dice.uniform(2, 10), 0};
    stiffer[i] = dice.uniform(0.75, 1.3);
  }
  const double play = dice.uniform(0.06, 0.18) * mm;
  u.effects = {"nesting_clearance"};
  u.truth["nesting_clearance.clearance_mm"] = play / mm;

  data::Experiment nominal = set.experiments[0];
  nominal.base = base_along_x({0, 0});
  nominal.kind = data::Experiment::Kind::centreline;
  set.experiments.clear();
  for (int i = 0; i < experiments; ++i) {
    data::Experiment e = nominal;
    e.id = "n" + std::to_string(i);
    e.place = "experiments[" + std::to_string(i) + "]";
    e.points_m.clear();
    const double a = rounded_m(dice.uniform(55, 90) * mm), b = a + rounded_m(dice.uniform(12, 38) * mm);
    const bool opposed = i % 2 == 1;
    e.set = {{a, 0, 0}, {b, opposed ? units::pi : 0, 0}};
    if (i % 3 == 2) e.tip_force_N = Vector3d(0, 0, dice.either(0.05, 0.15));

    nested_chains::Problem pair;
    pair.outer = chain_of(set.instruments[0], stiffer[0], a, 1);
    pair.inner = chain_of(set.instruments[1], stiffer[1], b, opposed ? -1 : 1);
    pair.play_m = play, pair.segment_m = segment_m;
    pair.tip_force_N = Vector2d(e.tip_force_N.x(), e.tip_force_N.z());
    const nested_chains::Solution rest = nested_chains::solve(pair);
    if (!rest.converged) throw std::runtime_error("the nested chains come to no rest");
    // As in a photograph: the outer one as far as it goes.
    for (std::size_t k = 0; k < rest.inner.size(); k += static_cast<std::size_t>(points_m / segment_m)) {
      const Vector2d& p = k < rest.outer.size() ? rest.outer[k] : rest.inner[k];
      e.points_m.push_back(Vector3d(p.x(), 0, p.y()) + *set.imaging.noise_sigma_m * dice.normals());
    }
    set.experiments.push_back(e);
  }
  return u;
}

}  // namespace ostium::synthetic
