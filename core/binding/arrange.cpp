/// Which rods are a nest, and its chain: put together before a step, taken apart after.
#include <algorithm>
#include <cmath>
#include <variant>

#include "core/binding/nest.h"
#include "core/math/rotation.h"
#include "core/rod/introducer.h"
#include "core/rod/iterate.h"
#include "core/tunables.h"

namespace ostium {

namespace {

// Fractions of an element at which it leaves the rod around it and goes back; apart, so that a trembling hand does not
// change elements.
constexpr double leaves_at = 0.6, returns_at = 0.4;

double norm(const V3<double>& v) { return std::sqrt(dot(v, v)); }

bool is_nested(const Model& model, int outer, int inner) {
  return std::any_of(model.nestings.begin(), model.nestings.end(),
                     [&](const Nesting& n) { return n.outer == outer && n.inner == inner; });
}

/// Each rod goes with the last one around it, if all who go with that hold it.
void find_strands(const Model& model, State& state, Scratch& scratch) {
  scratch.strands.clear();
  const int rods = static_cast<int>(model.rods.size());
  for (int r = 0; r < rods; ++r) {
    scratch.nests[r].members.clear();
    scratch.lead[r] = r;
    if (!in_body(model.rods[r], state.rods[r])) continue;
    for (int o = r - 1; o >= 0; --o) {
      if (!in_body(model.rods[o], state.rods[o]) || !is_nested(model, o, r)) continue;
      const std::vector<int>& members = scratch.nests[scratch.lead[o]].members;
      const bool held = std::all_of(members.begin(), members.end(), [&](int m) { return is_nested(model, m, r); });
      if (held && static_cast<int>(members.size()) < max_layers) scratch.lead[r] = scratch.lead[o];
      break;
    }
    scratch.nests[scratch.lead[r]].members.push_back(r);
  }
  for (int r = 0; r < rods; ++r) {
    Nest& nest = scratch.nests[r];
    if (nest.members.empty()) continue;
    const bool alone = nest.members.size() == 1;
    if (alone) state.rods[r].exposed = state.rods[r].first;
    scratch.strands.push_back({r, alone ? &scratch.rods[r] : &nest.s, alone ? &state.rods[r] : &nest.own,
                               alone ? &scratch.contacts[r] : &nest.contact, alone ? nullptr : &nest});
  }
}

/// Element j of a rod turned so that its tangent lies along `chord`.
void swing(const V3<double>& chord, int j, RodState& s) {
  const Q4<double> q = load4<double>(s.orientation, j);
  const Eigen::Quaterniond onto = Eigen::Quaterniond::FromTwoVectors(to_eigen(director3(q)), to_eigen(chord));
  store4(s.orientation, j, from_eigen((onto * to_eigen(q)).normalized()));
}

/// The first element of a rod that protrudes by `length_m` from those around it; N: too little does.
int first_exposed(const Rod& rod, const RodState& s, double length_m) {
  const int N = rod.elements;
  const auto own = [&](int i) { return rod.length.at(0)[i]; };
  const auto beyond = [&](int i) { return length_m - rod.node_from_tip_m[i + 1]; };
  int j = static_cast<int>(s.exposed);
  if (j >= N) {
    if (length_m < leaves_at * own(N - 1)) return N;
    j = N - 1;
  }
  while (j > first_element(s) && beyond(j) > own(j) + leaves_at * own(j - 1)) --j;
  while (j < N && beyond(j) < returns_at * own(j)) ++j;
  return j;
}

/// What protrudes begins at `root`: its frames follow the elements that have left or gone back.
void expose(const Rod& rod, int first, double length_m, const V3<double>& root, RodState& s) {
  const int before = static_cast<int>(s.exposed), N = rod.elements;
  s.exposed = first;
  if (first == N) return;
  const V3<double> chord = load3<double>(s.position, first + 1) - root;
  if (std::fabs(norm(chord) - length_m) > tunables::torn_part * rod.length.at(0)[first]) {
    // Rods that were laid out without each other: what protrudes is moved to where it leaves.
    V3<double> p = root;
    for (int j = first; j < N; ++j) {
      p = madd(j == first ? length_m : rod.length.at(0)[j], director3(load4<double>(s.orientation, j)), p);
      for (Field<3>* f : {&s.position, &s.position_before}) store3(*f, j + 1, p);
    }
    return;
  }
  if (first == before) return;
  swing(chord, first, s);
  for (int j = first + 1; j <= before && j < N; ++j)
    swing(load3<double>(s.position, j + 1) - load3<double>(s.position, j), j, s);
}

/// An outer rod that has just come into the body lies along the rod that it came over.
void lay_over(const Rod& inside, const Rod& inner, const RodState& along, RodState& s) {
  int j = first_element(along);
  double depth = 0, length = along.inserted_m - inner.node_from_tip_m[j + 1];
  for (int i = inside.first; i <= inside.elements; ++i) {
    const double at = i == inside.first ? 0 : inside.total_length_m - inside.node_from_tip_m[i];
    while (j + 1 < inner.elements && at > depth + length) depth += length, ++j, length = inner.length.at(0)[j];
    const double part = (at - depth) / length;
    const auto mix = [&](const Field<3>& f) {
      return madd(part, load3<double>(f, j + 1) - load3<double>(f, j), load3<double>(f, j));
    };
    store3(s.position, i, mix(along.position));
    store3(s.position_before, i, mix(along.position_before));
    store3(s.velocity, i, mix(along.velocity));
    store3(s.velocity_before, i, mix(along.velocity_before));
  }
  for (int i = inside.first; i < inside.elements; ++i)
    swing(load3<double>(s.position, i + 1) - load3<double>(s.position, i), i, s);
}

void set_joint_lengths(Rod& rod) {
  for (int i = 0; i <= rod.elements; ++i) {
    const double behind = i > 0 ? rod.length.at(0)[i - 1] / 2 : 0,
                 ahead = i < rod.elements ? rod.length.at(0)[i] / 2 : 0;
    rod.joint_length.at(0)[i] = behind + ahead;
  }
}

/// Elements of all spans: their lengths, and where their nodes are along the chain.
void lay_spans(const Model& model, Scratch& scratch, State& state, Nest& nest) {
  nest.spans.clear();
  Rod& chain = nest.s.inside;
  double reach = 0;
  int at = 0;
  for (std::size_t k = 0; k < nest.members.size(); ++k) {
    const int r = nest.members[k];
    const Rod& rod = k == 0 ? scratch.rods[r].inside : model.rods[r];
    RodState& own = state.rods[r];
    Layer& layer = nest.layers[k];
    layer.fed_m = scratch.fed_m[r];
    layer.rod = r, layer.roll = static_cast<int>(k) - 1, layer.inserted_m = own.inserted_m;
    layer.covered = at;
    if (k == 0) {
      own.exposed = own.first;
      layer.inserted_m = rod.total_length_m;
    } else {
      const double protrudes = own.inserted_m - reach;
      const int first = first_exposed(rod, own, protrudes);
      const int root = nest.spans.back().rod;
      const V3<double> tip = load3<double>(state.rods[root].position, model.rods[root].elements);
      expose(rod, first, first < rod.elements ? protrudes - rod.node_from_tip_m[first + 1] : 0, tip, own);
    }
    const int first = static_cast<int>(own.exposed), count = rod.elements - first;
    layer.end = at + count;
    if (count == 0) {
      layer.end = 0;
      continue;
    }
    nest.spans.push_back({r, first, at, count});
    copy_entries(rod.length, first, rod.elements, chain.length, at);
    if (k > 0) chain.length.at(0)[at] = own.inserted_m - reach - rod.node_from_tip_m[first + 1];
    double depth = reach;
    for (int e = at; e < at + count; ++e) {
      nest.depth.at(0)[e] = depth;
      depth += chain.length.at(0)[e];
    }
    nest.depth.at(0)[at + count] = reach = layer.inserted_m;
    at += count;
  }
  chain.first = 0, chain.elements = at;
  chain.total_length_m = reach;
  nest.layer_count = static_cast<int>(nest.members.size());
  set_joint_lengths(chain);
}

/// Where a rod lies wholly inside others: as far as it has a share in joints.
void end_inside(const Nest& nest, Layer& layer) {
  const int elements = nest.s.inside.elements;
  const auto middle = [&](int e) { return (nest.depth.at(0)[e] + nest.depth.at(0)[e + 1]) / 2; };
  int last = 0;
  while (last + 1 < elements && middle(last) < layer.inserted_m) ++last;
  layer.covered = last + 1, layer.end = 0;
}

/// Stiffness that a layer has in a joint of which it reaches into a part only, behind which the others go on: in series
/// with theirs.
Eigen::Vector3d partial(const Nest& nest, int k, int i, double part, const Eigen::Vector3d& own) {
  Eigen::Vector3d others = Eigen::Vector3d::Zero();
  for (int o = 0; o < k; ++o) {
    if (i >= std::max(nest.layers[o].end, nest.layers[o].covered)) continue;
    const S3<double> C = std::visit(
        [&](const auto& law) { return law.template operator()<double>(V3<double>{}, i).tangent; }, nest.layers[o].law);
    others += Eigen::Vector3d(C.xx, C.yy, C.zz);
  }
  Eigen::Vector3d out = part * own.cwiseProduct(others).cwiseQuotient(others + (1 - part) * own);
  out.z() = part * own.z();  // it twists by itself
  return out;
}

/// Cells of the chain that are not cells of the rod: joints and nodes 0 to last of a layer.
void cut_cells(const Rod& rod, int last, Nest& nest, int k) {
  Layer& layer = nest.layers[k];
  const Rod& chain = nest.s.inside;
  std::size_t hint = rod.sections.size() - 1;
  const auto stretch = [&](double from_depth, double to_depth) {
    const double a = std::max(0.0, layer.inserted_m - to_depth), b = layer.inserted_m - from_depth;
    while (hint > 0 && rod.sections[hint].from_tip_m > a) --hint;
    return integrate(rod.sections, a, std::max(a, b), hint);
  };
  for (int i = 0; i <= last; ++i) {
    const double behind = i > 0 ? chain.length.at(0)[i - 1] / 2 : 0, length = chain.joint_length.at(0)[i];
    const double from = nest.depth.at(0)[i] - behind;
    const SectionIntegrals cell = stretch(from, from + length);
    const double part = std::clamp((layer.inserted_m - from) / length, tunables::least_cover, 1.0);
    layer.mass.at(0)[i] = cell.mass;
    Eigen::Vector3d compliance = cell.compliance, rest = cell.rest_angle / (part * length);
    if (part < 1) {
      const SectionIntegrals tip = integrate(rod.sections, 0, part * length);
      rest = tip.rest_angle / (part * length);
      compliance = length * partial(nest, k, i, part, part * length * tip.compliance.cwiseInverse()).cwiseInverse();
    }
    layer.rest.set(i, rest);
    std::visit([&](auto& law) { law.set_cell(i, length, compliance); }, layer.law);
  }
  hint = rod.sections.size() - 1;
  for (int e = 0; e < layer.covered; ++e) {
    const SectionIntegrals element = stretch(nest.depth.at(0)[e], nest.depth.at(0)[e + 1]);
    layer.polar.at(0)[e] = element.polar_inertia;
    nest.s.inside.rotary_inertia.at(0)[e] += element.transverse_inertia;
  }
}

void copy_law(const MomentLaw& from, int begin, int end, MomentLaw& to, int at) {
  std::visit(
      [&](auto& law) {
        using Law = std::decay_t<decltype(law)>;
        law.copy(std::get<Law>(from), begin, end, at);
      },
      to);
}

/// Whether the rods lie against each other as they did; where they are, and what their cells have, follows from
/// this alone.
bool lie_as_before(const State& state, Nest& nest) {
  bool same = true;
  for (int k = 0; k < max_layers; ++k) {
    Laid now;
    if (k < nest.layer_count) {
      const Layer& layer = nest.layers[k];
      const RodState& own = state.rods[layer.rod];
      now = {layer.rod, first_element(own), static_cast<int>(own.exposed), layer.inserted_m};
    }
    same = same && now == nest.laid[k];
    nest.laid[k] = now;
  }
  return same;
}

/// What each rod has, cell by cell.
void lay_layers(const Model& model, const Scratch& scratch, Nest& nest) {
  Rod& chain = nest.s.inside;
  for (int k = 0; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    const Rod& rod = k == 0 ? scratch.rods[layer.rod].inside : model.rods[layer.rod];
    layer.damping_s = rod.damping.material_time_s;
    layer.viscous = layer.damping_s / nest.step_s;
    const bool protrudes = layer.end > 0;
    // From here on the cells are the rod's own.
    int own = layer.covered < chain.elements ? layer.covered - 1 : chain.elements;
    if (protrudes) {
      const int first = rod.elements - (layer.end - layer.covered);
      copy_entries(rod.rotary_inertia, first, rod.elements, chain.rotary_inertia, layer.covered);
      copy_entries(rod.radius, first + (k > 0), rod.elements + 1, chain.radius, layer.covered + (k > 0));
      const int from = k == 0 ? 0 : std::min(layer.covered + 2, layer.end + 1);  // joints
      own = from - 1;
      copy_entries(rod.rest_curvature, first + from - layer.covered, rod.elements + 1, layer.rest, from);
      copy_entries(rod.mass, first + from - layer.covered, rod.elements + 1, layer.mass, from);
      copy_law(rod.law, first + from - layer.covered, rod.elements + 1, layer.law, from);
    }
    if (k > 0) cut_cells(rod, own, nest, k);
    const int nodes = own + 1;
    if (k == 0)
      copy_entries(layer.mass, 0, layer.end + 1, chain.mass, 0);
    else
      for (int i = 0; i <= std::max(nodes - 1, layer.end); ++i)
        chain.mass.at(0)[i] = (i > layer.covered && layer.end > 0 ? 0 : chain.mass.at(0)[i]) + layer.mass.at(0)[i];
  }
}

/// A span's part of the rod's fields.
struct Part {
  const Span& span;
  int skipped;  ///< 1: its first node belongs to the span before

