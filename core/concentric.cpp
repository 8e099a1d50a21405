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

Eigen::Quaterniond quaternion(const Eigen::Vector4d& q) { return {q[0], q[1], q[2], q[3]}; }
Eigen::Vector4d coefficients(const Eigen::Quaterniond& q) { return {q.w(), q.x(), q.y(), q.z()}; }
Eigen::Quaterniond rotation(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

/// The carrier's Darboux vectors at its joints; none at the free tip.
Eigen::Matrix3Xd strains(const Rod& rod, const RodState& state) {
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, rod.nodes());
  Q4<double> before = state.base.frame();
  for (int k = 0; k < rod.elements; ++k) {
    const Q4<double> here = load4<double>(state.orientation, k);
    u.col(k) = to_eigen(rotation_vector(conjugate(before) * here)) / rod.joint_length.at(0)[k];
    before = here;
  }
  return u;
}

void take_moments(const Rod& rod, ConcentricState& state) {
  const Eigen::Matrix3Xd strain = strains(rod, state.carrier.rods[0]);
  for (int k = 0; k < rod.elements; ++k)
    state.moment_N_m.col(k) =
        stiffness_at_rest(rod, k).cwiseProduct(Eigen::Vector3d(strain.col(k)) - rod.rest_curvature[k]);
}

/// Tilts a rod a little, the more the further from its base: off a shape that is balanced but unstable, as a long wire
/// standing upright is. The direction is arbitrary, and always the same.
void lean(const Rod& rod, RodState& state) {
  const Eigen::Vector3d axis = quaternion(state.base.q_W) * Eigen::Vector3d(1, 0.3, 0).normalized();
  for (int j = 0; j < rod.elements; ++j)
    state.orientation.set(
        j, coefficients(rotation(1e-2 * (j + 1) / rod.elements * axis) * quaternion(state.orientation[j])));
}

/// Column of `values`, given at `at` (rising), at x: linear in between.
Eigen::VectorXd between(const Eigen::VectorXd& at, const Eigen::MatrixXd& values, double x) {
  const Eigen::Index last = values.cols() - 1;
  const Eigen::Index i =
      std::clamp<Eigen::Index>(std::upper_bound(at.data(), at.data() + last + 1, x) - at.data(), 1, last);
  const double t = std::clamp((x - at[i - 1]) / (at[i] - at[i - 1]), 0.0, 1.0);
  return (1 - t) * values.col(i - 1) + t * values.col(i);
}

