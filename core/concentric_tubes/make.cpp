#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/concentric_tubes/concentric.h"

namespace ostium::core {

namespace {

/// The section of `part` at `from_base` along the centreline, null beyond its tip.
const Section* section_at(const ConcentricPart& part, double from_base) {
  const double from_tip = part.inserted_m - from_base;
  if (from_tip <= 0) return nullptr;
  for (const Section& s : part.sections)
    if (from_tip <= s.to_tip_m) return &s;
  return &part.sections.back();
}

/// Distances from the base at which a part or one of its sections ends.
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
    check({d.name, part.sections, std::vector<double>(16, part.inserted_m / 16), {}, {}});
    if (!(part.shaft_rad_per_Nm >= 0) || !std::isfinite(part.roll_rad))
      refuse(i, "the shaft's compliance must not be negative, and the roll be finite");
    if (d.parts.size() == 1) continue;
    for (const Section& s : part.sections)
      if (s.EI1_N_m2 != s.EI2_N_m2 || s.rest_curvature_per_m.z() != 0)
        refuse(i, "nested instruments must be equally stiff about both axes and without twist at rest");
    for (const Section& s : part.sections)
      if (s.softening_per_m > 0 && s.softened_ratio < 1) refuse(i, "nested instruments must not soften");
    for (const Section& s : part.sections)
      if (!s.bending.linear()) refuse(i, "nested instruments must bend linearly");
  }
}

/// Combined stiffness and weight of all parts. A single part keeps its rest shape; with several, the rest shape follows
/// from the angles.
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

/// Boundaries of the joints' cells: the base, the element middles, the tip.
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
    // Scaled so that the parts' torques add up to the carrier's, even if parts end within the cell.
    nest.GJ_N_m2.col(k) *= stiffness_at_rest(nest.carrier.rods[0], static_cast<int>(k)).z() / nest.GJ_N_m2.col(k).sum();
  }
}

void hang_loads(const std::vector<ConcentricLoad>& loads, const std::vector<double>& element_lengths, Rod& rod) {
  if (loads.empty()) return;
  rod.dead_load.resize(rod.nodes());
  for (const ConcentricLoad& load : loads) {
    double from = 0;
    std::size_t e = 0;
    while (e + 1 < element_lengths.size() && from + element_lengths[e] < load.from_base_m) from += element_lengths[e++];
    const double t = std::clamp((load.from_base_m - from) / element_lengths[e], 0.0, 1.0);
    const int i = static_cast<int>(e);
    rod.dead_load.set(i, rod.dead_load[i] + (1 - t) * load.force_W_N);
    rod.dead_load.set(i + 1, rod.dead_load[i + 1] + t * load.force_W_N);
  }
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
  nest.carrier.rods = {make_rod({d.name, composite(d.parts, longest->inserted_m), d.element_lengths_m, {}, {}})};
  hang_loads(d.loads, d.element_lengths_m, nest.carrier.rods[0]);
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

}  // namespace ostium::core
