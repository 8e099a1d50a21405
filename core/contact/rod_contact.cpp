#include "core/contact/rod_contact.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerances.h"
#include "core/math/rotation.h"
#include "core/nesting/nest.h"
#include "core/rod/nodes.h"
#include "core/solver/node_spring.h"

namespace ostium::core {

namespace {

constexpr int block = 8;  // elements tested together first

/// Closest points of the segments a + s (b - a) and c + t (d - c), 0 <= s, t <= 1 (Ericson 2005, Real-Time Collision
/// Detection, 5.1.9; segments of zero length do not occur).
void closest(const V3<double>& a, const V3<double>& b, const V3<double>& c, const V3<double>& d, double& s, double& t) {
  const V3<double> u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), uw = dot(u, w), vw = dot(v, w);
  const double area = uu * vv - uv * uv;
  s = area > 1e-9 * uu * vv ? std::clamp((uv * vw - uw * vv) / area, 0.0, 1.0) : 0.5;
  t = (uv * s + vw) / vv;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
  }
}

/// Bounding ball of elements [from, to).
struct Ball {
  V3<double> centre;
  double radius;
};

Ball ball_of(const RodScratch& s, int from, int to) {
  const V3<double> a = load3<double>(s.position, from), b = load3<double>(s.position, to);
  Ball ball{0.5 * (a + b), 0};
  for (int i = from; i <= to; ++i) {
    const V3<double> off = load3<double>(s.position, i) - ball.centre;
    ball.radius = std::max(ball.radius, std::sqrt(dot(off, off)) + s.inside.radius.at(0)[i]);
  }
  return ball;
}

bool near(const Ball& a, const Ball& b) {
  const V3<double> d = a.centre - b.centre;
  const double reach = a.radius + b.radius + tolerances::rods_near_m;
  return dot(d, d) < reach * reach;
}

/// Compliance of the point from inertia alone, m/N.
double softness(const RodSpot& spot, const RodScratch& s) {
  double sum = 0;
  for (int e = 0; e < 2; ++e) sum += spot.share[e] * spot.share[e] / s.inside.mass.at(0)[spot.node + e];
  return s.step_s * s.step_s / 2.25 * sum;
}

V3<double> place_of(const RodSpot& spot, const Field<3>& position) {
  const V3<double> a = load3<double>(position, spot.node), b = load3<double>(position, spot.node + 1);
  return madd(spot.share[1], b - a, a);
}

double radius_of(const RodSpot& spot, const RodScratch& s) {
  const double* radius = s.inside.radius.at(0);
  return std::max(radius[spot.node], radius[spot.node + 1]);
}

/// The last step's contact force on the two nodes, along n.
double last_push(const RodSpot& spot, const Strand& strand, const V3<double>& n) {
  V3<double> force{};
  for (int e = 0; e < 2; ++e) force = force + load3<double>(strand.own->rod_force, spot.node + e);
  return dot(force, n);
}

/// Adds a contact between element i of strand a and element j of strand b, if they are near.
void consider(Scratch& scratch, int a, int i, int b, int j) {
  if (scratch.rod_contacts.size() == scratch.rod_contacts.capacity()) return;
  const Strand &A = scratch.strands[a], &B = scratch.strands[b];
  const auto at = [](const Strand& strand, int node) { return load3<double>(strand.s->position, node); };
  double s, t;
  closest(at(A, i), at(A, i + 1), at(B, j), at(B, j + 1), s, t);
  // A segment's far end is the next one's near end, and is counted there.
  if ((s == 1 && i + 1 < A.s->inside.elements) || (t == 1 && j + 1 < B.s->inside.elements)) return;
  RodContact c;
  c.a = a, c.at_a = {i, {1 - s, s}};
  c.b = b, c.at_b = {j, {1 - t, t}};
  const V3<double> apart = place_of(c.at_a, A.own->position) - place_of(c.at_b, B.own->position);
  const double distance = std::sqrt(dot(apart, apart));
  c.radii = radius_of(c.at_a, *A.s) + radius_of(c.at_b, *B.s);
  if (distance > c.radii + tolerances::rods_near_m || distance < 1e-9) return;
  c.normal = (1 / distance) * apart;
  // Rods that were pressed against each other stay on their sides.
  if (last_push(c.at_a, A, c.normal) < 0 && last_push(c.at_b, B, c.normal) > 0) c.normal = V3<double>{} - c.normal;
  c.stiffness = tolerances::rods_grip / (softness(c.at_a, *A.s) + softness(c.at_b, *B.s));
  scratch.rod_contacts.push_back(c);
}