  explicit Part(const Nest& nest, const Span& s) : span(s), skipped(&s == &nest.spans.front() ? 0 : 1) {}
  int first() const { return span.first; }
  int end() const { return span.first + span.elements; }

  /// Calls take(field of the rod, field of the chain, first, end, at).
  template <class Rod_, class Chain_, class Take>
  void fields(Rod_& rod, Chain_& chain, Take&& take) const {
    const auto nodes = [&](auto& a, auto& b) {
      if (b.size() > 0 && a.size() > 0) take(a, b, first() + skipped, end() + 1, span.at + skipped);
    };
    const auto elements = [&](auto& a, auto& b) { take(a, b, first(), end(), span.at); };
    nodes(rod.position, chain.position), nodes(rod.position_before, chain.position_before);
    nodes(rod.velocity, chain.velocity), nodes(rod.velocity_before, chain.velocity_before);
    nodes(rod.strain, chain.strain), nodes(rod.strain_before, chain.strain_before);
    nodes(rod.wall_force, chain.wall_force), nodes(rod.wall_slip, chain.wall_slip);
    elements(rod.orientation, chain.orientation), elements(rod.force, chain.force);
    elements(rod.turn, chain.turn), elements(rod.turn_before, chain.turn_before);
  }
};

void gather(const State& state, Scratch& scratch, Nest& nest) {
  for (const Span& span : nest.spans)
    Part(nest, span).fields(state.rods[span.rod], nest.own, [](const auto& from, auto& to, int begin, int end, int at) {
      copy_entries(from, begin, end, to, at);
    });
  const int lead = nest.members.front(), last = nest.spans.back().rod;
  nest.own.base = state.rods[lead].base, nest.own.tip = state.rods[last].tip;
  nest.own.first = 0;
  nest.s.inputs = scratch.rods[lead].inputs;
  nest.s.inputs.tip = scratch.rods[last].inputs.tip;
  nest.s.scheme = TimeScheme::bdf2;
  for (int r : nest.members)
    if (scratch.rods[r].scheme == TimeScheme::fresh) nest.s.scheme = TimeScheme::fresh;
  nest.s.step_s = nest.step_s;
}

/// The last rod around layer k, at chain element e, whose lumen holds it there.
int host(const Model& model, const Nest& nest, int k, int e) {
  for (int o = k - 1; o >= 0; --o) {
    const Layer& outer = nest.layers[o];
    if (e >= std::max(outer.covered, outer.end)) continue;
    for (const Nesting& n : model.nestings)
      if (n.outer == outer.rod && n.inner == nest.layers[k].rod &&
          nest.depth.at(0)[e + 1] > outer.inserted_m - n.lumen_m)
        return o;
  }
  return 0;
}

/// Whose bore the layer is in, and its clearance there.
void find_hosts(const Model& model, Nest& nest, int k) {
  Layer& layer = nest.layers[k];
  for (int e = 0; e < layer.covered; ++e) {
    const int h = layer.host[e] = host(model, nest, k, e);
    const Layer& outer = nest.layers[h];
    const Rod& bore = model.rods[outer.rod];
    const int j = e < outer.covered ? outer.from_own.before[e] : bore.elements - outer.end + e;
    layer.room.at(0)[e] = largest(0, bore.bore.at(0)[j] - model.rods[layer.rod].radius.at(0)[layer.from_own.before[e]]);
  }
}

/// Entries beside places that lie in order; `at(i)`: where entry i is, up to `last`.
template <class At>
void place(double where, int last, int& hint, At&& at, int i, Places& out) {
  while (hint < last - 1 && at(hint + 1) < where) ++hint;
  const double a = at(hint), b = at(hint + 1);
  out.before[i] = hint;
  out.part.at(0)[i] = std::clamp((where - a) / (b - a), 0.0, 1.0);
}

}  // namespace

double middle_of_own(const Rod& rod, const RodState& s, int j, double reach_m) {
  double from = s.inserted_m - rod.node_from_tip_m[j];
  if (j == first_element(s)) from = 0;
  if (j == static_cast<int>(s.exposed)) from = reach_m;
  return (from + s.inserted_m - rod.node_from_tip_m[j + 1]) / 2;
}

void arrange(const Model& model, const std::vector<char>& was_in_body, State& state, Scratch& scratch) {
  find_strands(model, state, scratch);
  for (Strand& strand : scratch.strands) {
    if (!strand.nest) continue;
    Nest& nest = *strand.nest;
    nest.step_s = model.step_s;
    if (!was_in_body[strand.lead])
      lay_over(scratch.rods[strand.lead].inside, model.rods[nest.members[1]], state.rods[nest.members[1]],
               state.rods[strand.lead]);
    lay_spans(model, scratch, state, nest);
    nest.moved = !lie_as_before(state, nest);
    for (int k = 0; k < nest.layer_count; ++k)
      if (nest.layers[k].end == 0) end_inside(nest, nest.layers[k]);
    if (nest.moved) {
      lay_layers(model, scratch, nest);
      for (int e = 0; e < nest.s.inside.elements; ++e) {
        const double length = nest.s.inside.length.at(0)[e];
        nest.nearness.at(0)[e] = length / (length + tunables::bore_smooth_m);
      }
    }
    gather(state, scratch, nest);
    nest.s.chain.roll_count = nest.layer_count - 1;
    for (int k = 1; k < nest.layer_count; ++k) {
      Layer& layer = nest.layers[k];
      const Rod& rod = model.rods[layer.rod];
      const RodState& own = state.rods[layer.rod];
      layer.base_turn = from_eigen(nest.step_s * scratch.rods[layer.rod].inputs.base.turn_rate_W_rad_s);
      if (!nest.moved) continue;
      const double reach = nest.depth.at(0)[layer.covered];
      int hint = first_element(own);
      for (int e = 0; e < layer.covered; ++e)
        place((nest.depth.at(0)[e] + nest.depth.at(0)[e + 1]) / 2, rod.elements - 1, hint,
              [&](int j) { return middle_of_own(rod, own, j, reach); }, e, layer.from_own);
      find_hosts(model, nest, k);
    }
  }
}

void take_apart(const Nest& nest, State& state) {
  for (const Span& span : nest.spans)
    Part(nest, span).fields(state.rods[span.rod], nest.own, [](auto& to, const auto& from, int begin, int end, int at) {
      copy_entries(from, at, at + end - begin, to, begin);
    });
}

NodeOfRod node_of_rod(const Strand& strand, int i) {
  if (!strand.nest) return {strand.lead, i};
  for (const Span& span : strand.nest->spans)
    if (i <= span.at + span.elements) return {span.rod, span.first + i - span.at};
  return {strand.lead, i};
}

}  // namespace ostium
