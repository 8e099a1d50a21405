#include "core/wall/pose.h"

#include <cmath>
#include <utility>

namespace ostium::core {

namespace {

constexpr double smallest_area2 = 1e-60;  ///< a triangle without an area gets a normal of 0

SurfaceMoment moment(const Surface& surface, double frame, const Eigen::Vector3d& shift_W, double sway) {
  SurfaceMoment m;
  m.shift_W = shift_W;
  m.sway = surface.sways() ? sway : 0;
  const int n = surface.frames;
  if (n == 1) {
    m.weight[0] = 1;
    return m;
  }
  const double within = frame - n * std::floor(frame / n);
  m.interval = static_cast<int>(within) % n;
  m.share = within - std::floor(within);
  const std::array<double, 4> w = frame_weights(m.share);
  for (int j = 0; j < 4; ++j) m.frame[j] = (m.interval + j - 1 + n) % n, m.weight[j] = w[j];
  return m;
}

template <class T>
T widened(const float* p) {
  if constexpr (sizeof(T) == sizeof(double))
    return *p;
  else
    return _mm256_cvtps_pd(_mm_loadu_ps(p));
}

void place(const Surface& surface, const Surface::Cluster& c, const SurfaceMoment& m, Field<3>& to) {
  constexpr double whole = 1;
  const int mixed = c.stands_still ? 1 : 4;
  const double* weight = c.stands_still ? &whole : m.weight;
  for (int axis = 0; axis < 3; ++axis) {
    const float* row[4];
    for (int j = 0; j < mixed; ++j)
      row[j] = &surface.corner_frames[surface.row(c, c.stands_still ? 0 : m.frame[j], axis)];
    const float* sway = m.sway != 0 ? &surface.corner_sway[surface.sway_row(c, axis)] : nullptr;
    const float* aside = surface.yields() ? &surface.corner_aside[surface.sway_row(c, axis)] : nullptr;
    for_packs(0, c.corners, [&]<class T>(T, int i) {
      T sum = splat<T>(m.shift_W[axis]);
      for (int j = 0; j < mixed; ++j) sum = madd(splat<T>(weight[j]), widened<T>(row[j] + i), sum);
      if (sway) sum = madd(splat<T>(m.sway), widened<T>(sway + i), sum);
      if (aside) sum = sum + widened<T>(aside + i);
      store(to.at(axis) + i, sum);
    });
  }
}

V3<Lanes> all(const V3<double>& a) { return {Lanes{} + a.x, Lanes{} + a.y, Lanes{} + a.z}; }

/// Bounding box of the corners at the beginning of the step, and how they move.
void bound(int corners, ClusterPose& c) {
  V3<Lanes> low = all({1e9, 1e9, 1e9}), high = V3<Lanes>{} - low, after_low = low, after_high = high;
  const auto take = [](const auto& p, V3<Lanes>& lower, V3<Lanes>& upper) {
    lower = {least(lower.x, Lanes{} + p.x), least(lower.y, Lanes{} + p.y), least(lower.z, Lanes{} + p.z)};
    upper = {largest(upper.x, Lanes{} + p.x), largest(upper.y, Lanes{} + p.y), largest(upper.z, Lanes{} + p.z)};
  };
  for_packs(0, corners, [&]<class T>(T, int i) {
    take(load3<T>(c.before, i), low, high), take(load3<T>(c.after, i), after_low, after_high);
  });
  const auto lowest = [](const V3<Lanes>& a) {
    return V3<double>{-horizontal_max(-a.x), -horizontal_max(-a.y), -horizontal_max(-a.z)};
  };
  const auto highest = [](const V3<Lanes>& a) {
    return V3<double>{horizontal_max(a.x), horizontal_max(a.y), horizontal_max(a.z)};
  };
  c.low = lowest(low), c.high = highest(high);
  c.move.drift = 0.5 * (lowest(after_low) + highest(after_high) - c.low - c.high);
  Lanes beside2{};
  for_packs(0, corners, [&]<class T>(T, int i) {
    const V3<T> drift{T{} + c.move.drift.x, T{} + c.move.drift.y, T{} + c.move.drift.z},
        beside = load3<T>(c.after, i) - load3<T>(c.before, i) - drift;
    beside2 = largest(beside2, Lanes{} + dot(beside, beside));
  });
  c.move.spread = std::sqrt(horizontal_max(beside2));
}

void wrap(const Surface& surface, const Surface::Cluster& cluster, ClusterPose& c) {
  const Surface::Triangle* triangle = &surface.triangles[cluster.first_triangle];
  TriangleBounds& to = c.bounds;
  for_packs(0, cluster.triangles, [&]<class T>(T, int k) {
    const V3<T> low{T{} + c.low.x, T{} + c.low.y, T{} + c.low.z};
    const auto corner = [&](int n) {
      const auto of = [&](const double* x) -> T {
        if constexpr (sizeof(T) == sizeof(double))
          return x[triangle[k].corner[n]];
        else
          return T{x[triangle[k].corner[n]], x[triangle[k + 1].corner[n]], x[triangle[k + 2].corner[n]],
                   x[triangle[k + 3].corner[n]]};
      };
      return V3<T>{of(c.before.at(0)), of(c.before.at(1)), of(c.before.at(2))} - low;
    };
    const V3<T> a = corner(0), b = corner(1), d = corner(2), centre = (T{} + 1.0 / 3) * (a + b + d);
    const auto from = [&](const V3<T>& p) { return dot(p - centre, p - centre); };
    store(to.x + k, centre.x), store(to.y + k, centre.y), store(to.z + k, centre.z);
    store(to.radius + k, square_root(largest(from(a), largest(from(b), from(d)))));
    const V3<T> out = cross(b - a, d - a);
    const V3<T> normal = ((T{} + 1) / square_root(largest(dot(out, out), T{} + smallest_area2))) * out;
    store(to.normal_x + k, normal.x), store(to.normal_y + k, normal.y), store(to.normal_z + k, normal.z);
    store(to.height + k, dot(normal, a));
  });
}

/// Whether its pose of this step has been computed.
bool is_known(const Surface::Cluster& described, const ClusterPose& c, const SurfacePose& pose) {
  return c.version == described.version &&
         (c.computed == pose.step || (described.stands_still && c.computed >= pose.stands_since));
}

}  // namespace

SurfacePose::SurfacePose(const Surface& surface) : clusters(surface.clusters.size()) {
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (Field<3>* corners : {&clusters[c].before, &clusters[c].after}) corners->resize(surface.clusters[c].corners);
}

void set_motion(const Surface& surface, const SurfaceMotion& motion, SurfacePose& pose) {
  const SurfaceMoment began = pose.before, ended = pose.after;
  pose.before = moment(surface, motion.frame_before, motion.shift_before_W, motion.sway_before);
  pose.goes_on = pose.before == ended;
  pose.begins_again = pose.before == began;
  pose.door_open = motion.door_open;
  pose.after = moment(surface, motion.frame_after, motion.shift_after_W, motion.sway_after);
  ++pose.step;
  const auto stays = [](const SurfaceMoment& a, const SurfaceMoment& b) {
    return a.shift_W == b.shift_W && a.sway == b.sway;
  };
  if (!stays(ended, pose.before)) pose.stands_since = pose.step;
  if (!stays(pose.before, pose.after)) pose.stands_since = pose.step + 1;
}

namespace {

constexpr double unknown_m = 1;  ///< a bound on what cannot be told cheaply

bool passes_to_next(const Surface& surface, const SurfaceMoment& a, const SurfaceMoment& b) {
  return b.interval == (a.interval + 1) % surface.frames;
}

/// A box with x, y, z in the first three places.
struct Mix {
  __m128 low, high;