void consider_blocks(Scratch& scratch, int a, int b) {
  const RodScratch &A = *scratch.strands[a].s, &B = *scratch.strands[b].s;
  for (int p = A.inside.first; p < A.inside.elements; p += block) {
    const int p_end = std::min(p + block, A.inside.elements);
    const Ball ball = ball_of(A, p, p_end);
    for (int q = a == b ? p : B.inside.first; q < B.inside.elements; q += block) {
      const int q_end = std::min(q + block, B.inside.elements);
      if (!near(ball, ball_of(B, q, q_end))) continue;
      for (int i = p; i < p_end; ++i)
        for (int j = q; j < q_end; ++j) {
          if (!near(ball_of(A, i, i + 1), ball_of(B, j, j + 1))) continue;
          if (a == b) {
            if (j <= i) continue;
            double between = 0;
            for (int e = i + 1; e < j; ++e) between += A.inside.length.at(0)[e];
            if (between < tolerances::own_apart_radii * (A.inside.radius.at(0)[i] + A.inside.radius.at(0)[j])) continue;
          }
          consider(scratch, a, i, b, j);
        }
    }
  }
}

/// Penetration depth in the iterate, m.
double depth(const RodContact& c, const Scratch& scratch) {
  const V3<double> apart =
      place_of(c.at_a, scratch.strands[c.a].s->position) - place_of(c.at_b, scratch.strands[c.b].s->position);
  return c.radii - dot(c.normal, apart);
}

/// Force on one strand, N, updated by how its point has moved since the round began.
double felt(const RodContact& c, const RodSpot& spot, const V3<double>& seen, const V3<double>& away,
            const RodScratch& s) {
  if (!c.active) return 0;
  return c.push_N - c.stiffness * dot(away, place_of(spot, s.position) - seen);
}

/// Begins a round from the current positions.
void look(RodContact& c, const Scratch& scratch) {
  c.seen_a = place_of(c.at_a, scratch.strands[c.a].s->position);
  c.seen_b = place_of(c.at_b, scratch.strands[c.b].s->position);
  c.push_N += c.stiffness * c.deep;
  c.active = c.push_N > 0;
}

}  // namespace

void find_rod_contacts(const Model& model, Scratch& scratch) {
  scratch.rod_contacts.clear();
  scratch.rod_rounds = 0;
  if (!model.rods_touch) return;
  const int strands = static_cast<int>(scratch.strands.size());
  for (int a = 0; a < strands; ++a)
    for (int b = a; b < strands; ++b) consider_blocks(scratch, a, b);
  // A node's force of the last step is divided among its contacts.
  for (const Strand& strand : scratch.strands)
    std::fill_n(strand.contact->rod_shares.begin(), strand.s->inside.nodes(), 0.0);
  const auto for_both = [&](auto&& visit) {
    for (RodContact& c : scratch.rod_contacts)
      visit(c, c.at_a, scratch.strands[c.a], 1), visit(c, c.at_b, scratch.strands[c.b], -1);
  };
  for_both([](RodContact&, const RodSpot& spot, const Strand& strand, int) {
    for (int e = 0; e < 2; ++e) strand.contact->rod_shares[spot.node + e] += spot.share[e];
  });
  for_both([](RodContact& c, const RodSpot& spot, const Strand& strand, int sign) {
    for (int e = 0; e < 2; ++e)
      if (const double all = strand.contact->rod_shares[spot.node + e]; all > 0)
        c.push_N +=
            0.5 * sign * spot.share[e] / all * dot(c.normal, load3<double>(strand.own->rod_force, spot.node + e));
  });
  for (RodContact& c : scratch.rod_contacts) {
    c.push_N = std::max(c.push_N, 0.0), c.deep = depth(c, scratch);
    look(c, scratch);
  }
}

