#include "vascular/treatment/thrombus.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"

namespace ostium::vascular {

namespace {

constexpr std::uint64_t forms = 52, firmness = 53;  // streams of random numbers
constexpr double still_m_s = 0.05, reach_m = 10e-3, aspirates_s = 4, of_drawn_m3_s = 4e-6;
constexpr double least_m3 = 1e-12;
constexpr double yields = 1.15;  // it is pressed together by so much before any of it leaves: a shaft that sways in the
                                 // beating artery presses none out

const FlowBranch& branch_of(const FlowTree& tree, int cell) {
  return tree.branches[static_cast<std::size_t>(tree.cells[static_cast<std::size_t>(cell)].branch)];
}

/// Calls `f(cell)` for the cells that a thrombus in the middle of `cell` lies in.
template <class F>
void for_each_cell(const ThrombusModel& model, const FlowTree& tree, int cell, F f) {
  const FlowBranch& branch = branch_of(tree, cell);
  const double middle = tree.s_of(cell);
  for (int c = branch.first; c < branch.last; ++c)
    if (std::fabs(tree.s_of(c) - middle) <= model.length_m / 2) f(static_cast<std::size_t>(c));
}

double free_of(const ThrombusInputs& in, std::size_t cell) {
  return free_area_m2(in.radius_m[cell], in.devices_m.empty() ? 0 : in.devices_m[cell]);
}

/// Volume that devices leave in the stretch of a thrombus, m3.
double room_m3(const ThrombusModel& model, const ThrombusInputs& in, int cell) {
  double room = 0;
  for_each_cell(model, in.flow.tree, cell,
                [&](std::size_t c) { room += free_of(in, c) * in.flow.tree.cells[c].length_m; });
  return room;
}

/// Where blood from the middle of a branch goes: its end's widest daughter by flow; -1: into the muscle.
int next_branch(const FlowTree& tree, int branch, const FlowState& blood) {
  const int end = tree.branches[static_cast<std::size_t>(branch)].last - 1;
  int best = -1;
  for (int k = tree.side_first[static_cast<std::size_t>(end)]; k < tree.side_first[static_cast<std::size_t>(end) + 1];
       ++k) {
    const int side = tree.sides[static_cast<std::size_t>(k)];
    const auto flow = [&](int b) {
      return blood.flow_m3_s[static_cast<std::size_t>(tree.branches[static_cast<std::size_t>(b)].first)];
    };
    if (best < 0 || flow(side) > flow(best)) best = side;
  }
  return best;
}

/// The cell, beyond what is squeezed, where a lump of this radius comes to rest: in a narrower lumen, or where the
/// last branch ends.
int lodges_at(const ThrombusModel& model, const ThrombusInputs& in, int from, double radius_m, const FlowState& blood) {
  const FlowTree& tree = in.flow.tree;
  int branch = tree.cells[static_cast<std::size_t>(from)].branch, last = from;
  double begin_m = tree.s_of(from) + model.length_m;
  for (; branch >= 0; branch = next_branch(tree, branch, blood), begin_m = 0) {
    const FlowBranch& b = tree.branches[static_cast<std::size_t>(branch)];
    for (int c = b.first; c < b.last; ++c) {
      if (tree.s_of(c) < begin_m) continue;
      last = c;
      if (in.radius_m[static_cast<std::size_t>(c)] < radius_m &&
          (in.devices_m.empty() ||
           in.devices_m[static_cast<std::size_t>(c)] < 0.5 * in.radius_m[static_cast<std::size_t>(c)]))
        return c;
    }
  }
  return last;
}

void scatter(const ThrombusModel& model, const ThrombusInputs& in, int from, double volume, ThrombusState& s,
             FlowState& blood) {
  const FlowTree& tree = in.flow.tree;
  const int own = tree.cells[static_cast<std::size_t>(from)].branch;
  const auto below = [&](int b) {
    return b == own || tree.is_downstream(tree.branches[static_cast<std::size_t>(b)].first, from);
  };
  // By need, so that each muscle below loses the same share.
  double all = 0;
  for (std::size_t c = 0; c < tree.cells.size(); ++c)
    if (below(tree.cells[c].branch)) all += in.flow.need_m3_s[c];
  s.dust_m3 += volume;
  if (all <= 0) return;
  const double open = std::exp(-volume / (model.dust_s * all));
  for (std::size_t b = 0; b < tree.branches.size(); ++b)
    if (below(static_cast<int>(b))) blood.no_reflow[b] = 1 - (1 - blood.no_reflow[b]) * open;
}

/// Of a thrombus already in the stretch, or a free place; null: there is none.
Thrombus* place_for(const ThrombusModel& model, const FlowTree& tree, int cell, ThrombusState& s) {
  Thrombus* free = nullptr;
  for (Thrombus& one : s.thrombi) {
    if (one.cell < 0) free = free ? free : &one;
    if (one.cell >= 0 &&
        tree.cells[static_cast<std::size_t>(one.cell)].branch == tree.cells[static_cast<std::size_t>(cell)].branch &&
        std::fabs(tree.s_of(one.cell) - tree.s_of(cell)) < model.length_m / 2)
      return &one;
  }
  return free;
}

void add(const ThrombusModel& model, double volume, Thrombus& to, const ThrombusState& s) {
  to.m3 += volume;
  to.firm_m3 += (0.25 + 0.5 * core::uniform(model.seed, firmness, static_cast<std::uint64_t>(s.formed))) * volume;
}

void embolise(const ThrombusModel& model, const ThrombusInputs& in, double volume, Thrombus& from, ThrombusState& s,
              FlowState& blood) {
  const int cell = from.cell;
  s.embolised_m3 += volume;
  from.firm_m3 *= 1 - volume / from.m3, from.m3 -= volume;
  double dust = volume / 2;
  const double lump = volume - dust, radius = std::cbrt(3 * lump / (4 * units::pi));
  const int at = lodges_at(model, in, cell, radius, blood);
  Thrombus* to = at == cell ? nullptr : place_for(model, in.flow.tree, at, s);
  if (to && to != &from) {
    if (to->cell < 0) to->cell = at;
    add(model, lump, *to, s);
  } else {
    dust = volume;
  }
  scatter(model, in, cell, dust, s, blood);
}

/// Distance downstream of a tip, m; negative: it is not.
double beyond_m(const FlowTree& tree, int cell, int tip_cell) {
  double length = 0;
  for (int c = cell; c >= 0; c = tree.cells[static_cast<std::size_t>(c)].upstream) {
    if (c == tip_cell) return length;
    length += tree.cells[static_cast<std::size_t>(c)].length_m;
  }
  return -1;
}

/// The cell beside a device where blood stands most; -1: no device lies in an artery.
int slowest(const ThrombusInputs& in, const FlowState& blood, double& stands) {
  int at = -1;
  for (std::size_t c = 0; c < in.devices_m.size(); ++c) {
    if (in.devices_m[c] <= 0) continue;
    const double here = standing(blood.flow_m3_s[c], free_of(in, c));
    if (at < 0 || here > stands) at = static_cast<int>(c), stands = here;
  }
  return at;
}

void shrink_or_grow(const ThrombusModel& model, const ThrombusInputs& in, double rate, double dt, Thrombus& one,
                    ThrombusState& s, FlowState& blood) {
  const auto cell = static_cast<std::size_t>(one.cell);
  const double room = room_m3(model, in, one.cell);
  if (one.m3 > yields * room) embolise(model, in, one.m3 - room, one, s, blood);
  const double stands = standing(blood.flow_m3_s[cell], free_of(in, cell));
  const double more = std::min(model.grows_m3_s * rate * (1 + 4 * stands) * dt, std::max(0.0, room - one.m3));
  if (more > 0) one.m3 += more, s.grown_m3 += more;
  if (in.drawn_m3_s > 0 && in.tip.where == TipPlace::coronary) {
    const double d = beyond_m(in.flow.tree, one.cell, in.tip.cell);
    if (d >= 0) {
      const double rate_1_s = in.drawn_m3_s / of_drawn_m3_s * std::exp(-d / reach_m) / aspirates_s;
      const double out = -std::expm1(-dt * rate_1_s) * std::max(0.0, one.m3 - one.firm_m3);
      one.m3 -= out, s.aspirated_m3 += out;
    }
  }
  if (one.m3 < least_m3) s.dust_m3 += one.m3, one = {};
}

}  // namespace

double thrombus_hazard_1_s(double act_s) {
  constexpr double act[] = {130, 150, 200, 250}, per_min[] = {0.03, 0.01, 0.002, 0};
  if (act_s <= act[0]) return per_min[0] / 60;
  for (int i = 0; i < 3; ++i)
    if (act_s < act[i + 1])
      return (per_min[i] + (act_s - act[i]) / (act[i + 1] - act[i]) * (per_min[i + 1] - per_min[i])) / 60;
  return 0;
}

double standing(double flow_m3_s, double free_m2) {
  return free_m2 > 0 ? std::exp(-std::fabs(flow_m3_s) / free_m2 / still_m_s) : 1;
}

void form(const ThrombusModel& model, int cell, double volume, ThrombusState& s) {
  if (!(volume > 0)) return;
  for (Thrombus& one : s.thrombi) {
    if (one.cell >= 0 && one.cell != cell) continue;
    one.cell = cell;
    s.formed += 1, s.grown_m3 += volume;
    add(model, volume, one, s);
    return;
  }
}

void step(const ThrombusModel& model, const ThrombusInputs& in, double dt, ThrombusState& s, FlowState& blood) {
  const double hazard = thrombus_hazard_1_s(in.act_s);
  double stands = 0;
  if (hazard > 0)
    if (const int at = slowest(in, blood, stands); at >= 0) {
      s.hazard += hazard * (1 + 2 * stands) * dt;
      if (s.hazard > -std::log1p(-core::uniform(model.seed, forms, static_cast<std::uint64_t>(s.formed))))
        form(model, at, model.seed_m3, s), s.hazard = 0;
    }
  for (Thrombus& one : s.thrombi)
    if (one.cell >= 0) shrink_or_grow(model, in, hazard / thrombus_hazard_1_s(0), dt, one, s, blood);
}

void fill(const ThrombusModel& model, const FlowTree& tree, std::span<const double> radius_m, const ThrombusState& s,
          std::span<double> occupied_m) {
  for (const Thrombus& one : s.thrombi) {
    if (one.cell < 0) continue;
    double room = 0;
    for_each_cell(model, tree, one.cell,
                  [&](std::size_t c) { room += free_area_m2(radius_m[c], occupied_m[c]) * tree.cells[c].length_m; });
    // The same share of what is free in each cell.
    const double share = room > 0 ? std::min(1.0, one.m3 / room) : 0;
    for_each_cell(model, tree, one.cell, [&](std::size_t c) {
      const double area = share * free_area_m2(radius_m[c], occupied_m[c]);
      occupied_m[c] = std::min(radius_m[c], std::sqrt(occupied_m[c] * occupied_m[c] + area / units::pi));
    });
  }
}

double volume_m3(const ThrombusState& s) {
  double sum = 0;
  for (const Thrombus& one : s.thrombi) sum += one.m3;
  return sum;
}

}  // namespace ostium::vascular
