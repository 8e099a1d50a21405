#include "core/surface/pose.h"

#include <cmath>

namespace ostium {

namespace {

SurfaceMoment moment(const Surface& surface, double frame, const Eigen::Vector3d& shift_W) {
  SurfaceMoment m;
  m.shift_W = shift_W;
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

void place(const Surface& surface, const Surface::Cluster& c, const SurfaceMoment& m, std::vector<V3<double>>& to) {
  const std::size_t stride = surface.corners, axes = 3;
  const auto mix = [&](int i, std::size_t axis) {
    double sum = m.shift_W[static_cast<int>(axis)];
    for (int j = 0; j < (surface.frames == 1 ? 1 : 4); ++j)
      sum = madd(m.weight[j], surface.corner_frames[(axes * m.frame[j] + axis) * stride + c.first_corner + i], sum);
    return sum;
  };
  for (int i = 0; i < c.corners; ++i) to[i] = {mix(i, 0), mix(i, 1), mix(i, 2)};
}

}  // namespace

SurfacePose::SurfacePose(const Surface& surface)
    : clusters(surface.clusters.size()), listed(surface.clusters.size(), -1) {
  for (std::size_t c = 0; c < clusters.size(); ++c)
    for (auto* corners : {&clusters[c].before, &clusters[c].after}) corners->resize(surface.clusters[c].corners);
}

void set_motion(const Surface& surface, const SurfaceMotion& motion, SurfacePose& pose) {
  pose.before = moment(surface, motion.frame_before, motion.shift_before_W);
  pose.after = moment(surface, motion.frame_after, motion.shift_after_W);
  ++pose.step;
}

void find_clusters(const Surface& surface, const V3<double>& low, const V3<double>& high, SurfacePose& pose,
                   std::vector<int>& found) {
  found.clear();
  ++pose.query;
  const int nodes = static_cast<int>(surface.nodes.size());
  for (const SurfaceMoment* m : {&pose.before, &pose.after}) {
    if (m == &pose.after && m->interval == pose.before.interval && m->shift_W == pose.before.shift_W) break;
    const Box* boxes = &surface.boxes[std::size_t{1} * m->interval * nodes];
    const float lx = low.x - m->shift_W[0], ly = low.y - m->shift_W[1], lz = low.z - m->shift_W[2];
    const float hx = high.x - m->shift_W[0], hy = high.y - m->shift_W[1], hz = high.z - m->shift_W[2];
    for (int n = 0; n < nodes;) {
      const Box& b = boxes[n];
      const Surface::Node& node = surface.nodes[n];
      if (b.low[0] > hx || b.low[1] > hy || b.low[2] > hz || b.high[0] < lx || b.high[1] < ly || b.high[2] < lz) {
        n = node.skip;
        continue;
      }
      ++n;
      if (node.cluster < 0 || pose.listed[node.cluster] == pose.query) continue;
      pose.listed[node.cluster] = pose.query;
      found.push_back(node.cluster);
    }
  }
}

const ClusterPose& corners_of(const Surface& surface, int cluster, SurfacePose& pose) {
  ClusterPose& c = pose.clusters[cluster];
  if (c.computed == pose.step) return c;
  c.computed = pose.step;
  place(surface, surface.clusters[cluster], pose.before, c.before);
  place(surface, surface.clusters[cluster], pose.after, c.after);
  c.low = c.high = c.before[0];
  double move2 = 0;
  for (std::size_t i = 0; i < c.before.size(); ++i) {
    const V3<double>&p = c.before[i], &q = c.after[i], move = q - p;
    c.low = {least(c.low.x, least(p.x, q.x)), least(c.low.y, least(p.y, q.y)), least(c.low.z, least(p.z, q.z))};
    c.high = {largest(c.high.x, largest(p.x, q.x)), largest(c.high.y, largest(p.y, q.y)),
              largest(c.high.z, largest(p.z, q.z))};
    move2 = largest(move2, dot(move, move));
  }
  c.largest_move = std::sqrt(move2);
  return c;
}

}  // namespace ostium
