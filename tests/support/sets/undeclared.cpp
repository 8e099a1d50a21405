#include "tests/support/sets/undeclared.h"

#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "tests/support/dice.h"
#include "tests/support/sets/undeclared_laws.h"
#include "tests/support/sets/undeclared_nest.h"
#include "tests/support/sets/undeclared_tube.h"
#include "tests/support/sets/undeclared_views.h"
#include "tests/support/sets/undeclared_world.h"

namespace ostium::synthetic {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

using units::pi, units::mm, units::Nmm2, units::degree, units::gram;

core::Section made_section(double from_mm, double to_mm, double EI, double GJ, double kg_per_m, const Vector2d& k_per_m,
                           double radius_mm, double bore_mm) {
  core::Section s;
  s.from_tip_m = from_mm * mm, s.to_tip_m = to_mm * mm;
  s.EI1_N_m2 = s.EI2_N_m2 = EI * Nmm2, s.GJ_N_m2 = GJ * Nmm2;
  s.kg_per_m = kg_per_m;
  s.rest_curvature_per_m << k_per_m, 0;
  s.radius_m = radius_mm * mm, s.inner_radius_m = bore_mm * mm;
  return s;
}

namespace {

core::EndState base(Dice& dice) {
  core::EndState out;
  Matrix3d R;
  R.col(2) = Vector3d(1, dice.uniform(-0.3, 0.3), dice.uniform(-0.3, 0.3)).normalized();
  R.col(0) = (Vector3d::UnitZ() - R.col(2) * R(2, 2)).normalized();
  R.col(1) = Vector3d(R.col(2)).cross(Vector3d(R.col(0)));
  const Eigen::Quaterniond q(R);
  out.q_W = {q.w(), q.x(), q.y(), q.z()};
  out.p_W = {dice.uniform(-0.05, 0.05), dice.uniform(-0.05, 0.05), dice.uniform(-0.05, 0.05)};
  return out;
}

/// A wire or a catheter, free at its end, with a shaft and a softer, mostly curved tip; a dozen experiments.
data::MeasurementSet free_instrument(Dice& dice, bool curved, bool timed) {
  data::MeasurementSet set;
  set.title = "made by a boundary-value solver", set.source = "tests";
  const double radius = dice.uniform(0.17, 0.3), shaft = dice.log_uniform(25, 90),
               tip = shaft * dice.uniform(0.05, 0.2);
  const double ratio = dice.uniform(0.7, 0.8), weight = 6450 * pi * radius * radius * 1e-6 * dice.uniform(0.8, 1.4);
  const double tip_mm = timed ? dice.uniform(60, 110) : dice.uniform(25, 60), middle_mm = tip_mm + dice.uniform(40, 90),
               length_mm = 600;
  const double bend = curved || dice.uniform(0, 1) < 0.7 ? dice.log_uniform(timed ? 15 : 8, 30) : 0;
  const double side = dice.uniform(0, 2 * pi);
  const Vector2d k = bend * Vector2d(std::cos(side), std::sin(side));
  data::MeasuredInstrument instrument{"instrument", length_mm * mm, radius * mm, 0, {}};
  auto& s = instrument.sections;
  s.push_back(made_section(0, tip_mm, tip, ratio * tip, weight * dice.uniform(0.7, 1.2), k, radius, 0));
  if (dice.uniform(0, 1) < 0.5) {
    const double EI = shaft * dice.uniform(0.4, 0.7);
    s.push_back(made_section(tip_mm, middle_mm, EI, ratio * EI, weight, {0, 0}, radius, 0));
    s.push_back(made_section(middle_mm, length_mm, shaft, ratio * shaft, weight, {0, 0}, radius, 0));
  } else {
    s.push_back(made_section(tip_mm, length_mm, shaft, ratio * shaft, weight, {0, 0}, radius, 0));
  }
  set.instruments = {instrument};
  set.gravity_m_s2 = {0, 0, -9.81};
  set.imaging.noise_sigma_m = dice.uniform(0.08, 0.25) * mm;
  const core::EndState at = base(dice);
  const double longest = dice.uniform(220, 300);
  const int count = dice.whole(11, 14);
  for (int i = 0; i < count; ++i) {
    data::Experiment e;
    e.id = "x" + std::to_string(i);
    e.place = "experiments[" + std::to_string(i) + "]";
    e.base = at;
    e.set = {{longest * mm * (0.45 + 0.55 * std::fmod(0.618 * i + 0.3, 1.0)), dice.uniform(-180, 180) * degree, 0}};
    e.specimen.resize(1);
    // Bends the shaft by about a tenth of its length.
    const double inserted = e.set[0].inserted_m, load = 0.2 * shaft * Nmm2 / (inserted * inserted);
    if (i % 3 != 0) e.tip_force_N = load * dice.uniform(0.5, 1.2) * dice.direction();
    if (timed) e.elapsed_s = i == 0 ? 0 : 15 * std::pow(1.5, i) * dice.uniform(0.8, 1.2);
    set.experiments.push_back(e);
  }
  return set;
}

/// Two nested tubes with curved ends; tips and shapes.
data::MeasurementSet tubes(Dice& dice) {
  data::MeasurementSet set = two_tubes(1);
  set.title = "made by a boundary-value solver";
  set.imaging = {};
  set.imaging.noise_sigma_m = dice.uniform(0.15, 0.3) * mm;
  const double shaft_from = dice.uniform(0.1, 0.14);
  for (int i = 0; i < 2; ++i) {
    auto& s = set.instruments[i].sections;
    const double stiff = dice.uniform(0.8, 1.25), bend = dice.uniform(8, 15), curve = dice.uniform(40, 60) * mm;
    for (core::Section& c : s) c.EI1_N_m2 *= stiff, c.EI2_N_m2 *= stiff, c.GJ_N_m2 *= stiff;
    s[0].to_tip_m = s[1].from_tip_m = curve;
    s[0].rest_curvature_per_m = {0, bend, 0};
  }
  const data::Experiment nominal = set.experiments[0];
  set.experiments.clear();
  for (int i = 0; i < 14; ++i) {
    data::Experiment e = nominal;
    e.id = "p" + std::to_string(i);
    e.place = "experiments[" + std::to_string(i) + "]";
    const double a = dice.uniform(0.055, 0.09), b = a + dice.uniform(0.008, 0.035);
    e.set = {{a, dice.uniform(-70, 70) * degree, shaft_from - a}, {b, dice.uniform(-70, 70) * degree, 0.22 - b}};
    e.kind = data::Experiment::Kind::centreline;
    e.points_m.clear();
    set.experiments.push_back(e);
  }
  return set;
}

/// Cuts sections at `from` and `to` and changes what lies between.
void change(std::vector<core::Section>& sections, double from, double to,
            const std::function<void(core::Section&)>& f) {
  std::vector<core::Section> out;
  for (const core::Section& s : sections) {
    const double cuts[] = {s.from_tip_m, std::clamp(from, s.from_tip_m, s.to_tip_m),
                           std::clamp(to, s.from_tip_m, s.to_tip_m), s.to_tip_m};
    for (int i = 0; i < 3; ++i) {
      if (cuts[i + 1] - cuts[i] < 1e-9) continue;
      core::Section piece = s;
      piece.from_tip_m = cuts[i], piece.to_tip_m = cuts[i + 1];
      if (i == 1) f(piece);
      out.push_back(piece);
    }
  }
  sections = out;
}

Matrix3d about(const Vector3d& axis, double angle) { return Eigen::AngleAxisd(angle, axis).toRotationMatrix(); }

}  // namespace

void add_effect(const std::string& id, Dice& dice, Undeclared& u, World& world) {
  data::MeasurementSet& set = u.set;
  const auto each = [&](auto&& f) {
    world.mechanics.push_back([f](const data::Experiment&, boundary_value::Problem& p) {
      for (boundary_value::Tube& t : p.tubes) f(t);
    });
  };
  double longest = 0;
  for (const data::Experiment& e : set.experiments) longest = std::max(longest, e.set.back().inserted_m);
  if (id == "rest_curvature") {
    const double k = dice.log_uniform(0.1, 1.2), side = dice.uniform(0, 2 * pi);
    const Vector3d add(k * std::cos(side), k * std::sin(side), 0);
    u.truth[id + ".k1_per_mm"] = add.x() * mm, u.truth[id + ".k2_per_mm"] = add.y() * mm;
    each([add](boundary_value::Tube& t) {
      for (core::Section& s : t.sections) s.rest_curvature_per_m += add;
    });
  } else if (id == "soft_section") {
    const double from = dice.uniform(0.2, 0.65) * longest, length = dice.uniform(0.06, 0.16) * longest,
                 factor = dice.log_uniform(0.1, 0.5);
    u.truth[id + ".from_tip_mm"] = from / mm, u.truth[id + ".length_mm"] = length / mm,
                 u.truth[id + ".factor"] = factor;
    each([=](boundary_value::Tube& t) {
      change(t.sections, from, from + length,
             [factor](core::Section& s) { s.EI1_N_m2 *= factor, s.EI2_N_m2 *= factor, s.GJ_N_m2 *= factor; });
    });
  } else if (id == "bending_anisotropy") {
    const double ratio = std::exp(dice.either(0.15, 0.7)), axis = dice.uniform(-40, 40);
    u.truth[id + ".ratio"] = ratio;
    world.mechanics.push_back([=](const data::Experiment&, boundary_value::Problem& p) {
      boundary_value::Tube& t = p.tubes[0];
      for (core::Section& s : t.sections) {
        s.EI1_N_m2 *= std::sqrt(ratio), s.EI2_N_m2 /= std::sqrt(ratio);
        const Vector3d k = s.rest_curvature_per_m;
        s.rest_curvature_per_m = about(Vector3d::UnitZ(), -axis * degree) * k;
      }
      t.roll_rad += axis * degree;
    });
  } else if (id == "superelastic_softening") {
    // Within the range of curvatures that the loads cause.
    const double at = dice.log_uniform(1.5, 4), ratio = dice.uniform(0.15, 0.5);
    u.truth[id + ".curvature_per_mm"] = at * mm, u.truth[id + ".ratio"] = ratio;
    each([=](boundary_value::Tube& t) {
      for (core::Section& s : t.sections) s.softening_per_m = at, s.softened_ratio = ratio;
    });
  } else if (id == "lumped_mass") {
    const double mass = dice.uniform(0.06, 0.4) * integrate(set.instruments[0].sections, 0, longest).mass;
    const double from_tip = dice.uniform(0, 0.4) * longest;
    u.truth[id + ".mass_g"] = mass / gram, u.truth[id + ".from_tip_mm"] = from_tip / mm;
    const Vector3d gravity = set.gravity_m_s2;
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      const double at = e.set.back().inserted_m - from_tip;
      if (at > 0) p.loads.push_back({at, at, mass * gravity});
    });
  } else if (id == "self_weight") {
    const double scale = std::exp(dice.either(0.15, 0.6));
    u.truth[id + ".scale"] = scale;
    each([=](boundary_value::Tube& t) {
      for (core::Section& s : t.sections) s.kg_per_m *= scale;
    });
  } else if (id == "roll_loss") {
    const double fraction = dice.uniform(0.05, 0.3);
    u.truth[id + ".fraction"] = fraction;
    each([=](boundary_value::Tube& t) { t.roll_rad *= 1 - fraction; });
  } else if (id == "clamp_runout") {
    const Vector3d tilt(dice.either(0.3, 2.5), dice.either(0.3, 2.5), 0);
    u.truth[id + ".tilt_1_deg"] = tilt.x(), u.truth[id + ".tilt_2_deg"] = tilt.y();
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      const Matrix3d rolled = about(Vector3d::UnitZ(), e.set[0].roll_rad);
      p.base_R = p.base_R * rolled * about(tilt.normalized(), tilt.norm() * degree) * rolled.transpose();
    });
  } else if (id == "insertion_slip") {
    const double fraction = dice.uniform(0.02, 0.1);
    u.truth[id + ".fraction"] = fraction;
    each([=](boundary_value::Tube& t) { t.inserted_m *= 1 - fraction; });
  } else if (id == "registration") {
    const Vector3d axis = dice.direction(), shift = dice.uniform(0.8, 3) * mm * dice.direction();
    const Matrix3d R = about(axis, dice.uniform(0.5, 2.5) * degree);
    const Vector3d centre = set.experiments[0].base.p_W;
    world.picture.push_back(
        [=](const data::Experiment&, const Vector3d& p) -> Vector3d { return centre + R * (p - centre) + shift; });
  } else if (id == "imaging_scale") {
    const double scale = 1 + dice.either(0.015, 0.08);
    u.truth[id + ".scale"] = scale;
    world.picture.push_back([=](const data::Experiment&, const Vector3d& p) -> Vector3d { return scale * p; });
  } else if (id == "stress_relaxation") {
    const double f1 = dice.uniform(0.1, 0.25), t1 = dice.uniform(40, 80), f2 = dice.uniform(0.1, 0.25),
                 t2 = dice.uniform(600, 1200);
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      const double t = e.elapsed_s.value_or(0);
      const double left = 1 - f1 * (1 - std::exp(-t / t1)) - f2 * (1 - std::exp(-t / t2));
      for (core::Section& s : p.tubes[0].sections) s.rest_curvature_per_m *= left;
    });
  } else if (id == "shaft_torsion") {
    const double compliance = dice.uniform(0.5, 2);
    u.truth[id + ".compliance"] = compliance;
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      for (std::size_t i = 0; i < p.tubes.size(); ++i)
        p.tubes[i].shaft_rad_per_Nm = compliance * e.set[i].shaft_m / p.tubes[i].sections.back().GJ_N_m2;
    });
  } else if (id == "out:side_wind") {  // a force fixed in the room, across gravity
    u.in_library = false, u.frame = "lab";
    const double per_m = dice.uniform(0.15, 0.6) * 9.81 * set.instruments[0].sections.back().kg_per_m * dice.sign();
    const Vector3d across(0, per_m, 0);
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      const double length = e.set.back().inserted_m;
      p.loads.push_back({0, length, length * across});
    });
  } else if (id == "out:twist_at_rest") {  // the shaft is twisted at rest
    u.in_library = false, u.frame = "material";
    const double twist = dice.either(3, 10);
    each([=](boundary_value::Tube& t) {
      for (core::Section& s : t.sections) s.rest_curvature_per_m.z() += twist;
    });
  } else if (id == "out:shear") {  // an image with non-square, sheared pixels
    u.in_library = false, u.frame = "image";
    Matrix3d A = Matrix3d::Identity();
    A(0, 0) += dice.either(0.02, 0.06), A(1, 1) += dice.either(0.02, 0.06), A(0, 1) += dice.either(0.02, 0.06);
    A(2, 0) += dice.either(0.02, 0.06);
    world.picture.push_back([=](const data::Experiment&, const Vector3d& p) -> Vector3d { return A * p; });
  } else if (id == "out:drift") {  // the tracker's frame drifts from one experiment to the next
    u.in_library = false, u.frame = "time";
    const Vector3d shift = dice.uniform(2, 5) * mm * dice.direction(), axis = dice.direction();
    const double turn = dice.uniform(1, 3) * degree;
    const auto n = static_cast<double>(set.experiments.size());
    const Vector3d centre = set.experiments[0].base.p_W;
    world.picture.push_back([=](const data::Experiment& e, const Vector3d& p) -> Vector3d {
      const double t = std::stod(e.id.substr(1)) / n;
      return centre + about(axis, t * turn) * (p - centre) + t * shift;
    });
  } else if (id == "out:kink_in_time") {  // the shaft bends more with each experiment
    u.in_library = false, u.frame = "time";
    const double bend = dice.uniform(0.8, 2), side = dice.uniform(0, 2 * pi);
    const auto n = static_cast<double>(set.experiments.size());
    world.mechanics.push_back([=](const data::Experiment& e, boundary_value::Problem& p) {
      const double k = bend * std::stod(e.id.substr(1)) / n;
      for (core::Section& s : p.tubes[0].sections)
        s.rest_curvature_per_m += Vector3d(k * std::cos(side), k * std::sin(side), 0);
    });
  } else {
    throw std::runtime_error("no effect " + id);
  }
  if (u.in_library) u.effects.push_back(id);
}

