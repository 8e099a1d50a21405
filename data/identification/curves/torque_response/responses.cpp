#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "data/identification/curves/torque_response/torque_response.h"
#include "data/identification/curves/torque_response/twisted_chain.h"

namespace ostium::data::torque_response {

namespace {

using Eigen::VectorXd;
using units::degree, units::mm;

constexpr double cell_m = 0.025;  // of a bend in which a wire that is curved at rest is pulled
constexpr int fewest_cells = 3;
constexpr double least_compliance = 1;  // rad/(N m), of some 30 um of wire: contacts at one place turn as one

double compliance(const Setup& setup, double from_m, double to_m) {
  double out = 0;
  for (const Section& s : setup.sections)
    out += std::max(0.0, std::min(to_m, s.to_m) - std::max(from_m, s.from_m)) / s.GJ_N_m2;
  return std::max(out, least_compliance);
}

double bending_stiffness(const Setup& setup, double at_m) {
  for (const Section& s : setup.sections)
    if (s.from_m <= at_m && at_m <= s.to_m) return s.EI_N_m2;
  return setup.sections.back().EI_N_m2;
}

TwistedChain chain(const Setup& setup, const Turning& run) {
  std::vector<std::pair<double, Node>> at;
  for (const Contact& c : run.contacts) {
    at.emplace_back(c.at_m, Node{});
    at.back().second.most_Nm = setup.friction * c.force_N * setup.radius_m;
  }
  const double* rest = setup.rest_per_m;
  for (const Bend& bend : run.bends) {
    if (rest[0] == 0 && rest[1] == 0) break;
    const int cells = std::max(fewest_cells, static_cast<int>(std::ceil(bend.length_m / cell_m)));
    const double length = bend.length_m / cells, c = std::cos(bend.plane_rad), s = std::sin(bend.plane_rad);
    for (int k = 0; k < cells; ++k) {
      at.emplace_back(bend.at_m + (k + 0.5) * length, Node{});
      const double size = bending_stiffness(setup, at.back().first) / bend.radius_m * length;
      at.back().second.pull_Nm[0] = size * (c * rest[0] - s * rest[1]);
      at.back().second.pull_Nm[1] = size * (s * rest[0] + c * rest[1]);
    }
  }
  std::stable_sort(at.begin(), at.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Node> nodes;
  double from = 0;
  for (auto& [place, node] : at) node.compliance = compliance(setup, from, place), from = place, nodes.push_back(node);
  return {nodes, setup.handed};
}

/// What arrives of the drive's turn.
VectorXd arriving(const Setup& setup, const VectorXd& turned) {
  VectorXd out(turned.size());
  Eigen::Index moves = 0;
  while (moves + 1 < turned.size() && turned[moves] == turned[0]) ++moves;
  const double side = turned[moves] < turned[0] ? -1 : 1;
  // The band within which the drive moves alone, about what arrives.
  const double left = std::clamp(setup.dead_at_start, 0.0, 1.0) * setup.dead_rad;
  double above = side > 0 ? left : setup.dead_rad - left, below = setup.dead_rad - above, at = turned[0];
  for (Eigen::Index k = 0; k < turned.size(); ++k) {
    at = std::clamp(at, turned[k] - above, turned[k] + below);
    out[k] = (1 - setup.slip) * at;
  }
  return out;
}

}  // namespace

std::vector<curves::Curves> responses(const Setup& setup) {
  std::vector<curves::Curves> out;
  for (const Turning& run : setup.runs) {
    TwistedChain wire = chain(setup, run);
    const VectorXd turned = arriving(setup, run.proximal_rad);
    VectorXd distal(turned.size()), torque(turned.size());
    for (Eigen::Index k = 0; k < turned.size(); ++k) {
      wire.turn(turned[k]);
      distal[k] = (wire.distal_rad() + run.distal_more_rad) / degree, torque[k] = wire.torque_Nm() / mm;
    }
    out.push_back({distal, torque});
  }
  return out;
}

}  // namespace ostium::data::torque_response
