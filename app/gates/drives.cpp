#include "app/gates/drives.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "core/base/units.h"
#include "core/math/alignment.h"
#include "core/rod/initial_state.h"
#include "core/samples/steel_wire.h"
#include "data/catalogue/catalogue.h"

namespace ostium::app::gates {

using Eigen::Vector3d;

namespace {

using units::pi;
constexpr double wire_friction = 0.05, guide_friction = 0.1;

core::Rod rod_of(const std::vector<data::Instrument>& catalogue, const std::string& name) {
  const data::Instrument& instrument = find_instrument(catalogue, name);
  core::RodDescription d = rod_description(instrument, element_lengths(instrument));
  d.damping = {0.007, 0.0035, 1e-3};  // blood, and a polymer's
  return make_rod(d);
}

core::Model make_model(const TestVessel& vessel, bool with_guide, bool sweep) {
  const std::vector<data::Instrument> catalogue = data::load_catalogue();
  core::Model model;
  if (with_guide) model.rods.push_back(rod_of(catalogue, "guide-jr4-6f"));
  model.rods.push_back(rod_of(catalogue, "wire-014-workhorse"));
  if (with_guide) model.nestings = {{.outer = 0, .inner = 1, .friction = wire_friction}};
  core::SurfaceDescription wall = vessel.wall;
  wall.friction = guide_friction;
  model.surfaces = {std::make_shared<core::Surface>(make_surface(wall))};
  model.sweep = sweep;
  return model;
}

core::EndState entry(const TestVessel& vessel) {
  core::EndState at = core::along_x();
  at.p_W = vessel.entry_W;
  return at;
}

}  // namespace

Rehearsal::Rehearsal(const TestVessel& vessel, bool with_guide, bool sweep)
    : model(make_model(vessel, with_guide, sweep)),
      state(make_state_at_rest_shape(model, std::vector<core::EndState>(model.rods.size(), entry(vessel)),
                                     with_guide ? std::vector<double>{0, 0} : std::vector<double>{0})),
      scratch(model) {
  inputs.rods.resize(model.rods.size());
  inputs.surfaces.resize(1);
}

void Rehearsal::lay_wire(const std::vector<Vector3d>& way_W, double inserted_m) {
  const core::Rod& rod = model.rods[wire()];
  std::vector<double> inserted(model.rods.size(), 0);
  inserted.back() = inserted_m;
  core::EndState base = entry({.wall = {}, .entry_W = way_W[0], .ways_W = {}});
  Eigen::Quaterniond q = Eigen::Quaterniond(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]);
  q = core::rotation_between(q * Vector3d::UnitZ(), way_W[1] - way_W[0]) * q;
  base.q_W = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
  state = make_state(model, std::vector<core::EndState>(model.rods.size(), base), inserted);
  // Element by element, with each distal end on the path.
  core::RodState& s = state.rods[wire()];
  std::vector<Eigen::Vector4d> frames;
  Vector3d p = way_W[0];
  std::size_t next = 1;
  core::Rod inside = rod;
  cut(rod, inserted_m, s.first, inside);
  for (int j = 0; j < rod.elements; ++j) {
    if (j >= s.first) {
      const double length = inside.length.at(0)[j];
      while (next + 1 < way_W.size() && (way_W[next] - p).norm() < length) ++next;
      // The point of the segment ending at `next` that is `length` away.
      const Vector3d a = way_W[next - 1] - p, d = way_W[next] - way_W[next - 1];
      const double A = d.squaredNorm(), B = a.dot(d), C = a.squaredNorm() - length * length;
      const Vector3d to = p + a + (-B + std::sqrt(std::max(0.0, B * B - A * C))) / A * d;
      q = core::rotation_between(q * Vector3d::UnitZ(), to - p) * q;
      p += length * (q * Vector3d::UnitZ());
    }
    frames.emplace_back(q.w(), q.x(), q.y(), q.z());
  }
  core::Rod whole = rod;
  cut(rod, inserted_m, s.first, whole);
  lay_out(whole, frames, frames.back(), s);
  settle();
}

void Rehearsal::settle() {
  // The path has corners that a wire does not: with high viscous drag the wire settles against the walls without
  // bouncing.
  core::Model honey = model;
  for (core::Rod& rod : honey.rods) rod.damping.drag_across_N_s_m2 = rod.damping.drag_along_N_s_m2 = 50;
  scratch = core::Scratch(honey);
  const core::Inputs still{std::vector<core::RodInputs>(model.rods.size()),
                           {{.frame_before = frame, .frame_after = frame}}};
  for (int n = 0; n < 1000; ++n) core::step(honey, still, state, scratch, report);
  scratch = core::Scratch(model);
}