const std::vector<std::string>& undeclared_kinds() {
  static const std::vector<std::string> kinds = with_laws({"clean",
                                                           "rest_curvature",
                                                           "soft_section",
                                                           "bending_anisotropy",
                                                           "superelastic_softening",
                                                           "lumped_mass",
                                                           "self_weight",
                                                           "roll_loss",
                                                           "clamp_runout",
                                                           "insertion_slip",
                                                           "registration",
                                                           "imaging_scale",
                                                           "stress_relaxation",
                                                           "shaft_torsion",
                                                           "nesting_clearance",
                                                           "rest_curvature+roll_loss",
                                                           "soft_section+clamp_runout",
                                                           "lumped_mass+imaging_scale",
                                                           "out:side_wind",
                                                           "out:twist_at_rest",
                                                           "out:shear",
                                                           "out:drift",
                                                           "out:kink_in_time",
                                                           "form:anisotropy_by_section",
                                                           "form:softening_by_moment",
                                                           "taper",
                                                           "torsion_ratio",
                                                           "level",
                                                           "reclamping",
                                                           "noise:shared",
                                                           "noise:smooth",
                                                           "noise:heavy",
                                                           "noise:blunders",
                                                           "noise:twice",
                                                           "noise:shared+rest_curvature",
                                                           "noise:heavy+clamp_runout",
                                                           "fault:roll_in_radians",
                                                           "fault:insertion_in_cm",
                                                           "fault:all_in_cm",
                                                           "fault:centreline_in_inches",
                                                           "fault:load_in_gram_force",
                                                           "fault:swapped",
                                                           "fault:clamp_off",
                                                           "fault:slipped_9mm",
                                                           "fault:reversed",
                                                           "tube:clean",
                                                           "tube:wall_friction",
                                                           "tube:wall_compliance",
                                                           "views:clean",
                                                           "views:view_angle",
                                                           "views:view_shift",
                                                           "views:source_distance",
                                                           "views:pincushion",
                                                           "views:s_distortion",
                                                           "views:table_sag",
                                                           "views:gantry_flex",
                                                           "views:second_plane_late",
                                                           "views:rest_curvature",
                                                           "views:roll_loss",
                                                           "views:insertion_slip",
                                                           "views:registration",
                                                           "views:imaging_scale",
                                                           "views:rest_curvature+view_angle"});
  return kinds;
}