  V3<double> lowest() const { return {low[0], low[1], low[2]}; }
  V3<double> highest() const { return {high[0], high[1], high[2]}; }
};

/// Around the corners of a leaf of the tree at a moment: boxes are mixed as positions are. Its middle is the mixed
/// middle.
Mix mixed(const FrameBounds* frames, int node, const SurfaceMoment& m, const Surface& surface) {
  const __m128 shift = _mm_setr_ps(static_cast<float>(m.shift_W[0]), static_cast<float>(m.shift_W[1]),
                                   static_cast<float>(m.shift_W[2]), 0);
  Mix sum{shift, shift};
  const auto add = [&sum](double weight, const float* low_end, const float* high_end) {
    const __m128 w = _mm_set1_ps(static_cast<float>(weight)), low = _mm_mul_ps(w, _mm_loadu_ps(low_end)),
                 high = _mm_mul_ps(w, _mm_loadu_ps(high_end));
    sum.low = _mm_add_ps(sum.low, _mm_min_ps(low, high)), sum.high = _mm_add_ps(sum.high, _mm_max_ps(low, high));
  };
  for (int j = 0; j < 4; ++j) {
    const float* first = reinterpret_cast<const float*>(&frames[j].box);
    add(m.weight[j], first, first + 3);
  }
  const auto add_box = [&](double weight, const Box& box) {
    const float low[4] = {box.low[0], box.low[1], box.low[2], 0}, high[4] = {box.high[0], box.high[1], box.high[2], 0};
    add(weight, low, high);
  };
  if (m.sway != 0) add_box(m.sway, surface.sway_boxes[node]);
  if (surface.yields()) add_box(1, surface.aside_boxes[node]);
  return sum;
}

/// Half the diagonal of a box.
double half_size(const Box& box) {
  double sum2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double size = box.high[axis] - box.low[axis];
    sum2 += size * size;
  }
  return std::sqrt(sum2) / 2;
}

/// How far corners move beside the middle of their box, from one mixture of the frames of an interval to another.
double spread_between(const FrameBounds* frames, const double* weight, const double* then) {
  double share = 0, spread = 0;
  for (int j = 3; j > 0; --j) {
    share += then[j] - weight[j];
    spread += std::fabs(share) * frames[j - 1].spread_m;
  }
  return spread;
}

}  // namespace