void tie_to_rods(const Strand& strand, Scratch& scratch) {
  RodScratch& s = *strand.s;
  const auto hold = [&](const RodContact& c, const RodSpot& spot, const V3<double>& away) {
    for (int e = 0; e < 2; ++e) {
      const int i = spot.node + e;
      if (spot.share[e] <= 0) continue;
      // Rest position of the node's spring: where its own move brings the push to zero.
      const V3<double> was = load3<double>(s.position, i);
      const double place = dot(away, was) + c.push_N / c.stiffness;
      S3<double> P = load6<double>(s.chain.compliance, i);
      V3<double> target = load3<double>(s.target, i);
      tie(away, place, 1 / (spot.share[e] * c.stiffness), P, target);
      store6(s.chain.compliance, i, P);
      store3(s.target, i, target);
    }
  };
  for (const RodContact& c : scratch.rod_contacts) {
    if (!c.active) continue;
    if (scratch.strands[c.a].s == strand.s) hold(c, c.at_a, c.normal);
    if (scratch.strands[c.b].s == strand.s) hold(c, c.at_b, V3<double>{} - c.normal);
  }
}

bool renew_rod_contacts(Scratch& scratch) {
  if (scratch.rod_contacts.empty()) return false;
  bool again = false;
  for (RodContact& c : scratch.rod_contacts) {
    const RodScratch &A = *scratch.strands[c.a].s, &B = *scratch.strands[c.b].s;
    const double by_a = felt(c, c.at_a, c.seen_a, c.normal, A),
                 by_b = felt(c, c.at_b, c.seen_b, V3<double>{} - c.normal, B);
    c.push_N = std::max(0.0, (by_a + by_b) / 2);
    const double deep = depth(c, scratch);
    // Stiff rods, or rods on walls, yield less than inertia alone suggests.
    if (c.push_N > 0 && std::fabs(deep) > tolerances::rods_slow * std::fabs(c.deep))
      c.stiffness *= deep * c.deep > 0 ? tolerances::rods_harder : tolerances::rods_softer;
    c.deep = deep;
    again = again || std::fabs(by_a - by_b) > tolerances::rods_uneven * c.push_N + tolerances::rods_uneven_N ||
            deep > tolerances::rods_deep_m || (c.push_N > 0 && deep < -tolerances::rods_deep_m);
  }
  if (!again || ++scratch.rod_rounds > tolerances::max_rod_rounds) return false;
  for (RodContact& c : scratch.rod_contacts) look(c, scratch);
  return true;
}

void commit_rod_contacts(Scratch& scratch, std::vector<RodTouch>& touches) {
  touches.clear();
  for (const Strand& strand : scratch.strands)
    std::fill(strand.own->rod_force.raw().begin(), strand.own->rod_force.raw().end(), 0.0);
  for (const RodContact& c : scratch.rod_contacts) {
    if (!(c.push_N > 0)) continue;
    const Strand &A = scratch.strands[c.a], &B = scratch.strands[c.b];
    const V3<double> force = c.push_N * c.normal;
    const auto add = [](const RodSpot& spot, double sign, const V3<double>& f, RodState& own) {
      for (int e = 0; e < 2; ++e)
        store3(own.rod_force, spot.node + e,
               madd(sign * spot.share[e], f, load3<double>(own.rod_force, spot.node + e)));
    };
    add(c.at_a, 1, force, *A.own), add(c.at_b, -1, force, *B.own);
    const NodeOfRod a = node_of_rod(A, c.at_a.node), b = node_of_rod(B, c.at_b.node);
    const V3<double> p = madd(-radius_of(c.at_a, *A.s), c.normal, place_of(c.at_a, A.s->position));
    touches.push_back({a.rod, a.node, b.rod, b.node, to_eigen(p), to_eigen(force)});
  }
}

}  // namespace ostium::core
