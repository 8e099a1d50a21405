#include "core/concentric.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/concentric_twist.h"
#include "core/math/rotation.h"
#include "core/tunables.h"

namespace ostium {

namespace {

/// The section of `part` at `from_base` along the centreline, null beyond its tip.
const Section* section_at(const ConcentricPart& part, double from_base) {
  const double from_tip = part.inserted_m - from_base;
  if (from_tip <= 0) return nullptr;
  for (const Section& s : part.sections)
    if (from_tip <= s.to_tip_m) return &s;
  return &part.sections.back();
}

/// Distances from the base at which a part or a section of one ends.
std::vector<double> boundaries(const std::vector<ConcentricPart>& parts, double length) {
  std::vector<double> at = {0, length};
  for (const ConcentricPart& part : parts) {
    at.push_back(part.inserted_m);
    for (const Section& s : part.sections) at.push_back(part.inserted_m - s.to_tip_m);
  }
  std::erase_if(at, [&](double x) { return x < 0 || x > length; });
  std::sort(at.begin(), at.end());
  const double least = 1e-9;
  at.erase(std::unique(at.begin(), at.end(), [&](double a, double b) { return b - a < least; }), at.end());
  at.back() = length;
  return at;
}

void check_parts(const ConcentricDescription& d) {
  const auto refuse = [&](std::size_t i, const std::string& what) {
    throw std::invalid_argument("nest \"" + d.name + "\", part " + std::to_string(i) + ": " + what);
  };
  if (d.parts.empty()) throw std::invalid_argument("nest \"" + d.name + "\" has no part");
  for (std::size_t i = 0; i < d.parts.size(); ++i) {
    const ConcentricPart& part = d.parts[i];
    check({d.name, part.sections, std::vector<double>(16, part.inserted_m / 16), {}});
    if (!(part.shaft_rad_per_Nm >= 0) || !std::isfinite(part.roll_rad))
      refuse(i, "the shaft's compliance must not be negative, and the roll be finite");
    if (d.parts.size() == 1) continue;
    for (const Section& s : part.sections)
      if (s.EI1_N_m2 != s.EI2_N_m2 || s.rest_curvature_per_m.z() != 0)
        refuse(i, "nested instruments must be equally stiff about both axes and without twist at rest");
  }
}

/// Stiffness and weight of all parts together. One part keeps its own shape at rest; that of several follows the
/// angles.
std::vector<Section> composite(const std::vector<ConcentricPart>& parts, double length) {
  if (parts.size() == 1) return parts[0].sections;
  const std::vector<double> at = boundaries(parts, length);
  std::vector<Section> sections;
  for (std::size_t b = at.size() - 1; b > 0; --b) {
    Section sum;
    sum.from_tip_m = sections.empty() ? 0 : sections.back().to_tip_m;
    sum.to_tip_m = length - at[b - 1];
    sum.inner_radius_m = 1;
    for (const ConcentricPart& part : parts)
      if (const Section* s = section_at(part, 0.5 * (at[b - 1] + at[b]))) {
        sum.EI1_N_m2 += s->EI1_N_m2, sum.EI2_N_m2 += s->EI2_N_m2, sum.GJ_N_m2 += s->GJ_N_m2;
        sum.kg_per_m += s->kg_per_m;
        sum.radius_m = std::max(sum.radius_m, s->radius_m);
        sum.inner_radius_m = std::min(sum.inner_radius_m, s->inner_radius_m);
      }
    sections.push_back(sum);
  }
  return sections;
}

/// Where the cells of the joints end: the base, the middles of the elements, the tip.
std::vector<double> cell_ends(const std::vector<double>& element_lengths) {
  std::vector<double> ends = {0};
  double reached = 0;
  for (double l : element_lengths) {
    ends.push_back(reached + l / 2);
    reached += l;
  }
  ends.push_back(reached);
  return ends;
}

void cut_into_pieces(Concentric& nest, const std::vector<double>& ends) {
  const std::vector<double> at = boundaries(nest.parts, ends.back());
  nest.pieces.resize(ends.size() - 1);
  nest.GJ_N_m2.setZero(nest.parts.size(), ends.size() - 1);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    for (std::size_t b = 0; b + 1 < at.size(); ++b) {
      const double from = std::max(ends[k], at[b]), to = std::min(ends[k + 1], at[b + 1]);
      if (to <= from) continue;
      ConcentricPiece piece{to - from, 0, {}};
      for (std::size_t i = 0; i < nest.parts.size(); ++i)
        if (const Section* s = section_at(nest.parts[i], 0.5 * (from + to))) {
          piece.members.push_back({static_cast<int>(i), s->EI1_N_m2, s->rest_curvature_per_m.head<2>()});
          piece.EI_N_m2 += s->EI1_N_m2;
          nest.GJ_N_m2(i, k) += (to - from) * s->GJ_N_m2;
        }
      nest.pieces[k].push_back(piece);
    }
    // So that the parts' torques add up to the carrier's, whatever ends within the cell.
    nest.GJ_N_m2.col(k) *= stiffness_at_rest(nest.carrier.rods[0], static_cast<int>(k)).z() / nest.GJ_N_m2.col(k).sum();
  }
}

/// Gives the carrier the shape at rest and the base frame that the angles make.
void turn_carrier(const Concentric& nest, const EndState& base, const ConcentricState& state, Rod& rod,
                  EndState& held) {
  set_concentric_rest_curvature(nest, state, rod);
  const Eigen::Quaterniond q = Eigen::Quaterniond(base.q_W[0], base.q_W[1], base.q_W[2], base.q_W[3]) *
                               Eigen::AngleAxisd(state.base_roll_rad[nest.reference], Eigen::Vector3d::UnitZ());
  held.p_W = base.p_W;
  held.q_W = {q.w(), q.x(), q.y(), q.z()};
}

/// The carrier's moments at its joints, material frame; none at the free tip.
Eigen::Matrix3Xd moments(const Rod& rod, const RodState& state) {
  Eigen::Matrix3Xd m = Eigen::Matrix3Xd::Zero(3, rod.nodes());
  Q4<double> before = state.base.frame();
  for (int k = 0; k < rod.elements; ++k) {
    const Q4<double> here = load4<double>(state.orientation, k);
    const Eigen::Vector3d u = to_eigen(rotation_vector(conjugate(before) * here)) / rod.joint_length.at(0)[k];
    m.col(k) = stiffness_at_rest(rod, k).cwiseProduct(u - rod.rest_curvature[k]);
    before = here;
  }
  return m;
}

}  // namespace

