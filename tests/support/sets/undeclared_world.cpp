#include "tests/support/sets/undeclared_world.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ostium::synthetic {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using units::mm, units::degree, units::pi;

constexpr double inch = 25.4, gram_force_N = 9.80665e-3;
constexpr double shared_m = 25e-3, spacing_m = 5e-3;

Matrix3d turned(const Vector3d& axis, double angle) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

data::Experiment& culprit(Undeclared& made, std::size_t k) {
  for (data::Experiment& e : made.set.experiments)
    if (e.id == made.culprits.at(k)) return e;
  throw std::runtime_error("no experiment " + made.culprits[k]);
}

/// Section boundaries and stiffness of a shaft that tapers where the file has a step.
std::vector<core::Section> tapered(const std::vector<core::Section>& declared, double from_m, double to_m) {
  constexpr int pieces = 30;
  std::vector<core::Section> out;
  const auto at = [&](double s) {
    for (const core::Section& d : declared)
      if (s < d.to_tip_m) return d;
    return declared.back();
  };
  const core::Section tip = at(from_m - 1e-6), shaft = at(to_m + 1e-6);
  for (const core::Section& d : declared) {
    core::Section before = d;
    before.to_tip_m = std::min(before.to_tip_m, from_m);
    if (before.to_tip_m > before.from_tip_m + 1e-9) out.push_back(before);
  }
  for (int i = 0; i < pieces; ++i) {
    const double a = from_m + (to_m - from_m) * i / pieces, b = from_m + (to_m - from_m) * (i + 1) / pieces;
    core::Section s = at((a + b) / 2);
    const double t = (i + 0.5) / pieces;
    s.from_tip_m = a, s.to_tip_m = b;
    s.EI1_N_m2 = s.EI2_N_m2 = (1 - t) * tip.EI1_N_m2 + t * shaft.EI1_N_m2;
    s.GJ_N_m2 = (1 - t) * tip.GJ_N_m2 + t * shaft.GJ_N_m2;
    out.push_back(s);
  }
  for (const core::Section& d : declared) {
    core::Section behind = d;
    behind.from_tip_m = std::max(behind.from_tip_m, to_m);
    if (behind.to_tip_m > behind.from_tip_m + 1e-9) out.push_back(behind);
  }
  return out;
}

}  // namespace

bool add_form(const std::string& id, Dice& dice, Undeclared& made, World& world) {
  data::MeasurementSet& set = made.set;
  if (id == "form:anisotropy_by_section") {
    const double tip = std::exp(dice.either(0.5, 0.9)), shaft = std::exp(dice.either(0.15, 0.4));
    const double boundary = set.instruments[0].sections[0].to_tip_m;
    world.mechanics.push_back([=](const data::Experiment&, boundary_value::Problem& p) {
      for (core::Section& s : p.tubes[0].sections) {
        const double root = std::sqrt(s.to_tip_m <= boundary + 1e-9 ? tip : shaft);
        s.EI1_N_m2 *= root, s.EI2_N_m2 /= root;
      }
    });
    made.effects = {"bending_anisotropy"};
  } else if (id == "form:softening_by_moment") {
    // The moment at which the shaft is bent to a radius of some 400 mm.
    const double moment = dice.log_uniform(1.5, 3) * set.instruments[0].sections.back().EI1_N_m2;
    const double ratio = dice.uniform(0.15, 0.4);
    world.mechanics.push_back([=](const data::Experiment&, boundary_value::Problem& p) {
      for (core::Section& s : p.tubes[0].sections) s.softening_per_m = moment / s.EI1_N_m2, s.softened_ratio = ratio;
    });
    made.effects = {"superelastic_softening"};
  } else if (id == "taper") {
    const double at = set.instruments[0].sections[0].to_tip_m, length = dice.uniform(40, 80) * mm;
    world.mechanics.push_back([=](const data::Experiment&, boundary_value::Problem& p) {
      p.tubes[0].sections = tapered(p.tubes[0].sections, at, at + length);
    });
    made.truth[id + ".length_mm"] = length / mm;
    made.effects = {id};
  } else if (id == "torsion_ratio") {
    const double factor = std::exp(dice.either(0.5, 1.2));
    world.mechanics.push_back([=](const data::Experiment&, boundary_value::Problem& p) {
      for (core::Section& s : p.tubes[0].sections) s.GJ_N_m2 *= factor;
    });
    made.truth[id + ".factor"] = factor;
    made.effects = {id};
  } else if (id == "level") {
    const Vector3d axis = Vector3d(dice.normal(), dice.normal(), 0).normalized();
    const Matrix3d tilt = turned(axis, dice.uniform(4, 10) * degree);
    world.mechanics.push_back(
        [=](const data::Experiment&, boundary_value::Problem& p) { p.gravity = Vector3d(tilt * p.gravity); });
    made.effects = {id};
  } else if (id == "reclamping") {
    std::vector<Vector3d> tilts;
    for (std::size_t i = 0; i < set.experiments.size(); ++i)
      tilts.emplace_back(dice.normal() * degree, dice.normal() * degree, 0);
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      const Vector3d tilt = tilts[std::stoul(e.id.substr(1))];
      p.base_R = p.base_R * turned(tilt.normalized(), tilt.norm());
    });
    made.effects = {id};
  } else {
    return false;
  }
  return true;
}