RoughPose rough_pose(const Surface& surface, int node, const V3<double>& low, const V3<double>& high,
                     const SurfacePose& pose) {
  const int cluster = surface.nodes[node].cluster;
  const ClusterPose& known = pose.clusters[cluster];
  if (is_known(surface.clusters[cluster], known, pose)) return {known.low, known.high, known.move};
  const SurfaceMoment &a = pose.before, &b = pose.after;
  if (surface.clusters[cluster].stands_still || (a.interval != b.interval && !passes_to_next(surface, a, b)))
    return {low, high, {{}, unknown_m}};
  constexpr double rounding_m = 2e-6;  // of single precision, a metre from the origin
  const FrameBounds *from = surface.bounds_of(cluster, a.interval), *to = surface.bounds_of(cluster, b.interval);
  const Mix before = mixed(from, node, a, surface), after = mixed(to, node, b, surface);
  RoughPose rough{before.lowest(), before.highest(), {}};
  rough.move.drift = 0.5 * (after.lowest() + after.highest() - rough.low - rough.high);
  rough.move.spread = rounding_m;
  if (a.interval == b.interval) {
    rough.move.spread += spread_between(from, a.weight, b.weight);
  } else {
    constexpr double begins[] = {0, 1, 0, 0}, ends[] = {0, 0, 1, 0};
    rough.move.spread += spread_between(from, a.weight, ends) + spread_between(to, begins, b.weight);
  }
  if (b.sway != a.sway) rough.move.spread += std::fabs(b.sway - a.sway) * half_size(surface.sway_boxes[node]);
  const V3<double> margin{rounding_m, rounding_m, rounding_m};
  rough.low = rough.low - margin, rough.high = rough.high + margin;
  return rough;
}

namespace {

bool lies_within(const V3<double>& low, const V3<double>& high, const LeafList& list, double margin_m) {
  return low.x >= list.low.x + margin_m && low.y >= list.low.y + margin_m && low.z >= list.low.z + margin_m &&
         high.x <= list.high.x - margin_m && high.y <= list.high.y - margin_m && high.z <= list.high.z - margin_m;
}

/// How far the sway has carried any corner beyond what the list was made for, m.
double swayed_m(const Surface& surface, const SurfacePose& pose, const LeafList& list) {
  const double low = std::min(pose.before.sway, pose.after.sway), high = std::max(pose.before.sway, pose.after.sway),
               beyond = std::max({0.0, list.sway_low - low, high - list.sway_high});
  if (beyond == 0) return 0;
  const Box& all = surface.sway_boxes[0];
  double most2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double most = std::max(std::fabs(all.low[axis]), std::fabs(all.high[axis]));
    most2 += most * most;
  }
  return beyond * std::sqrt(most2);
}

}  // namespace

