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
  const std::array<double, 4> w = frame_weights(within - std::floor(within));
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
    for_packs(0, c.corners, [&]<class T>(T, int i) {
      T sum = splat<T>(m.shift_W[axis]);
      for (int j = 0; j < mixed; ++j) sum = madd(splat<T>(weight[j]), widened<T>(row[j] + i), sum);
      if (sway) sum = madd(splat<T>(m.sway), widened<T>(sway + i), sum);
      store(to.at(axis) + i, sum);
    });
  }
}

/// Bounding box of the corners over the step, and their largest displacement.
void bound(int corners, ClusterPose& c) {
  V3<Lanes> low = splat<Lanes>(1e9) * V3<Lanes>{Lanes{} + 1, Lanes{} + 1, Lanes{} + 1}, high = V3<Lanes>{} - low;
  Lanes move2{};
  for_packs(0, corners, [&]<class T>(T, int i) {
    const V3<T> p = load3<T>(c.before, i), q = load3<T>(c.after, i), move = q - p;
    const auto all = [](T x) { return Lanes{} + x; };
    low = {least(low.x, all(least(p.x, q.x))), least(low.y, all(least(p.y, q.y))), least(low.z, all(least(p.z, q.z)))};
    high = {largest(high.x, all(largest(p.x, q.x))), largest(high.y, all(largest(p.y, q.y))),
            largest(high.z, all(largest(p.z, q.z)))};
    move2 = largest(move2, all(dot(move, move)));
  });
  const auto lowest = [](Lanes x) { return -horizontal_max(-x); };
  c.low = {lowest(low.x), lowest(low.y), lowest(low.z)};
  c.high = {horizontal_max(high.x), horizontal_max(high.y), horizontal_max(high.z)};
  c.largest_move = std::sqrt(horizontal_max(move2));
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
    store(to.radius + k, square_root(largest(from(a), largest(from(b), from(d)))) + c.largest_move);
    const V3<T> out = cross(b - a, d - a);
    const V3<T> normal = ((T{} + 1) / square_root(largest(dot(out, out), T{} + smallest_area2))) * out;
    store(to.normal_x + k, normal.x), store(to.normal_y + k, normal.y), store(to.normal_z + k, normal.z);
    store(to.height + k, dot(normal, a));
  });
}

}  // namespace

SurfacePose::SurfacePose(const Surface& surface)
    : clusters(surface.clusters.size()), listed(surface.clusters.size(), -1) {
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (Field<3>* corners : {&clusters[c].before, &clusters[c].after}) corners->resize(surface.clusters[c].corners);
}

void set_motion(const Surface& surface, const SurfaceMotion& motion, SurfacePose& pose) {
  const SurfaceMoment ended = pose.after;
  pose.before = moment(surface, motion.frame_before, motion.shift_before_W, motion.sway_before);
  const bool edited = pose.edits != surface.edits;
  pose.goes_on = pose.before == ended && !edited;
  pose.edits = surface.edits;
  pose.door_open = motion.door_open;
  pose.after = moment(surface, motion.frame_after, motion.shift_after_W, motion.sway_after);
  ++pose.step;
  const auto stays = [](const SurfaceMoment& a, const SurfaceMoment& b) {
    return a.shift_W == b.shift_W && a.sway == b.sway;
  };
  if (edited || !stays(ended, pose.before)) pose.stands_since = pose.step;
  if (!stays(pose.before, pose.after)) pose.stands_since = pose.step + 1;
}

const ClusterPose& pose_of(const Surface& surface, int cluster, SurfacePose& pose) {
  ClusterPose& c = pose.clusters[cluster];
  const Surface::Cluster& described = surface.clusters[cluster];
  if (c.computed == pose.step || (described.stands_still && c.computed >= pose.stands_since)) return c;
  const bool known = pose.goes_on && c.computed == pose.step - 1;
  c.computed = pose.step;
  if (known)
    std::swap(c.before, c.after);
  else
    place(surface, described, pose.before, c.before);
  place(surface, described, pose.after, c.after);
  bound(described.corners, c);
  wrap(surface, described, c);
  return c;
}

}  // namespace ostium::core
