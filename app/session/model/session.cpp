#include "app/session/model/session.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

#include "app/session/coupling/artery_loads.h"
#include "app/session/coupling/device_constraints.h"
#include "app/session/model/tool_nesting.h"
#include "core/base/units.h"
#include "core/rod/initial_state.h"
#include "core/rod/introducer.h"
#include "data/formats/load_error.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::app {

using Eigen::Vector3d;

namespace {

constexpr double tip_length_m = 0.01;  // length over which the tip force is summed

core::Rod rod_of(const data::Instrument& instrument) {
  core::RodDescription d = rod_description(instrument, element_lengths(instrument));
  d.damping = {0.007, 0.0035, 1e-3};  // blood, and a polymer's (section.h)
  return make_rod(d);
}

std::shared_ptr<const core::Surface> with_friction(core::Surface surface, double friction) {
  surface.friction = friction;
  return std::make_shared<core::Surface>(std::move(surface));
}

}  // namespace

SessionModel make_session(std::shared_ptr<const Vessel> vessel, std::vector<SessionTool> tools,
                          const SessionOptions& options) {
  require_nesting(tools);
  SessionModel model;
  model.vessel = std::move(vessel);
  model.tools = std::move(tools);
  model.entry = options.begin.empty() ? model.vessel->entry : entry_ahead_of(options.begin, *model.vessel);
  if (!model.vessel->wall.sway.empty()) model.breaths_1_min = options.breaths_1_min;
  if (model.has_patient()) {
    model.physiology = model.vessel->coronaries->physiology;
    model.treatment = model.vessel->coronaries->treatment;
    model.treatment.injury.seed = model.treatment.thrombus.seed = model.treatment.drugs.seed = options.seed;
    model.treatment.drugs.others = options.drugs;
    model.balloon_of = add_devices(model.tools, options.seed, model.treatment);
    if (options.arteries_yield)
      model.bed = vascular::make_artery_bed(model.physiology.flow.tree, model.vessel->arteries);
  } else {
    model.balloon_of.assign(model.tools.size(), -1);
  }
  model.physiology.ischaemia = vascular::ischaemia_of(options.seed);
  model.physiology.awareness = vascular::awareness_of(options.seed);
  model.physiology.heart = vascular::heart_of(options.seed, model.physiology.heart);
  for (const SessionTool& tool : model.tools) model.rods.rods.push_back(rod_of(tool.instrument));
  model.rods.nestings = nestings_of(model.tools);
  model.rods.surfaces = {options.friction ? with_friction(*model.vessel->surface, *options.friction)
                                          : model.vessel->surface};
  try {
    check(model.rods);
  } catch (const std::invalid_argument& error) {
    throw data::LoadError(fmt::format("these tools cannot be used together: {}", error.what()));
  }
  return model;
}

// --- lists -----------------------------------------------------------------------------------------------------------

SessionInputs inputs_at_rest(const SessionModel& model) {
  SessionInputs inputs;
  inputs.tools.resize(model.tools.size());
  inputs.c_arm.p_PI = model.vessel->p_middle;
  inputs.rate_1_min = model.vessel->rate_1_min;
  return inputs;
}

std::size_t input_count(const SessionModel& model) { return core::count_fields(inputs_at_rest(model)); }

std::vector<std::string> input_names(const SessionModel& model) {
  const SessionInputs inputs = inputs_at_rest(model);
  std::vector<std::string> names;
  core::for_each_number(inputs, [&](const core::FieldPath& path, auto numbers) {
    const int tool = path.outer->index;
    const std::string owner = tool < 0 ? "" : model.tools[static_cast<std::size_t>(tool)].name + ".";
    for (std::size_t i = 0; i < numbers.size(); ++i)
      names.push_back(owner + path.name + (numbers.size() > 1 ? fmt::format("[{}]", i) : ""));
  });
  return names;
}

void put_inputs(const SessionInputs& inputs, double* row) { core::put_fields(inputs, row); }
void take_inputs(const double* row, SessionInputs& inputs) { core::take_fields(row, inputs); }

std::uint64_t hash(const SessionState& state) {
  std::uint64_t h = hash(state.rods);
  core::for_each_field(state, [&](const char*, const auto& part) {
    // Rods have their own hash, which excludes what is outside the body.
    if constexpr (!std::is_same_v<std::decay_t<decltype(part)>, core::State>) h = core::hash_fields(part, h);
  });
  return h;
}

