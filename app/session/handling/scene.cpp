#include "app/session/handling/scene.h"

#include <algorithm>
#include <cmath>

#include "app/session/model/outcome.h"
#include "core/model/rod_state.h"
#include "core/rod/introducer.h"
#include "fluoro/projection/c_arm.h"

namespace ostium::app {

namespace {

constexpr double thick_m = 0.7e-3;  // diameter: 0.035 in wires and the like

/// Distance from the access of the last branch before the ascending aorta, where the arch ends.
double arch_ends_m(const VesselIndex& way, int ascending, int spheres) {
  double end_m = 0;
  for (const vascular::TreeBranch& branch : way.branches())
    if (const int entry = way.entry(branch.name); entry >= 0 && !way.beyond(entry, ascending))
      for (int s = 0; s < spheres; ++s)
        if (way.beyond(ascending, s) && way.beyond(entry, s)) end_m = std::max(end_m, way.from_access_m(s));
  return end_m;
}

void map_way(const VesselIndex& way, HandlingMap& map) {
  std::vector<int> ostia;
  for (const char* name : {"LM", "RCA"})
    if (const int at = way.entry(name); at >= 0) ostia.push_back(at);
  const int ascending = way.place("ascending aorta");
  std::size_t count = 0;
  for (const vascular::TreeBranch& branch : way.branches()) count += branch.spheres.size();
  map.astray_m.assign(count, 0), map.aside.assign(count, 0), map.in_coronary_m.assign(count, 0);
  map.before_root.assign(count, 0), map.in_ventricle.assign(count, 0);
  if (ostia.empty() || ascending < 0) return;
  const double arch_m = arch_ends_m(way, ascending, static_cast<int>(count));
  for (int s = 0; s < static_cast<int>(count); ++s) {
    const auto i = static_cast<std::size_t>(s);
    const std::string& name = way.branches()[static_cast<std::size_t>(way.branch(s))].name;
    const int entry = way.entry(name);
    map.in_ventricle[i] = name == "left ventricle";
    map.before_root[i] = !way.beyond(s, ascending) && way.from_access_m(s) < arch_m;
    bool leads = name.ends_with("sinus") || map.in_ventricle[i];
    for (int ostium : ostia) {
      leads = leads || way.beyond(ostium, entry) || way.beyond(entry, ostium);
      if (way.beyond(s, ostium)) map.in_coronary_m[i] = way.from_access_m(s) - way.from_access_m(ostium);
    }
    map.aside[i] = !leads;
    if (!leads) map.astray_m[i] = std::max(0.0, way.from_access_m(s) - way.from_access_m(entry));
  }
}

/// Ends of the lesions that have no other lesion beyond them: side branches before these ends are the wrong way for a
/// wire.
std::vector<int> lesion_ends(const vascular::FlowTree& tree, const std::vector<Plan>& lesions) {
  std::vector<int> ends;
  for (const Plan& lesion : lesions)
    ends.push_back(lesion.path.cells[static_cast<std::size_t>(lesion.path.at(lesion.to_m).index)]);
  const std::vector<int> all = ends;
  std::erase_if(ends, [&](int end) {
    return std::any_of(all.begin(), all.end(),
                       [&](int other) { return other != end && tree.is_downstream(other, end); });
  });
  return ends;
}

void map_arteries(const SessionModel& model, HandlingMap& map) {
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  const std::size_t n = tree.cells.size();
  map.from_ostium_m.assign(n, 0), map.to_end_m.assign(n, 0), map.unplanned_m.assign(n, 0), map.healthy_m.assign(n, 0);
  map.behind_lesion.assign(n, 0);
  // Deeper than 1 cm, or past the middle of the left main.
  constexpr double deep_m = 10e-3;
  map.deep_m.assign(n, deep_m);
  const std::vector<int> ends = lesion_ends(tree, model.vessel->coronaries->lesions);
  const auto apart_m = [&](std::size_t c, std::size_t up) {
    return (tree.cells[c].length_m + tree.cells[up].length_m) / 2;
  };
  for (std::size_t c = 0; c < n; ++c) {
    const int upstream = tree.cells[c].upstream, own = static_cast<int>(c);
    const auto up = static_cast<std::size_t>(upstream);
    map.healthy_m[c] = tree.cells[c].healthy_m;
    map.from_ostium_m[c] = upstream < 0 ? tree.cells[c].length_m / 2 : map.from_ostium_m[up] + apart_m(c, up);
    bool planned = ends.empty();
    for (const int end : ends) {
      const bool behind = own != end && tree.is_downstream(own, end);
      map.behind_lesion[c] = map.behind_lesion[c] || behind;
      planned = planned || own == end || behind || tree.is_downstream(end, own);
    }
    map.unplanned_m[c] = planned ? 0 : (upstream < 0 ? 0 : map.unplanned_m[up]) + tree.cells[c].length_m;
  }
  for (std::size_t c = n; c-- > 0;)
    if (tree.cells[c].upstream >= 0) {
      const auto up = static_cast<std::size_t>(tree.cells[c].upstream);
      map.to_end_m[up] = std::max(map.to_end_m[up], map.to_end_m[c] + apart_m(c, up));
    }
  for (const vascular::FlowBranch& branch : tree.branches) {
    if (branch.name != "LM") continue;
    const double half_m = map.from_ostium_m[static_cast<std::size_t>(branch.last - 1)] / 2;
    for (std::size_t c = 0; c < n; ++c)
      if (static_cast<int>(c) == branch.first || tree.is_downstream(static_cast<int>(c), branch.first))
        map.deep_m[c] = std::min(deep_m, half_m);
  }
}

/// The artery's cell about where a sphere of the way lies; -1: in no artery.
int cell_at(const SessionModel& model, int sphere) {
  const VesselIndex& way = *model.vessel->way;
  const std::string& name = way.branches()[static_cast<std::size_t>(way.branch(sphere))].name;
  const vascular::FlowTree& tree = model.physiology.flow.tree;
  const auto branch =
      std::ranges::find_if(tree.branches, [&](const vascular::FlowBranch& one) { return one.name == name; });
  if (branch == tree.branches.end()) return -1;
  double along_m = way.from_access_m(sphere) - way.from_access_m(way.entry(name));
  int cell = branch->first;
  while (cell + 1 < branch->last && along_m > tree.cells[static_cast<std::size_t>(cell)].length_m)
    along_m -= tree.cells[static_cast<std::size_t>(cell++)].length_m;
  return cell;
}

/// Twist of the material about the rod's axis, summed over its joints.
double twist_rad(const core::Rod& rod, const core::RodState& state) {
  double sum = 0;
  const core::Field<4>& q = state.orientation;
  for (int i = state.first + 1; i < rod.elements; ++i) {
    const Eigen::Quaterniond a(q.at(0)[i - 1], q.at(1)[i - 1], q.at(2)[i - 1], q.at(3)[i - 1]),
        b(q.at(0)[i], q.at(1)[i], q.at(2)[i], q.at(3)[i]);
    const Eigen::Quaterniond r = a.conjugate() * b;
    sum += 2 * std::atan2(r.w() < 0 ? -r.z() : r.z(), std::fabs(r.w()));
  }
  return sum;
}

bool in_field(const CArmInputs& in, const Eigen::Vector3d& p) {
  const fluoro::CArm arm{.lao_rad = in.lao_rad, .cran_rad = in.cran_rad, .p_PI = in.p_PI};
  const auto at = project(arm, p);
  return at && at->cwiseAbs().maxCoeff() <= in.field_m / 2;
}

}  // namespace

HandlingMap::HandlingMap(const SessionModel& model) {
  map_way(*model.vessel->way, *this);
  if (model.has_patient()) map_arteries(model, *this);
}

double beyond_stent_m(const SessionModel& model, const SessionState& state) {
  constexpr double hard_atm = 10;
  const BalloonInBody own = balloon_in_body(state.coupling, state.treatment, {}, 0);
  if (!own || own.place->branch < 0 || !(own.state->pressure_Pa > hard_atm * 101325)) return 0;
  const auto& lesions = model.vessel->coronaries->lesions;
  double out_m = 0;
  for (int i = 0; i < static_cast<int>(lesions.size()); ++i) {
    const auto stents = stented(model, state, i);
    const auto at = balloon_from_lesion_m(model, state, i, own.place->tool);
    if (!stents || !at) continue;
    const Plan& plan = lesions[static_cast<std::size_t>(i)];
    const double half_m = model.treatment.balloons[static_cast<std::size_t>(own.place->balloon)].length_m / 2;
    const double middle_m = *at + (plan.to_m - plan.from_m) / 2;
    const double from_m = middle_m - half_m;
    double to_m = middle_m + half_m;
    // What lies in a side branch, through a cell of the stent, is no part of the lesion's artery.
    const vascular::VesselPath& way = model.treatment.paths[static_cast<std::size_t>(own.place->branch)];
    for (; to_m > from_m && !same_vessel(way, plan.path, plan.from_m + to_m); to_m -= 0.1e-3) {
    }
    if (to_m < stents->from_m || from_m > stents->to_m) continue;
    out_m = std::max({out_m, stents->from_m - from_m, to_m - stents->to_m});
  }
  return out_m;
}

int tip_branch(const HandlingMap& map, const VesselIndex& way, int sphere, const Eigen::Vector3d& p, double phase,
               double breath) {
  const int branch = way.branch(sphere);
  return map.aside[static_cast<std::size_t>(sphere)] && way.in_parent(sphere, p, phase, breath)
             ? way.branches()[static_cast<std::size_t>(branch)].parent
             : branch;
}

void see(const SessionModel& model, const HandlingMap& map, const SessionInputs& inputs, const SessionState& state,
         const SessionReport& report, HandlingScene& x) {
  x.time_s = seconds(model, state);
  const double phase = state.blood.heart.phase;
  x.diastasis = heart_rests(state);
  x.beam = inputs.c_arm.beam();
  x.injects = inputs.delivery.injection_m3_s > 0;
  x.gauge_atm = inputs.delivery.gauge_Pa / 101325;
  x.tools.resize(model.tools.size());
  x.catheter = x.thick_wire = x.thin_wire = x.device = -1;
  x.thin_wires = 0, x.wire_tip_m = 0;
  for (int t = 0; t < static_cast<int>(model.tools.size()); ++t) {
    const auto i = static_cast<std::size_t>(t);
    HandledTool& tool = x.tools[i];
    tool = {.in_body = report.tools[i].in_body,
            .inserted_m = state.rods.rods[i].inserted_m,
            .fed_m = state.hands[i].fed_m,
            .feed_m_s = inputs.tools[i].feed_m_s,
            .turn_rad_s = inputs.tools[i].turn_rad_s,
            .push_N = report.tools[i].push_N};
    if (!tool.in_body) continue;
    tool.sphere = model.vessel->way->locate(tip(model, state, t), phase, breath(model, state));
    tool.branch = tip_branch(map, *model.vessel->way, tool.sphere, tip(model, state, t), phase, breath(model, state));
    tool.along_m = model.vessel->way->from_access_m(tool.sphere);
    const data::Instrument& instrument = model.tools[i].instrument;
    if (is_catheter(instrument) && x.catheter < 0) x.catheter = t;
    if (model.balloon_of[i] >= 0) x.device = t;
    if (instrument.kind != data::InstrumentKind::wire) continue;
    if (instrument.outer_diameter_m >= thick_m) {
      x.thick_wire = t;
      continue;
    }
    ++x.thin_wires;
    x.wire_tip_m = std::max(x.wire_tip_m, tool.inserted_m);
    if (x.thin_wire < 0 || tool.feed_m_s != 0 || tool.turn_rad_s != 0) x.thin_wire = t;  // of several, the one in hand
  }
  const CouplingState& b = state.coupling;
  const BalloonInBody own = balloon_in_body(b, state.treatment, inputs.delivery, 0);
  x.filled = own && !is_empty(model.treatment.balloons[static_cast<std::size_t>(own.place->balloon)], *own.state);
  x.balloon = own ? own.place->balloon : -1;
  x.beyond_stent_m = x.balloon < 0 ? 0 : beyond_stent_m(model, state);
  x.ST_mV = x.balloon < 0 ? 0 : ST_shift_mV(model.physiology.ischaemia, state.blood.ischaemia);
  x.guide_trace = b.guide >= 0 ? state.blood.line.trace : vascular::Trace::absent;
  x.wire_cell = x.thin_wire < 0 || !model.has_patient() ? -1
                : x.thin_wires > 1 ? cell_at(model, x.tools[static_cast<std::size_t>(x.thin_wire)].sphere)
                                   : b.wire_cell;
  x.catheter_cell =
      x.catheter >= 0 && model.has_patient() && b.tip.where == vascular::TipPlace::coronary ? b.tip.cell : -1;
  x.thin_tip_is_seen = x.beam && x.thin_wire >= 0 && in_field(inputs.c_arm, tip(model, state, x.thin_wire));
  x.twist_rad = x.catheter < 0 ? 0
                               : twist_rad(model.rods.rods[static_cast<std::size_t>(x.catheter)],
                                           state.rods.rods[static_cast<std::size_t>(x.catheter)]);
}

}  // namespace ostium::app
