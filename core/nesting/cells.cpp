/// Mass, inertia and stiffness of each rod of a nest in the cells of its chain.
#include <algorithm>
#include <variant>

#include "core/base/tolerances.h"
#include "core/nesting/nest.h"

namespace ostium::core {

namespace {

/// Stiffness of a layer that ends within a joint's cell: over the rest of the cell only the others act, so it is in
/// series with theirs.
Eigen::Vector3d partial(const Nest& nest, int k, int i, double part, const Eigen::Vector3d& own) {
  Eigen::Vector3d others = Eigen::Vector3d::Zero();
  for (int o = 0; o < k; ++o) {
    if (i >= std::max(nest.layers[o].end, nest.layers[o].covered)) continue;
    const S3<double> C = std::visit(
        [&](const auto& law) { return law.template operator()<double>(V3<double>{}, i).tangent; }, nest.layers[o].law);
    others += Eigen::Vector3d(C.xx, C.yy, C.zz);
  }
  Eigen::Vector3d out = part * own.cwiseProduct(others).cwiseQuotient(others + (1 - part) * own);
  out.z() = part * own.z();  // each rod twists on its own
  return out;
}

/// Computes joints and nodes 0 to last of a layer, whose cells are the chain's and not the rod's own.
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
    const double behind = (i > 0 ? chain.length.at(0)[i - 1] : nest.behind_m) / 2, length = chain.joint_length.at(0)[i];
    const double from = nest.depth.at(0)[i] - behind;
    const SectionIntegrals cell = stretch(from, from + length);
    const double part = std::clamp((layer.inserted_m - from) / length, tolerances::least_cover, 1.0);
    // What lies behind the first node of a branch is the trunk's.
    layer.mass.at(0)[i] = i > 0 || !nest.trunk ? cell.mass : stretch(nest.fork_m, from + length).mass;
    Eigen::Vector3d compliance = cell.compliance, rest = cell.rest_angle / (part * length);
    if (part < 1) {
      const SectionIntegrals tip = integrate(rod.sections, 0, part * length);
      rest = tip.rest_angle / (part * length);
      compliance = length * partial(nest, k, i, part, part * length * tip.compliance.cwiseInverse()).cwiseInverse();
    }
    layer.rest.set(i, rest);
    std::visit([&](auto& law) { law.set_cell(i, length, compliance, cell.bending); }, layer.law);
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
      [&](auto& law, const auto& other) {
        // The layers of a nest have the most general law among its rods (scratch.cpp).
        if constexpr (requires { law.copy(other, begin, end, at); }) law.copy(other, begin, end, at);
      },
      to, from);
}

}  // namespace

void end_inside(const Nest& nest, Layer& layer) {
  const int elements = nest.s.inside.elements;
  const auto middle = [&](int e) { return (nest.depth.at(0)[e] + nest.depth.at(0)[e + 1]) / 2; };
  int last = 0;
  while (last + 1 < elements && middle(last) < layer.inserted_m) ++last;
  layer.covered = last + 1, layer.end = 0;
}

void lay_layers(const Model& model, const Scratch& scratch, Nest& nest) {
  Rod& chain = nest.s.inside;
  for (int k = 0; k < nest.layer_count; ++k) {
    Layer& layer = nest.layers[k];
    const bool at_introducer = k == 0 && !nest.trunk;
    const Rod& rod = at_introducer ? scratch.rods[layer.rod].inside : model.rods[layer.rod];
    if (BendingKnots* knots = curve_knots(layer.law)) {  // a layer's law may have been made for another rod
      const BendingKnots* own = curve_knots(rod.law);
      *knots = own ? *own : BendingKnots{};
    }
    layer.damping_s = rod.damping.material_time_s;
    layer.viscous = layer.damping_s / nest.step_s;
    const bool protrudes = layer.end > 0;
    // Last cell to be computed; later ones are the rod's own.
    int own = layer.covered < chain.elements ? layer.covered - 1 : chain.elements;
    if (protrudes) {
      const int first = rod.elements - (layer.end - layer.covered);
      copy_entries(rod.rotary_inertia, first, rod.elements, chain.rotary_inertia, layer.covered);
      copy_entries(rod.radius, first + (k > 0), rod.elements + 1, chain.radius, layer.covered + (k > 0));
      const int from = at_introducer ? 0 : std::min(layer.covered + 2, layer.end + 1);  // joints
      own = from - 1;
      copy_entries(rod.rest_curvature, first + from - layer.covered, rod.elements + 1, layer.rest, from);
      copy_entries(rod.mass, first + from - layer.covered, rod.elements + 1, layer.mass, from);
      copy_law(rod.law, first + from - layer.covered, rod.elements + 1, layer.law, from);
    }
    if (!at_introducer) cut_cells(rod, own, nest, k);
    // If the rod ends inside another one, the node behind its last joint has no mass of it.
    if (!protrudes && own < chain.elements) layer.mass.at(0)[own + 1] = 0;
    const int nodes = own + 1;
    if (k == 0)
      copy_entries(layer.mass, 0, layer.end + 1, chain.mass, 0);
    else
      for (int i = 0; i <= std::max(nodes - 1, layer.end); ++i)
        chain.mass.at(0)[i] = (i > layer.covered && layer.end > 0 ? 0 : chain.mass.at(0)[i]) + layer.mass.at(0)[i];
  }
}

}  // namespace ostium::core