Concentric make_concentric(const ConcentricDescription& d, const Eigen::Vector3d& gravity_W) {
  check_parts(d);
  Concentric nest;
  nest.parts = d.parts;
  const auto longest = std::max_element(d.parts.rbegin(), d.parts.rend(),
                                        [](const auto& a, const auto& b) { return a.inserted_m < b.inserted_m; });
  nest.reference = static_cast<int>(d.parts.rend() - longest) - 1;
  nest.carrier.gravity_W = gravity_W;
  nest.carrier.rods = {make_rod({d.name, composite(d.parts, longest->inserted_m), d.element_lengths_m, {}})};
  const std::vector<double> ends = cell_ends(d.element_lengths_m);
  for (const ConcentricPart& part : d.parts) {
    int last = -1;
    while (last + 1 < static_cast<int>(d.element_lengths_m.size()) && ends[last + 2] < part.inserted_m) ++last;
    nest.last_element.push_back(last);
  }
  if (d.parts.size() > 1) cut_into_pieces(nest, ends);
  return nest;
}

ConcentricState straight_state(const Concentric& nest, const EndState& base) {
  const int n = static_cast<int>(nest.parts.size()), N = nest.carrier.rods[0].elements;
  ConcentricState state;
  state.base_roll_rad.resize(n);
  for (int i = 0; i < n; ++i) state.base_roll_rad[i] = nest.parts[i].roll_rad;
  state.roll_rad = (state.base_roll_rad.array() - state.base_roll_rad[nest.reference]).matrix().replicate(1, N);
  state.moment_N_m.setZero(3, N + 1);
  Rod rod = nest.carrier.rods[0];
  EndState held = base;
  turn_carrier(nest, base, state, rod, held);
  state.carrier = make_state(nest.carrier, {held});
  return state;
}

ConcentricEquilibrium find_equilibrium(const Concentric& nest, const EndState& base,
                                       const Eigen::Vector3d& tip_force_W_N, ConcentricState& state) {
  Model carrier = nest.carrier;
  Scratch scratch(carrier);
  Inputs inputs;
  inputs.rods.resize(1);
  inputs.rods[0].tip_force_W_N = tip_force_W_N;
  std::vector<RodEquilibrium> report;

  const bool turns = nest.parts.size() > 1 || nest.parts[0].shaft_rad_per_Nm > 0;
  ConcentricEquilibrium out;
  while (out.rounds < tunables::max_concentric_rounds && !out.converged) {
    ++out.rounds;
    const TwistSolution twist = turns ? solve_twist(nest, state) : TwistSolution{};
    out.turn_rad = twist.turn_rad;
    if (!twist.converged) return out;
    turn_carrier(nest, base, state, carrier.rods[0], state.carrier.rods[0].base);
    scratch.rods[0].inside.rest_curvature = carrier.rods[0].rest_curvature;
    find_equilibrium(carrier, inputs, state.carrier, scratch, report);
    if (!report[0].converged) return out;
    state.moment_N_m = moments(carrier.rods[0], state.carrier.rods[0]);
    out.converged = !turns || (out.rounds > 1 && out.turn_rad < tunables::concentric_tolerance_rad);
    out.negative_directions = report[0].negative_directions + twist.negative_directions;
  }
  const Rod& rod = carrier.rods[0];
  const Eigen::Vector3d load = rod.total_mass_kg * carrier.gravity_W + tip_force_W_N;
  out.base_push_N = -load.dot(to_eigen(director3(state.carrier.rods[0].base.frame())));
  return out;
}

}  // namespace ostium