Undeclared undeclared_set(const std::string& kind, unsigned seed) {
  if (kind.rfind(in_tube, 0) == 0) return undeclared_in_tube(kind, seed);
  if (kind.rfind(in_views, 0) == 0) return undeclared_in_views(kind, seed);
  if (kind == "nesting_clearance") return undeclared_play(seed);
  Dice dice(kind, seed);
  Undeclared u;
  const bool nested = kind == "shaft_torsion", timed = kind == "stress_relaxation";
  const bool curved = timed || kind.find("roll") != std::string::npos;  // otherwise the effect would not show
  u.set = nested ? tubes(dice) : free_instrument(dice, curved, timed);
  Truth truth;
  for (const data::MeasuredInstrument& i : u.set.instruments) {
    truth.stiffness_scale.emplace_back();
    for (std::size_t s = 0; s < i.sections.size(); ++s)
      truth.stiffness_scale.back().push_back(s > 0 && nested ? truth.stiffness_scale.back()[0]
                                                             : dice.uniform(0.7, 1.3));
  }
  World world;
  std::string fault;
  for (std::size_t from = 0; kind != "clean" && from <= kind.size();) {
    const std::size_t to = std::min(kind.find('+', from), kind.size());
    const std::string part = kind.substr(from, to - from);
    if (part.starts_with("noise:"))
      u.noise = part;
    else if (part.starts_with("fault:"))
      add_fault(fault = part, dice, u, world);
    else if (!add_form(part, dice, u, world) && !add_law(part, dice, truth, u, world))
      add_effect(part, dice, u, world);
    from = to + 1;
  }
  constexpr double spacing_m = 5e-3;
  for (data::Experiment& e : u.set.experiments) {
    boundary_value::Problem p = problem_of(u.set, e, truth);
    for (const auto& change : world.mechanics) change(e, p);
    const int points = static_cast<int>(std::ceil(p.tubes.back().inserted_m / spacing_m)) + 1;
    const boundary_value::Solution exact = boundary_value::solve(p, points);
    if (!exact.converged) throw std::runtime_error("no boundary-value solution");
    e.points_m = exact.curve;
    for (Vector3d& q : e.points_m)
      for (const auto& see : world.picture) q = see(e, q);
    add_noise(u.noise, dice, *u.set.imaging.noise_sigma_m, e.points_m);
  }
  write_wrongly(fault, u);
  return u;
}

}  // namespace ostium::synthetic