std::size_t state_count(const SessionModel& model) { return core::count_fields(make_state(model, 0)); }
void put_state(const SessionState& state, double* row) { core::put_fields(state, row); }
void take_state(const double* row, SessionState& state) { core::take_fields(row, state); }

std::string first_difference(const SessionModel& model, const SessionState& a, const SessionState& b) {
  std::string found = first_difference(a.rods, b.rods);
  if (found.empty()) return core::first_different_field(a, b);
  if (found.rfind("rod ", 0) == 0) {
    const std::size_t comma = found.find(',');
    found.insert(comma, " (" + model.tools[static_cast<std::size_t>(std::stoi(found.substr(4)))].name + ")");
  }
  return found;
}

// --- beginning -------------------------------------------------------------------------------------------------------

SessionState make_state(const SessionModel& model, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::vector<core::EndState> bases;
  for (std::size_t r = 0; r < model.tools.size(); ++r) {
    core::EndState base = model.entry;
    if (seed) {
      const Eigen::Quaterniond q(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]);
      const Eigen::Quaterniond rolled = q * Eigen::AngleAxisd(2 * units::pi * uniform(), Vector3d::UnitZ());
      base.q_W = {rolled.w(), rolled.x(), rolled.y(), rolled.z()};
    }
    bases.push_back(base);
  }
  SessionState state;
  state.rods = make_state_at_rest_shape(model.rods, bases, std::vector<double>(model.tools.size(), 0));
  state.hands.resize(model.tools.size());
  const double begins_at = seed && model.vessel->beats() ? uniform() : 0;
  if (!model.has_patient()) {
    state.blood.heart.phase = begins_at;
    return state;
  }
  state.blood = model.vessel->coronaries->at_rest;
  state.treatment = make_state(model.treatment, model.physiology.flow.tree);
  state.coupling = make_coupling(*model.vessel);
  for (const vascular::FlowCell& cell : model.physiology.flow.tree.cells) state.wall_m.push_back(cell.diseased_m);
  if (model.bed) state.bed.aside_P = state.wall_aside_P = std::vector<Vector3d>(state.wall_m.size(), Vector3d::Zero());
  vascular::PhysiologyScratch scratch;
  vascular::PhysiologyInputs inputs;
  inputs.heart.rate_1_min = model.vessel->rate_1_min;
  while (state.blood.heart.phase < begins_at) step(model.physiology, inputs, model.step_s(), state.blood, scratch);
  state.blood.heart.time_s = 0, state.blood.heart.beats = 0;
  return state;
}

// --- a step ----------------------------------------------------------------------------------------------------------

const char* phase_name(int phase) {
  static constexpr const char* own[] = {"heart, hands, wall", "look", "treat", "blood", "hash"};
  constexpr int first = core::step_phases;
  static_assert(std::size(own) == std::size_t{session_phases} - first);
  return phase < first ? core::step_phase_names[phase] : own[phase - first];
}

