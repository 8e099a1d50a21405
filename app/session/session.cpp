#include "app/session/session.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <random>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "core/rod/introducer.h"
#include "data/load_error.h"
#include "vascular/beat/heart_cycle.h"

namespace ostium {

using Eigen::Vector3d;

namespace {

constexpr double wire_friction = 0.05;  // of a wire in a catheter: PTFE on steel, an estimate
constexpr double tip_length_m = 0.01;   // what counts as the tip for its force

/// 1 mm over the last 150 mm, growing to 4 mm.
std::vector<double> element_lengths(double length_m) {
  std::vector<double> from_tip;
  double sum = 0, length = 1e-3;
  while (sum < length_m - 1e-9) {
    if (sum > 0.15) length = std::min(4e-3, 1.02 * length);
    from_tip.push_back(std::min(length, length_m - sum));
    sum += from_tip.back();
  }
  if (from_tip.size() > 1 && from_tip.back() < 0.5e-3)
    from_tip[from_tip.size() - 2] += from_tip.back(), from_tip.pop_back();
  return {from_tip.rbegin(), from_tip.rend()};
}

Rod rod_of(const Instrument& instrument) {
  RodDescription d = rod_description(instrument, element_lengths(instrument.length_m));
  d.damping = {0.007, 0.0035, 1e-3};  // blood, and a polymer's (section.h)
  return make_rod(d);
}

bool has_lumen(const Instrument& instrument) { return instrument.inner_diameter_m > 0; }

/// Every pair of which one goes through the other's lumen.
std::vector<Nesting> nestings_of(const std::vector<SessionTool>& tools) {
  std::vector<Nesting> nestings;
  for (int inner = 1; inner < static_cast<int>(tools.size()); ++inner)
    for (int outer = 0; outer < inner; ++outer) {
      const Instrument &a = tools[outer].instrument, &b = tools[inner].instrument;
      if (!has_lumen(a) || !fits_inside(b, a)) continue;
      Nesting nesting{.outer = outer, .inner = inner, .friction = wire_friction};
      if (a.wire_lumen && a.wire_lumen->rapid_exchange) nesting.lumen_m = a.wire_lumen->length_m;
      nestings.push_back(nesting);
    }
  return nestings;
}

void require_order(const std::vector<SessionTool>& tools) {
  for (std::size_t i = 0; i < tools.size(); ++i)
    for (std::size_t j = i + 1; j < tools.size(); ++j)
      if (has_lumen(tools[j].instrument) && fits_inside(tools[i].instrument, tools[j].instrument))
        throw LoadError(fmt::format("{} ({}) goes inside {} ({}): list the outer tool first", tools[i].name,
                                    tools[i].instrument.name, tools[j].name, tools[j].instrument.name));
}

}  // namespace

SessionModel make_session(std::shared_ptr<const Vessel> vessel, std::vector<SessionTool> tools) {
  require_order(tools);
  SessionModel model;
  model.vessel = std::move(vessel);
  model.tools = std::move(tools);
  for (const SessionTool& tool : model.tools) model.rods.rods.push_back(rod_of(tool.instrument));
  model.rods.nestings = nestings_of(model.tools);
  model.rods.surfaces = {model.vessel->surface};
  try {
    check(model.rods);
  } catch (const std::invalid_argument& error) {
    throw LoadError(fmt::format("these tools cannot be used together: {}", error.what()));
  }
  return model;
}

// --- lists -----------------------------------------------------------------------------------------------------------

namespace {

SessionInputs inputs_for(const SessionModel& model) {
  SessionInputs inputs;
  inputs.tools.resize(model.tools.size());
  return inputs;
}

std::size_t rod_count(const State& state) {
  std::size_t count = 1;
  for_each_field(state, [&](const char*, const double*, int n) { count += static_cast<std::size_t>(n); });
  return count;
}

}  // namespace

std::size_t input_count(const SessionModel& model) { return input_names(model).size(); }

std::vector<std::string> input_names(const SessionModel& model) {
  const SessionInputs inputs = inputs_for(model);
  std::vector<std::string> names;
  const std::size_t of_tools = 2 * model.tools.size();
  for_each_input(inputs, [&](const char* name, const double*, int count) {
    const std::string tool = names.size() < of_tools ? model.tools[names.size() / 2].name + "." : "";
    for (int i = 0; i < count; ++i) names.push_back(tool + name + (count > 1 ? fmt::format("[{}]", i) : ""));
  });
  return names;
}

void put_inputs(const SessionInputs& inputs, double* row) {
  for_each_input(inputs, [&](const char*, const double* first, int count) { row = std::copy_n(first, count, row); });
}

void take_inputs(const double* row, SessionInputs& inputs) {
  for_each_input(inputs, [&](const char*, double* first, int count) {
    std::copy_n(row, count, first);
    row += count;
  });
}

std::uint64_t hash(const SessionState& state) {
  std::uint64_t h = hash(state.rods);
  for_each_part(state, [&](const char*, const double* first, int count) {
    h = XXH3_64bits_withSeed(first, static_cast<std::size_t>(count) * sizeof(double), h);
  });
  return h;
}

std::size_t state_count(const SessionModel& model) {
  const SessionState state = make_state(model, 0);
  std::size_t count = rod_count(state.rods);
  for_each_part(state, [&](const char*, const double*, int n) { count += static_cast<std::size_t>(n); });
  return count;
}

void put_state(const SessionState& state, double* row) {
  *row++ = std::bit_cast<double>(state.rods.step);
  const auto put = [&](const char*, const double* first, int count) { row = std::copy_n(first, count, row); };
  for_each_field(state.rods, put);
  for_each_part(state, put);
}

void take_state(const double* row, SessionState& state) {
  state.rods.step = std::bit_cast<std::uint64_t>(*row++);
  const auto take = [&](const char*, double* first, int count) {
    std::copy_n(row, count, first);
    row += count;
  };
  for_each_field(state.rods, take);
  for_each_part(state, take);
}

std::string first_difference(const SessionModel& model, const SessionState& a, const SessionState& b) {
  std::string found = first_difference(a.rods, b.rods);
  if (found.rfind("rod ", 0) == 0) {
    const std::size_t comma = found.find(',');
    found.insert(comma, " (" + model.tools[static_cast<std::size_t>(std::stoi(found.substr(4)))].name + ")");
  }
  std::vector<const double*> others;
  for_each_part(b, [&](const char*, const double* first, int) { others.push_back(first); });
  std::size_t next = 0;
  for_each_part(a, [&](const char* name, const double* first, int count) {
    const double* other = others[next++];
    for (int i = 0; i < count && found.empty(); ++i)
      if (std::bit_cast<std::uint64_t>(first[i]) != std::bit_cast<std::uint64_t>(other[i]))
        found = fmt::format("{}: {:.17g} != {:.17g}", name, first[i], other[i]);
  });
  return found;
}

// --- beginning -------------------------------------------------------------------------------------------------------

SessionState make_state(const SessionModel& model, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<EndState> bases;
  for (std::size_t r = 0; r < model.tools.size(); ++r) {
    EndState base = model.vessel->entry;
    if (seed) {
      const Eigen::Quaterniond q(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]);
      const Eigen::Quaterniond rolled = q * Eigen::AngleAxisd(2 * std::numbers::pi * uniform(), Vector3d::UnitZ());
      base.q_W = {rolled.w(), rolled.x(), rolled.y(), rolled.z()};
    }
    bases.push_back(base);
  }
  SessionState state;
  state.rods = make_state_at_rest_shape(model.rods, bases, std::vector<double>(model.tools.size(), 0));
  state.hands.resize(model.tools.size());
  if (seed && model.vessel->beats()) state.heart.phase = uniform();
  return state;
}

