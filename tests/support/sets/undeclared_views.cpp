#include "tests/support/sets/undeclared_views.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/units.h"
#include "tests/support/dice.h"
#include "tests/support/pinhole.h"
#include "tests/support/sets/undeclared_world.h"

namespace ostium::synthetic {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

using units::mm, units::Nmm2, units::degree;

/// What the pictures are really taken with, and how much farther the wire is fed in the second.
struct Room {
  std::vector<Pinhole> cameras;
  double fed_on_m = 0;
};

core::EndState base_towards(const Vector3d& p_m, const Vector3d& along, const Vector3d& up) {
  Matrix3d R;
  R.col(2) = along.normalized();
  R.col(0) = (up - R.col(2) * R.col(2).dot(up)).normalized();
  R.col(1) = Vector3d(R.col(2)).cross(Vector3d(R.col(0)));
  const Eigen::Quaterniond q(R);
  core::EndState out;
  out.p_W = p_m, out.q_W = {q.w(), q.x(), q.y(), q.z()};
  return out;
}

/// A wire with a soft curved tip, pushed out of three places near the isocentre; some weights at its tip.
data::MeasurementSet seen_wire(Dice& dice, const BenchWire* wire) {
  data::MeasurementSet set;
  set.title = "seen by a pinhole camera", set.source = "tests";
  const double drawn = dice.log_uniform(6, 20), shaft = wire ? wire->declared_EI : drawn,
               tip = shaft * dice.uniform(0.12, 0.3), tip_mm = dice.uniform(20, 40), ratio = dice.uniform(0.7, 0.8),
               weight = dice.uniform(6e-4, 9e-4), side = dice.uniform(0, 2 * units::pi);
  const Vector2d bend = dice.uniform(10, 25) * Vector2d(std::cos(side), std::sin(side));
  set.instruments = {{"wire",
                      0.6,
                      0.178 * mm,
                      0,
                      {made_section(0, tip_mm, tip, ratio * tip, weight, bend, 0.178, 0),
                       made_section(tip_mm, 600, shaft, ratio * shaft, weight, {0, 0}, 0.178, 0)}}};
  if (wire)
    set.instruments[0] = {
        "wire", 1.5, 0.178 * mm, 0, {made_section(0, 1500, shaft, wire->declared_GJ, weight, {0, 0}, 0.178, 0)}};
  set.gravity_m_s2 = {0, 9.81, 0};
  set.imaging.noise_sigma_m = dice.uniform(0.4, 0.9);
  const core::EndState bases[] = {
      base_towards(Vector3d(-60, -20, -40) * mm, {0.87, 0, 0.5}, {0, 1, 0}),
      base_towards(Vector3d(-10, -20, -80) * mm, {0, dice.uniform(-0.4, 0.4), 0.94}, {0, 0.94, 0.3}),
      base_towards(Vector3d(50, -10, -40) * mm, {-0.87, 0, 0.5}, {0, 1, 0})};
  for (int i = 0; i < 12; ++i) {
    data::Experiment e;
    e.id = "x" + std::to_string(i);
    e.place = "experiments[" + std::to_string(i) + "]";
    e.kind = data::Experiment::Kind::projections;
    e.base = bases[i % 3];
    e.set = {{(90 + 90 * std::fmod(0.618 * i + 0.3, 1.0)) * mm, dice.uniform(-180, 180) * degree, 0}};
    e.specimen.resize(1);
    const double load = 0.25 * shaft * Nmm2 / (e.set[0].inserted_m * e.set[0].inserted_m);
    if (i % 3 != 0) e.tip_force_N = load * dice.uniform(0.5, 1.2) * dice.direction();
    set.experiments.push_back(e);
  }
  return set;
}

std::vector<Pinhole> two_views(Dice& dice) {
  std::vector<Pinhole> out(2);
  const bool down = dice.sign() > 0;
  out[0].primary_deg = dice.uniform(-50, -20), out[0].secondary_deg = dice.uniform(-20, 25);
  out[1].primary_deg = dice.uniform(30, 65), out[1].secondary_deg = dice.uniform(10, 30);
  for (Pinhole& c : out) {
    c.source_to_detector_m = dice.uniform(1.0, 1.15), c.source_to_isocentre_m = dice.uniform(0.74, 0.79);
    c.rows_down = down;
  }
  return out;
}

std::vector<data::MeasuredCArm> declared(const std::vector<Pinhole>& cameras) {
  std::vector<data::MeasuredCArm> out;
  for (const Pinhole& c : cameras) {
    data::MeasuredCArm arm;
    arm.id = std::string(1, static_cast<char>('A' + out.size()));
    arm.camera.source_m = c.source_m(), arm.camera.pixel_0_0_m = c.first_pixel_m();
    arm.camera.u = c.axes().row(0).transpose(), arm.camera.v = c.axes().row(1).transpose();
    arm.camera.pixel_m = c.pixel_m, arm.camera.columns = c.columns, arm.camera.rows = c.rows;
    out.push_back(arm);
  }
  return out;
}

/// False: not an effect of the picture's.
bool add_to_room(const std::string& id, Dice& dice, Undeclared& u, Room& room) {
  const int which = dice.whole(0, 2);  // 2: both
  std::vector<Pinhole*> some;
  for (int v = 0; v < 2; ++v)
    if (which == 2 || which == v) some.push_back(&room.cameras[v]);
  Pinhole& one = room.cameras[which % 2];
  const auto truth = [&](const char* name, double value) { u.truth[id + "." + name] = value; };
  if (id == "view_angle") {
    const double primary = dice.either(0.4, 2), secondary = dice.either(0.4, 2);
    one.primary_deg += primary, one.secondary_deg += secondary;
    truth("primary_deg", primary), truth("secondary_deg", secondary);
  } else if (id == "view_shift") {
    one.shift_px = {dice.either(3, 15), dice.either(3, 15)};
    truth("columns_px", one.shift_px.x()), truth("rows_px", one.shift_px.y());
  } else if (id == "source_distance") {
    const double by_mm = dice.either(25, 80);
    const bool source = dice.sign() > 0;
    for (Pinhole* c : some) (source ? c->source_back_m : c->detector_away_m) = by_mm * mm;
    truth(source ? "source_mm" : "detector_mm", by_mm);
  } else if (id == "pincushion") {
    const double k = dice.either(0.025, 0.08);
    for (Pinhole* c : some) c->barrel = k;
    truth("k", k);
  } else if (id == "s_distortion") {
    const double turn_deg = dice.either(1, 4);
    for (Pinhole* c : some) c->turn_at_edge = turn_deg * degree;
    truth("turn_deg", turn_deg);
  } else if (id == "table_sag") {  // the C-arm and all it sees stay; the table with the wire sinks
    const double sag_mm = dice.uniform(0.7, 4);
    for (Pinhole& c : room.cameras) c.isocentre_m.y() -= sag_mm * mm;
    truth("sag_mm", sag_mm);
  } else if (id == "gantry_flex") {
    const double primary = dice.either(0.015, 0.05), secondary = dice.either(0.015, 0.05);
    for (Pinhole& c : room.cameras) c.primary_deg *= 1 + primary, c.secondary_deg *= 1 + secondary;
    truth("primary_share", primary), truth("secondary_share", secondary);
  } else if (id == "second_plane_late") {
    room.fed_on_m = dice.either(2, 8) * mm;
    truth("insertion_mm", room.fed_on_m / mm);
  } else {
    return false;
  }
  return true;
}

/// Clicks at irregular places from the base to the tip, as far as the wire stays in the picture.
std::vector<Vector2d> clicked(const std::vector<Vector3d>& curve, const Pinhole& camera, double sigma_px, Dice& dice) {
  const int count = dice.whole(35, 55);
  std::vector<double> at = {0, 1};
  while (static_cast<int>(at.size()) < count) at.push_back(dice.uniform(0, 1));
  std::sort(at.begin(), at.end());
  std::vector<Vector2d> out;
  for (const double s : at) {
    const double along = s * static_cast<double>(curve.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(along), curve.size() - 2);
    const Vector3d p = curve[k] + (along - static_cast<double>(k)) * (curve[k + 1] - curve[k]);
    const Vector2d px = camera.picture_of(p) + sigma_px * dice.normals().head<2>();
    if (px.minCoeff() < 0 || px.x() > camera.columns - 1 || px.y() > camera.rows - 1) break;
    out.push_back(px);
  }
  return out;
}

Undeclared make(const BenchWire* wire, const std::string& kind, unsigned seed) {
  Dice dice(kind, seed);
  Undeclared u;
  u.set = seen_wire(dice, wire);
  Room room{two_views(dice), 0};
  u.set.views = declared(room.cameras);
  Truth truth;
  truth.stiffness_scale = {{dice.uniform(0.7, 1.3), dice.uniform(0.7, 1.3)}};
  if (wire) truth.stiffness_scale = {{wire->EI / wire->declared_EI}};
  World world;
  const std::string ids = kind.substr(std::string(in_views).size());
  for (std::size_t from = 0; ids != "clean" && from <= ids.size();) {
    const std::size_t to = std::min(ids.find('+', from), ids.size());
    const std::string id = ids.substr(from, to - from);
    if (add_to_room(id, dice, u, room))
      u.effects.push_back(id);
    else
      add_effect(id, dice, u, world);
    from = to + 1;
  }
  for (data::Experiment& e : u.set.experiments)
    for (int v = 0; v < 2; ++v) {
      boundary_value::Problem p = problem_of(u.set, e, truth);
      for (const auto& change : world.mechanics) change(e, p);
      if (v > 0) p.tubes.back().inserted_m += room.fed_on_m;
      const boundary_value::Solution exact = boundary_value::solve(p);
      if (!exact.converged) throw std::runtime_error("no boundary-value solution");
      std::vector<Vector3d> curve = exact.curve;
      for (Vector3d& q : curve)
        for (const auto& see : world.picture) q = see(e, q);
      const std::vector<Vector2d> points = clicked(curve, room.cameras[v], *u.set.imaging.noise_sigma_m, dice);
      if (points.size() > 4) e.polylines.push_back({v, points});
    }
  std::erase_if(u.set.experiments, [](const data::Experiment& e) { return e.polylines.empty(); });
  return u;
}

}  // namespace

Undeclared undeclared_in_views(const std::string& kind, unsigned seed) { return make(nullptr, kind, seed); }

data::MeasurementSet views_of(const BenchWire& wire, unsigned seed) {
  return make(&wire, std::string(in_views) + "clean", seed).set;
}

}  // namespace ostium::synthetic