/// Distances from the base, of the length, of the joints and of the middles of the elements.
Eigen::VectorXd joint_fractions(const Rod& rod) {
  Eigen::VectorXd at(rod.elements);
  for (int k = 0; k < rod.elements; ++k) at[k] = 1 - rod.node_from_tip_m[k] / rod.total_length_m;
  return at;
}
Eigen::VectorXd element_fractions(const Rod& rod) {
  return joint_fractions(rod) +
         Eigen::Map<const Eigen::VectorXd>(rod.length.at(0), rod.elements) / (2 * rod.total_length_m);
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

std::vector<double> concentric_elements(const std::vector<ConcentricPart>& parts, double longest_m,
                                        double longest_rad) {
  double length = 0;
  for (const ConcentricPart& part : parts) length = std::max(length, part.inserted_m);
  const std::vector<double> at = boundaries(parts, length);
  std::vector<double> elements;
  for (std::size_t b = 0; b + 1 < at.size(); ++b) {
    double longest = std::min(longest_m, length / 16);
    for (const ConcentricPart& part : parts)
      if (const Section* s = section_at(part, 0.5 * (at[b] + at[b + 1])))
        longest = std::min(longest, longest_rad / std::max(s->rest_curvature_per_m.norm(), 1e-6));
    const int count = static_cast<int>(std::ceil((at[b + 1] - at[b]) / longest - 1e-9));
    elements.insert(elements.end(), count, (at[b + 1] - at[b]) / count);
  }
  return elements;
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

ConcentricState carried_over(const Concentric& nest, const EndState& base, const Concentric& before_nest,
                             const ConcentricState& before) {
  ConcentricState state = straight_state(nest, base);
  const Rod &rod = nest.carrier.rods[0], &rod_before = before_nest.carrier.rods[0];
  for (Eigen::Index i = 0; i < state.base_roll_rad.size(); ++i)
    state.base_roll_rad[i] += before.base_roll_rad[i] - before_nest.parts[i].roll_rad;
  Rod turned = rod;
  RodState& carrier = state.carrier.rods[0];
  turn_carrier(nest, base, state, turned, carrier.base);

  const Eigen::VectorXd joints_before = joint_fractions(rod_before), elements_before = element_fractions(rod_before);
  const Eigen::VectorXd joints = joint_fractions(rod), elements = element_fractions(rod);
  const Eigen::MatrixXd strain = strains(rod_before, before.carrier.rods[0]).leftCols(rod_before.elements);
  const Eigen::MatrixXd moment = before.moment_N_m.leftCols(rod_before.elements);
  Eigen::Quaterniond q = quaternion(carrier.base.q_W);
  Eigen::Vector3d p = base.p_W;
  for (int j = 0; j < rod.elements; ++j) {
    const Eigen::Vector3d u = between(joints_before, strain, joints[j]);
    q = (q * rotation(u * rod.joint_length.at(0)[j])).normalized();
    carrier.orientation.set(j, coefficients(q));
    carrier.position.set(j, p);
    p += rod.length.at(0)[j] * (q * Eigen::Vector3d::UnitZ());
    state.moment_N_m.col(j) = between(joints_before, moment, joints[j]);
    // Relative to what its drive was turned by, so that a part that is turned further takes its angles along.
    const auto drives = [](const Concentric& n, int i) { return n.parts[i].roll_rad - n.parts[n.reference].roll_rad; };
    const Eigen::VectorXd roll = between(elements_before, before.roll_rad, elements[j]);
    for (int i = 0; i < static_cast<int>(nest.parts.size()); ++i)
      state.roll_rad(i, j) =
          roll[i] +
          (nest.reference == before_nest.reference ? drives(nest, i) - drives(before_nest, i) : -roll[nest.reference]);
  }
  carrier.position.set(rod.elements, p);
  carrier.position_before = carrier.position;
  return state;
}

Eigen::Vector4d tip_frame(const Concentric& nest, const ConcentricState& state, int part) {
  const Rod& whole = nest.carrier.rods[0];
  const RodState& carrier = state.carrier.rods[0];
  const int last = std::max(nest.last_element[part], 0);
  Rod rod = whole;
  set_concentric_rest_curvature(nest, state, rod);
  // The frame is that of the element's middle; beyond it the cell of the next joint goes on as at rest.
  const double from_base = whole.total_length_m - 0.5 * (whole.node_from_tip_m[last] + whole.node_from_tip_m[last + 1]);
  const Eigen::Vector3d u = rod.rest_curvature[last + 1];
  return coefficients((quaternion(carrier.orientation[last]) * rotation(u * (nest.parts[part].inserted_m - from_base)) *
                       Eigen::AngleAxisd(state.roll_rad(part, last), Eigen::Vector3d::UnitZ()))
                          .normalized());
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
  if (!turns) state.base_roll_rad[0] = nest.parts[0].roll_rad;
  ConcentricEquilibrium out;
  int leans = 0;
  while (out.rounds < tunables::max_concentric_rounds && !out.converged) {
    ++out.rounds;
    const TwistSolution twist = turns ? solve_twist(nest, state) : TwistSolution{};
    out.turn_rad = twist.turn_rad;
    if (!twist.converged) return out;
    out.converged = turns && out.rounds > 1 && out.turn_rad < tunables::concentric_tolerance_rad;
    if (out.converged) break;  // the carrier has the shape that these angles make
    turn_carrier(nest, base, state, carrier.rods[0], state.carrier.rods[0].base);
    scratch.rods[0].inside.rest_curvature = carrier.rods[0].rest_curvature;
    find_equilibrium(carrier, inputs, state.carrier, scratch, report);
    out.negative_directions = report[0].negative_directions;
    const bool stable = report[0].converged && out.negative_directions == 0;
    if (!stable && leans++ < tunables::max_concentric_leans) {
      lean(carrier.rods[0], state.carrier.rods[0]);
      continue;
    }
    if (!report[0].converged) return out;
    take_moments(carrier.rods[0], state);
    out.converged = !turns;
  }
  const Rod& rod = carrier.rods[0];
  const Eigen::Vector3d load = rod.total_mass_kg * carrier.gravity_W + tip_force_W_N;
  out.base_push_N = -load.dot(to_eigen(director3(state.carrier.rods[0].base.frame())));
  return out;
}

}  // namespace ostium