namespace {

CouplingModel coupling_of(const SessionModel& model) {
  return {*model.vessel, model.tools, model.rods, model.physiology, model.treatment, model.balloon_of};
}

/// What instruments, drugs, bleeding and lack of blood do to the heart; in a mesh it beats for itself.
vascular::HeartInputs heart_inputs(const SessionModel& model, const SessionInputs& inputs, const SessionState& state,
                                   double breath) {
  vascular::HeartInputs heart{.rate_1_min = inputs.rate_1_min, .irritation = state.coupling.irritation};
  if (!model.has_patient()) return heart;
  heart.body.breath = breath;
  act(model.treatment.drugs, state.treatment.drugs, heart.body);
  burden(model.physiology, state.blood, heart.body);
  heart.body.leak_m3_s = leak_m3_s(state.treatment), heart.body.reflexes = true;
  heart.body.drawn_m3_s = drawn_m3_s(coupling_of(model), inputs.delivery, state.coupling);
  heart.compressions_1_min = inputs.delivery.compressions_1_min;
  heart.pacing_1_min = inputs.delivery.pacing_1_min, heart.pacing_mA = inputs.delivery.pacing_mA;
  heart.body.infusion_m3_s = inputs.delivery.infusion_m3_s, heart.body.drain_m3_s = inputs.delivery.drain_m3_s;
  return heart;
}

/// Advances heart and breath, and moves the wall. Returns true at an R wave.
bool beat(const SessionModel& model, const SessionInputs& inputs, SessionState& state, core::SurfaceMotion& motion) {
  vascular::HeartState& heart = state.blood.heart;
  const int beats = heart.beats;
  motion.frame_before = vessel_frame(*model.vessel, heart.phase);
  motion.sway_before = breath(model, state);
  const int asked = std::clamp(inputs.delivery.breath_asked, 0, 2);
  step(model.breaths_1_min, static_cast<vascular::BreathAsked>(asked), state.blood.awareness.awake, model.step_s(),
       state.breath);
  motion.sway_after = breath(model, state);
  step(model.physiology.heart, heart_inputs(model, inputs, state, motion.sway_after), model.step_s(), heart);
  motion.door_open = vascular::valve_is_open(heart.phase) || state.coupling.through_valve;
  motion.frame_after = vessel_frame(*model.vessel, heart.phase + (heart.beats - beats));
  return heart.beats > beats;
}

/// The inputs a tool may follow: it cannot enter beside a tool that it is not nested with, nor pass an unexpanded
/// stent.
ToolInputs allowed(const SessionModel& model, const SessionState& state, int tool, const ToolInputs& hand,
                   SessionReport& report) {
  if (!(hand.feed_m_s > 0)) return hand;
  ToolInputs out = hand;
  const auto t = static_cast<std::size_t>(tool);
  if (!in_body(model.rods.rods[t], state.rods.rods[t]))
    if (const Obstacle other = in_the_way(model, state.rods, tool); other.tool >= 0)
      out = {}, report.refused = tool, report.in_its_way = other.tool;
  if (const int place = place_of(state.coupling, tool); place >= 0 && state.coupling.balloons[place].blocked)
    out.feed_m_s = 0;
  return out;
}

void move_hands(const SessionModel& model, const SessionInputs& inputs, SessionState& state, SessionReport& report,
                core::Inputs& core) {
  report.refused = report.in_its_way = -1;
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const ToolInputs hand = allowed(model, state, static_cast<int>(t), inputs.tools[t], report);
    core.rods[t].feed_m_s = hand.feed_m_s;
    core.rods[t].base.turn_rate_W_rad_s = hand.turn_rad_s * axis(state.rods.rods[t].base);
    HandState& sum = state.hands[t];
    const double dt = model.step_s(), in_m = state.rods.rods[t].inserted_m;
    const double fed_m = std::clamp(in_m + dt * hand.feed_m_s, 0.0, model.rods.rods[t].total_length_m) - in_m;
    sum.fed_m += fed_m, sum.path_m += std::fabs(fed_m);
    sum.turned_rad += dt * hand.turn_rad_s, sum.turn_path_rad += dt * std::fabs(hand.turn_rad_s);
  }
}

void hold_shafts(const SessionModel& model, const SessionState& state, core::Inputs& core) {
  const CouplingModel coupling = coupling_of(model);
  const vascular::LumenMoment end = moment(model, state);
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    const int tool = static_cast<int>(t);
    core.rods[t].load = load_on_shaft(coupling, state.rods, state.coupling, tool);
    core.rods[t].tethers = tethers_on_shaft(coupling, state.rods, state.treatment, state.coupling, tool, end);
  }
}

/// Ties deployed stents to the wall, with which they move from then on; one ring a step.
void tie_stents(const SessionModel& model, SessionState& state) {
  for (std::size_t n = 0; n < state.treatment.stents.size(); ++n) {
    vascular::StentState& stent = state.treatment.stents[n];
    if (stent.where == vascular::StentState::deployed && stent.branch >= 0 &&
        model.vessel->coronaries->ties->tie_next(
            model.treatment.stents[n], model.treatment.paths[static_cast<std::size_t>(stent.branch)],
            state.treatment.wall, {.phase = state.blood.heart.phase, .aside_P = state.wall_aside_P}, stent))
      return;
  }
}