// --- a step ----------------------------------------------------------------------------------------------------------

SessionScratch::SessionScratch(const SessionModel& model) : rods(model.rods) {
  inputs.rods.resize(model.tools.size());
  inputs.surfaces.resize(1);
}

double vessel_frame(const Vessel& vessel, double phase) {
  return vessel.beats() ? phase * static_cast<double>(vessel.wall.frames.size()) : 0;
}

namespace {

void beat(const SessionModel& model, double rate_1_min, BeatState& heart, SurfaceMotion& motion) {
  motion.frame_before = vessel_frame(*model.vessel, heart.phase);
  const double rate = std::clamp(rate_1_min, least_rate_1_min, highest_rate_1_min);
  heart.phase += model.step_s() * phase_speed(heart.phase, rate);
  motion.frame_after = vessel_frame(*model.vessel, heart.phase);
  if (heart.phase >= 1) heart.phase -= 1, heart.beats += 1;
}

void move_hands(const SessionModel& model, const SessionInputs& inputs, SessionState& state, Inputs& core) {
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const ToolInputs& hand = inputs.tools[t];
    core.rods[t].feed_m_s = hand.advance_m_s;
    core.rods[t].base.turn_rate_W_rad_s = hand.turn_rad_s * axis(state.rods.rods[t].base);
    HandState& sum = state.hands[t];
    const double dt = model.step_s();
    sum.fed_m += dt * hand.advance_m_s, sum.path_m += dt * std::fabs(hand.advance_m_s);
    sum.turned_rad += dt * hand.turn_rad_s, sum.turn_path_rad += dt * std::fabs(hand.turn_rad_s);
  }
}