bool renew(const Surface& surface, const V3<double>& low, const V3<double>& high, const SurfacePose& pose,
           LeafList& list) {
  constexpr double margin_m = 1e-3, rounding_m = 1e-6;
  const SurfaceMoment &a = pose.before, &b = pose.after;
  if ((a.interval != b.interval && !passes_to_next(surface, a, b)) || a.shift_W != b.shift_W) return false;
  if (list.interval == a.interval && list.interval == b.interval && list.shift_W == a.shift_W &&
      lies_within(low, high, list, swayed_m(surface, pose, list) + (surface.moved_m - list.moved_m) + rounding_m))
    return true;
  const V3<double> margin{margin_m, margin_m, margin_m}, shift{a.shift_W[0], a.shift_W[1], a.shift_W[2]};
  list.low = low - margin, list.high = high + margin;
  list.sway_low = std::min(a.sway, b.sway), list.sway_high = std::max(a.sway, b.sway);
  list.moved_m = surface.moved_m, list.shift_W = a.shift_W;
  list.leaves.clear();
  ++list.made;
  bool all = true;
  visit_leaves(surface, pose, BoxQuery(list.low - shift, list.high - shift), [&](int n, const BoxEnds&) {
    all = all && list.leaves.size() < LeafList::most;
    if (all) list.leaves.push_back(n);
  });
  list.interval = all ? b.interval : -1;
  return all;
}

namespace {

V3<double> middle(const Box& box) {
  const auto at = [&](int axis) { return 0.5 * (double{box.low[axis]} + double{box.high[axis]}); };
  return {at(0), at(1), at(2)};
}

double length(const V3<double>& a) { return std::sqrt(dot(a, a)); }

}  // namespace

V3<double> middle_of(const Surface& surface, int node, const SurfaceMoment& m) {
  const FrameBounds* frames = surface.bounds_of(surface.nodes[node].cluster, m.interval);
  V3<double> sum{m.shift_W[0], m.shift_W[1], m.shift_W[2]};
  for (int j = 0; j < 4; ++j) sum = madd(m.weight[j], middle(frames[j].box), sum);
  if (m.sway != 0) sum = madd(m.sway, middle(surface.sway_boxes[node]), sum);
  return surface.yields() ? sum + middle(surface.aside_boxes[node]) : sum;
}

RelativeSpeed relative_speed(const Surface& surface, int interval, int cluster, int other) {
  const FrameBounds *own = surface.bounds_of(cluster, interval), *its = surface.bounds_of(other, interval);
  V3<double> d[3];  // from frame to frame
  double beside[3];
  for (int j = 0; j < 3; ++j) {
    d[j] = middle(own[j + 1].box) - middle(own[j].box) - (middle(its[j + 1].box) - middle(its[j].box));
    beside[j] = own[j].spread_m;
  }
  // The velocity within the interval is a quadratic Bezier curve: it stays within its three points.
  const V3<double> ends = 0.5 * (d[0] + d[2]);
  return {largest(largest(length(0.5 * (d[0] + d[1])), length(0.5 * (d[1] + d[2]))), length(2.0 * d[1] - ends)),
          largest(0.5 * largest(beside[0] + beside[1], beside[1] + beside[2]),
                  2 * beside[1] + 0.5 * (beside[0] + beside[2]))};
}

double relative_sway(const Surface& surface, int node, int other_node) {
  if (!surface.sways()) return 0;
  const Box &own = surface.sway_boxes[node], &its = surface.sway_boxes[other_node];
  return length(middle(own) - middle(its)) + half_size(own);
}

const ClusterPose& pose_of(const Surface& surface, int cluster, SurfacePose& pose) {
  ClusterPose& c = pose.clusters[cluster];
  const Surface::Cluster& described = surface.clusters[cluster];
  if (is_known(described, c, pose)) return c;
  const bool was_known = c.computed == pose.step - 1 && c.version == described.version,
             begins_again = was_known && pose.begins_again;
  c.computed = pose.step, c.version = described.version;
  ++pose.posed;
  if (was_known && pose.goes_on)
    std::swap(c.before, c.after);
  else if (!begins_again)
    place(surface, described, pose.before, c.before);
  place(surface, described, pose.after, c.after);
  bound(described.corners, c);
  if (!begins_again) wrap(surface, described, c);
  return c;
}

}  // namespace ostium::core