/// Advances balloon and stent, then blood and contrast, with the rods' current positions.
void treat(const SessionModel& model, const SessionInputs& inputs, bool R_wave, SessionState& state, SessionScratch& x,
           SessionReport& report) {
  const CouplingModel coupling = coupling_of(model);
  const core::InPhase phase(x.rods.clock, treating);
  if (state.rods.step % look_every == 0) {
    const core::InPhase look_phase(x.rods.clock, looking);
    look(coupling, state.rods, state.treatment, report.rods, moment(model, state), *x.coupling, state.coupling);
  }
  press_with_wire(coupling, report.rods, model.step_s(), state.coupling);
  report.treatment = step(
      model.treatment,
      treatment_inputs(coupling, state.rods, state.treatment, inputs.delivery, moment(model, state), state.coupling),
      model.step_s(), state.treatment, {model.physiology.flow, state.blood, x.physiology_inputs.occupied_m},
      x.treatment);
  for (int k = 0; k < vascular::most_balloons; ++k) state.coupling.balloons[k].blocked = report.treatment.blocked[k];
  if (model.bed && state.rods.step % look_every == 0) {
    find_artery_loads(coupling, report.rods, state.treatment, report.treatment, state.blood.heart.phase, state.coupling,
                      *x.coupling);
    give_way(*model.bed, look_every * model.step_s(), *x.coupling, state.bed, state.wall_aside_P);
  }
  tie_stents(model, state);
  set_physiology_inputs(coupling, inputs.delivery, state.coupling, x.physiology_inputs);
  x.physiology_inputs.hyperaemia = state.treatment.drugs.adenosine;
  const core::InPhase blood_phase(x.rods.clock, moving_blood);
  const bool blood_moves = state.blood.circulation_s + model.step_s() >= vascular::circulation_step_s * (1 - 1e-9);
  const vascular::ContrastReport contrast =
      circulate(model.physiology, x.physiology_inputs, model.step_s(), R_wave, state.blood, x.physiology);
  if (blood_moves) report.contrast = contrast;
  follow_lumen(model.physiology.flow.tree, state.blood.radius_m, state.coupling.wall_cursor, state.wall_m);
}

void count_xrays(const CArmInputs& in, double step_s, CArmState& state) {
  const bool cine = in.cine, fluoroscopy = in.fluoroscopy && !cine;
  state.fluoroscopy_s += fluoroscopy ? step_s : 0;
  state.cine_s += cine ? step_s : 0;
  if (cine && !state.cine) state.cine_runs += 1;
  state.fluoroscopy = in.fluoroscopy, state.cine = in.cine;
}

void report_tools(const SessionModel& model, const SessionState& state, SessionReport& report) {
  report.tools.assign(model.tools.size(), {});
  for (std::size_t t = 0; t < model.tools.size(); ++t) {
    ToolReport& tool = report.tools[t];
    tool.push_N = report.rods.rods[t].push_N, tool.torque_Nm = report.rods.rods[t].torque_Nm;
    tool.in_body = in_body(model.rods.rods[t], state.rods.rods[t]);
  }
  for (const core::Touch& touch : report.rods.touches) {
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

double breath(const SessionModel& model, const SessionState& state) {
  return model.breaths_1_min > 0 ? vascular::breath_depth(state.breath.phase) : 0;
}

void step(const SessionModel& model, const SessionInputs& inputs, SessionState& state, SessionScratch& scratch,
          SessionReport& report) {
  assert(inputs.tools.size() == model.tools.size());
  const core::InPhase phase(scratch.rods.clock, moving_heart);
  const bool R_wave = beat(model, inputs, state, scratch.inputs.surfaces[0]);
  if (model.has_patient()) scratch.set_wall(model, state.wall_m, state.wall_aside_P);
  move_hands(model, inputs, state, report, scratch.inputs);
  if (model.has_patient()) hold_shafts(model, state, scratch.inputs);
  step(scratch.now, scratch.inputs, state.rods, scratch.rods, report.rods);
  count_xrays(inputs.c_arm, model.step_s(), state.c_arm);
  report_tools(model, state, report);
  if (model.has_patient()) treat(model, inputs, R_wave, state, scratch, report);
}

double waist(const vascular::BalloonModel& model, const vascular::BalloonState& state) {
  double least = 1, most = 0;
  for (int i = 0; i < vascular::balloon_spheres; ++i)
    if (sphere_share(model, i) == 1)
      least = std::min(least, state.radius_m[i]), most = std::max(most, state.radius_m[i]);
  return most > 0 ? least / most : 1;
}

double seconds(const SessionModel& model, const SessionState& state) {
  return model.step_s() * static_cast<double>(state.rods.step);
}

Vector3d tip(const SessionModel& model, const SessionState& state, int tool) {
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(tool)];
  const core::RodState& s = state.rods.rods[static_cast<std::size_t>(tool)];
  return in_body(rod, s) ? Vector3d(s.position[rod.elements]) : Vector3d(s.base.p_W);
}

Vector3d tip_direction(const SessionModel& model, const SessionState& state, int tool) {
  const core::Rod& rod = model.rods.rods[static_cast<std::size_t>(tool)];
  const core::RodState& s = state.rods.rods[static_cast<std::size_t>(tool)];
  if (!in_body(rod, s)) return axis(s.base);
  return (s.position[rod.elements] - s.position[rod.elements - 1]).normalized();
}

}  // namespace ostium::app