void Rehearsal::step(double beats_per_min) {
  core::SurfaceMotion& motion = inputs.surfaces[0];
  motion.frame_before = frame;
  frame = std::fmod(frame + 24 * model.step_s * beats_per_min / 60, 24);
  motion.frame_after = frame;
  core::step(model, inputs, state, scratch, report);
}

void judge(const Rehearsal& run, core::PenetrationOracle& judge, bool winding, Holding& holding) {
  judge.set_frame(run.frame);
  for (std::size_t r = 0; r < run.model.rods.size(); ++r) {
    const core::Rod& rod = run.model.rods[r];
    for (int i = run.state.rods[r].first + 1; i < rod.nodes(); ++i) {
      const Vector3d p = run.state.rods[r].position[i];
      const double radius = rod.radius.at(0)[i], distance = judge.distance_m(p, 1.5 * radius);
      const bool near = distance < radius;
      if (near) holding.deepest_m = std::max(holding.deepest_m, radius - distance);
      if ((winding || (near && radius - distance > 0.5 * radius)) && judge.winding(p) < 0.5) ++holding.escapes;
    }
  }
}

void follow_script(double t_s, Rehearsal& run) {
  const double cycle = std::fmod(t_s, 24);
  core::RodInputs &guide = run.inputs.rods[0], &wire = run.inputs.rods[1];
  wire.feed_m_s = cycle < 9 ? 0.05 : cycle < 12 ? 0.05 * std::sin(2 * pi * cycle) : cycle < 21 ? -0.05 : 0;
  guide.feed_m_s = cycle < 1 ? 0 : cycle < 8.5 ? 0.05 : cycle < 12 ? 0 : cycle < 19.5 ? -0.05 : 0;
  wire.base.turn_rate_W_rad_s = Vector3d(2 * pi * std::sin(pi * cycle), 0, 0);
  guide.base.turn_rate_W_rad_s = Vector3d(cycle > 7 && cycle < 9 ? 1.5 : 0, 0, 0);
}

Holding scripted_procedure(const TestVessel& vessel, double beats_per_min, double seconds) {
  Rehearsal run(vessel, true);
  core::PenetrationOracle truth(vessel.wall);
  Holding holding;
  const int steps = static_cast<int>(1e3 * seconds);
  for (int n = 0; n < steps; ++n) {
    follow_script(1e-3 * n, run);
    run.step(beats_per_min);
    if (run.report.trouble & ~static_cast<unsigned>(core::feed_stopped)) ++holding.troubled;
    if (n % 20 == 19) judge(run, truth, n % 2000 == 1999 || n + 1 == steps, holding);
  }
  return holding;
}

Holding random_drive(const TestVessel& vessel, std::uint64_t seed, double seconds, bool sweep) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const bool in_branch = seed % 2 == 1;
  Rehearsal run(vessel, !in_branch, sweep);
  if (in_branch) run.lay_wire(vessel.ways_W[seed / 2 % 2], uniform(0.40, 0.44));
  core::PenetrationOracle truth(vessel.wall);
  Holding holding;
  const double rate = uniform(60, 180);
  const int steps = static_cast<int>(1e3 * seconds);
  int redraw = 0;
  for (int n = 0; n < steps; ++n) {
    if (n == redraw) {
      for (core::RodInputs& rod : run.inputs.rods) {
        // Inwards more often than outwards, or the tool would soon be out of the body.
        rod.feed_m_s = uniform(-0.1, 0.2);
        rod.base.turn_rate_W_rad_s = Vector3d(2 * pi * uniform(-10, 10), 0, 0);
      }
      redraw += static_cast<int>(uniform(100, 1000));
    }
    run.step(rate);
    if (run.report.trouble & ~static_cast<unsigned>(core::feed_stopped)) ++holding.troubled;
    if (n % 50 == 49) judge(run, truth, n % 1000 == 999 || n + 1 == steps, holding);
  }
  return holding;
}

std::vector<data::GateResult> contact_in_vessel(bool quick) {
  const TestVessel vessel = test_vessel();
  // A node outside the vessel has no meaningful depth: the gate must fail.
  const auto depth_mm = [](const Holding& holding) {
    return holding.escapes > 0 ? std::numeric_limits<double>::infinity() : 1e3 * holding.deepest_m;
  };
  std::vector<data::GateResult> out{
      {"contact-vessel-script", depth_mm(scripted_procedure(vessel, 75, quick ? 3 : 24)), 0, 0.05, "mm"}};
  const int drives = quick ? 2 : 12;
  for (int seed = 0; seed < drives; ++seed)
    out.push_back({"contact-vessel-drive-" + std::to_string(seed),
                   depth_mm(random_drive(vessel, static_cast<std::uint64_t>(seed), quick ? 1.5 : 5)), 0, 0.178, "mm"});
  return out;
}

}  // namespace ostium::app::gates