void add_fault(const std::string& id, Dice& dice, Undeclared& made, World& world) {
  auto& all = made.set.experiments;
  const auto n = static_cast<int>(all.size());
  int k = dice.whole(1, n - 1);
  // Where the fault would show least, another.
  if (id == "fault:load_in_gram_force" && k % 3 == 0) k = k > 1 ? k - 1 : k + 1;
  if (id == "fault:roll_in_radians")
    for (int i = 0; i < n; ++i)
      if (std::fabs(all[i].set[0].roll_rad) > std::fabs(all[k].set[0].roll_rad)) k = i;
  made.culprits = {all[k].id};
  made.faults = {"unit_error"};
  if (id == "fault:all_in_cm") {
    made.culprits.clear();
    for (const data::Experiment& e : all) made.culprits.push_back(e.id);
  } else if (id == "fault:reversed") {
    made.faults.clear();  // read the other way round, with a word
  } else if (id == "fault:swapped") {
    int other = (k + 3) % n;
    if (other == 0) other = 1;
    made.culprits.push_back(all[other].id);
    made.faults = {"swapped_experiments"};
  } else if (id == "fault:clamp_off") {
    made.faults = {"outlier_experiment"};
    const Vector3d axis = Vector3d(dice.normal(), dice.normal(), 0).normalized();
    const Matrix3d off = turned(axis, dice.uniform(3, 8) * degree);
    const std::string who = made.culprits[0];
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      if (e.id == who) p.base_R = p.base_R * off;
    });
  } else if (id == "fault:slipped_9mm") {
    made.faults = {"outlier_experiment", "reseated_instrument"};  // either will do
    const std::string who = made.culprits[0];
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      if (e.id == who) p.tubes[0].inserted_m -= 9 * mm;
    });
  }
}

void write_wrongly(const std::string& id, Undeclared& made) {
  if (id.empty()) return;
  data::Experiment& e = culprit(made, 0);
  if (id == "fault:roll_in_radians") e.set[0].roll_rad *= degree;
  if (id == "fault:insertion_in_cm") e.set[0].inserted_m /= 10;
  if (id == "fault:load_in_gram_force") e.tip_force_N /= gram_force_N;
  if (id == "fault:swapped") std::swap(e.points_m, culprit(made, 1).points_m);
  if (id == "fault:reversed") std::reverse(e.points_m.begin(), e.points_m.end());
  if (id == "fault:centreline_in_inches")
    for (Vector3d& p : e.points_m) p /= inch;
  if (id == "fault:all_in_cm")
    for (data::Experiment& x : made.set.experiments) x.set[0].inserted_m /= 10;
}

void add_noise(const std::string& id, Dice& dice, double sigma_m, std::vector<Vector3d>& points_m) {
  const std::size_t n = points_m.size();
  if (id == "noise:shared") {
    const double keeps = std::exp(-spacing_m / shared_m);
    Vector3d off = dice.normals();
    for (Vector3d& p : points_m) p += sigma_m * off, off = keeps * off + std::sqrt(1 - keeps * keeps) * dice.normals();
    return;
  }
  if (id == "noise:smooth") {
    constexpr int reach = 15;
    std::vector<Vector3d> own(n + 2 * reach);
    for (Vector3d& o : own) o = dice.normals();
    for (std::size_t i = 0; i < n; ++i) {
      Vector3d sum = Vector3d::Zero();
      double squares = 0;
      for (int j = -reach; j <= reach; ++j) {
        const double u = j * spacing_m / shared_m, weight = std::exp(-u * u);
        sum += weight * own[i + static_cast<std::size_t>(reach + j)], squares += weight * weight;
      }
      points_m[i] += sigma_m / std::sqrt(squares) * sum;
    }
    return;
  }
  for (Vector3d& p : points_m) {
    double size = sigma_m;
    if (id == "noise:heavy") {
      const Vector3d of_three = dice.normals();
      size *= std::sqrt(3 / of_three.squaredNorm());
    }
    if (id == "noise:blunders" && dice.uniform(0, 1) < 0.03) size *= dice.uniform(8, 20);
    if (id == "noise:twice") size *= 2;
    p += size * dice.normals();
  }
}

}  // namespace ostium::synthetic
