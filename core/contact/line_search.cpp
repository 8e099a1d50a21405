#include "core/contact/line_search.h"

#include <utility>

#include "core/base/tolerances.h"
#include "core/contact/broad_phase.h"
#include "core/math/rotation.h"
#include "core/rod/nodes.h"

namespace ostium::core {

namespace {

/// The quadratic part of the energy between the anchor and the point ahead: its slope at both ends.
struct EndSlopes {
  double at_anchor = 0, at_ahead = 0;
};

void add_end_slopes(const ContactScratch& c, const RodScratch& s, EndSlopes& slopes) {
  const auto [first, last] = settling_nodes(s, c);
  for (int i = first; i <= last; ++i) {
    const V3<double> d = load3<double>(c.ahead, i) - load3<double>(c.anchor, i);
    slopes.at_anchor += dot(load3<double>(c.anchor_push, i), d);
    slopes.at_ahead += dot(load3<double>(c.ahead_push, i), d);
  }
}

void list_planes_ahead(const RodScratch& s, ContactScratch& c) {
  c.planes_ahead.clear();
  const auto [first, last] = settling_nodes(s, c);
  for (int i = first; i <= last; ++i) {
    const NodeWalls& walls = c.walls[i];
    if (walls.count == 0) continue;
    const V3<double> from = load3<double>(c.anchor, i), d = load3<double>(c.ahead, i) - from;
    for (int k = 0; k < walls.count; ++k) {
      const WallPlane& w = walls.planes[k];
      const double push = push_N(w, from), along = dot(w.normal, d), change = -along / w.softness;
      if (push > 0 || push + change > 0) c.planes_ahead.push_back({push, change, along});
    }
  }
}

/// Slope of the whole energy at the share `part` of the direction.
double slope(const EndSlopes& slopes, double part, Tree tree) {
  double sum = slopes.at_anchor + part * (slopes.at_ahead - slopes.at_anchor);
  for (const Strand& strand : tree)
    for (const ContactScratch::PlaneAhead& w : strand.contact->planes_ahead)
      sum -= largest(0, w.push + part * w.change) * w.along;
  return sum;
}

}  // namespace

void look_ahead(const Strand& strand) {
  const RodScratch& s = *strand.s;
  ContactScratch& c = *strand.contact;
  const auto [first, last] = settling_nodes(s, c);
  for (int i = first; i <= last; ++i) {
    const NodeWalls& walls = c.walls[i];
    const V3<double> p = solved_position(s, i);
    V3<double> push{};
    for (int k = 0; k < walls.count; ++k)
      if (walls.planes[k].active) push = madd(push_N(walls.planes[k], p), walls.planes[k].normal, push);
    store3(c.ahead, i, p);
    store3(c.ahead_push, i, push);
  }
}

void start_descent(Tree tree) {
  for (const Strand& strand : tree) {
    ContactScratch& c = *strand.contact;
    std::swap(c.anchor, c.ahead);
    std::swap(c.anchor_push, c.ahead_push);
  }
}

void descend(Tree tree) {
  EndSlopes slopes;
  for (const Strand& strand : tree) {
    add_end_slopes(*strand.contact, *strand.s, slopes);
    list_planes_ahead(*strand.s, *strand.contact);
  }
  double low = 0, high = 1;
  if (slope(slopes, 1, tree) <= 0) low = 1;
  while (high - low > tolerances::least_descent) {
    const double middle = (low + high) / 2;
    (slope(slopes, middle, tree) > 0 ? high : low) = middle;
  }
  const double part = low > 0 ? low : high;
  for (const Strand& strand : tree) {
    ContactScratch& c = *strand.contact;
    const auto [first, last] = settling_nodes(*strand.s, c);
    for (int i = first; i <= last; ++i) {
      const V3<double> from = load3<double>(c.anchor, i), push = load3<double>(c.anchor_push, i);
      store3(c.anchor, i, madd(part, load3<double>(c.ahead, i) - from, from));
      store3(c.anchor_push, i, madd(part, load3<double>(c.ahead_push, i) - push, push));
    }
  }
}

}  // namespace ostium::core