void count_xrays(const CArmInputs& in, double step_s, CArmState& state) {
  const bool cine = in.cine > 0, fluoroscopy = in.fluoroscopy > 0 && !cine;
  state.fluoroscopy_s += fluoroscopy ? step_s : 0;
  state.cine_s += cine ? step_s : 0;
  if (cine && !(state.cine > 0)) state.cine_runs += 1;
  state.fluoroscopy = in.fluoroscopy, state.cine = in.cine;
}

void report_tools(const SessionModel& model, const SessionState& state, SessionReport& report) {
  report.tools.assign(model.tools.size(), {});
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    ToolReport& tool = report.tools[t];
    tool.push_N = report.rods.rods[t].push_N, tool.torque_Nm = report.rods.rods[t].torque_Nm;
    tool.in_body = in_body(model.rods.rods[t], state.rods.rods[t]);
  }
  for (const Touch& touch : report.rods.touches) {
    ToolReport& tool = report.tools[static_cast<std::size_t>(touch.rod)];
    const double force = touch.normal_W_N.norm();
    tool.wall_force_N += force;
    ++tool.touches;
    if (model.rods.rods[static_cast<std::size_t>(touch.rod)].node_from_tip_m[static_cast<std::size_t>(touch.node)] <=
        tip_length_m)
      tool.tip_force_N += force;
  }
}

}  // namespace

void step(const SessionModel& model, const SessionInputs& inputs, SessionState& state, SessionScratch& scratch,
          SessionReport& report) {
  assert(inputs.tools.size() == model.tools.size());
  beat(model, inputs.rate_1_min, state.heart, scratch.inputs.surfaces[0]);
  move_hands(model, inputs, state, scratch.inputs);
  step(model.rods, scratch.inputs, state.rods, scratch.rods, report.rods);
  count_xrays(inputs.c_arm, model.step_s(), state.c_arm);
  report_tools(model, state, report);
}

double seconds(const SessionModel& model, const SessionState& state) {
  return model.step_s() * static_cast<double>(state.rods.step);
}

Vector3d tip(const SessionModel& model, const SessionState& state, int tool) {
  const Rod& rod = model.rods.rods[static_cast<std::size_t>(tool)];
  const RodState& s = state.rods.rods[static_cast<std::size_t>(tool)];
  return in_body(rod, s) ? Vector3d(s.position[rod.elements]) : Vector3d(s.base.p_W);
}

Vector3d tip_direction(const SessionModel& model, const SessionState& state, int tool) {
  const Rod& rod = model.rods.rods[static_cast<std::size_t>(tool)];
  const RodState& s = state.rods.rods[static_cast<std::size_t>(tool)];
  if (!in_body(rod, s)) return axis(s.base);
  return (s.position[rod.elements] - s.position[rod.elements - 1]).normalized();
}

}  // namespace ostium
