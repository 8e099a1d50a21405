#include "vascular/treatment/wall_shape.h"

#include <algorithm>
#include <cmath>

#include "core/base/parallel_loop.h"

namespace ostium::vascular {

namespace {

/// A mesh may not beat at all.
PeriodicPoints::Moment moment_of(const MovingLumen& lumen, double phase) {
  return lumen.moving > 0 ? lumen.beat.moment(phase) : PeriodicPoints::Moment{};
}

}  // namespace

WallShape::WallShape(const Patient& patient, const LumenMap& map, const FlowTree& tree)
    : patient_(patient), map_(map), tree_(tree), narrowed_(patient.lumen.vertices(), -1) {
  for (std::size_t i = 0; i < patient.lumen.narrowed.size(); ++i)
    narrowed_[patient.lumen.narrowed[i]] = static_cast<int>(i);
}

Eigen::Vector3d WallShape::vertex(std::size_t v, std::span<const double> radius_m, const LumenMoment& moment) const {
  return vertex(v, radius_m, moment, moment_of(patient_.lumen, moment.phase)) + aside(v, moment);
}

Eigen::Vector3d WallShape::aside(std::size_t v, const LumenMoment& moment) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  if (moment.aside_P.empty()) return sum;
  const auto add = [&](const VertexSource& from, double weight) {
    if (from.part == VertexSource::coronary && weight > 0)
      sum += weight * ((1 - double{from.share}) * moment.aside(static_cast<std::size_t>(from.below)) +
                       double{from.share} * moment.aside(static_cast<std::size_t>(from.above)));
  };
  const LumenMap::Vertex& sources = map_.sources[v];
  add(sources.first, 1 - double{sources.second_share});
  add(sources.second, double{sources.second_share});
  return sum;
}

Eigen::Vector3d WallShape::vertex(std::size_t v, std::span<const double> radius_m, const LumenMoment& moment,
                                  const PeriodicPoints::Moment& beat) const {
  const MovingLumen& lumen = patient_.lumen;
  const VertexSource& from = map_.sources[v].first;
  const Eigen::Vector3d healthy = lumen.healthy(v, beat, moment.breath);
  if (from.part != VertexSource::coronary) return healthy;
  const FlowCell &a = tree_.cells[from.below], &b = tree_.cells[from.above];
  const double w = double(from.share), own = 1 - double(map_.sources[v].second_share);
  const double now = (1 - w) * radius_m[from.below] + w * radius_m[from.above];
  const double full = (1 - w) * a.healthy_m + w * b.healthy_m, ill = (1 - w) * a.diseased_m + w * b.diseased_m;
  Eigen::Vector3d p = healthy;
  double scale = 1;
  if (narrowed_[v] >= 0) {
    const double lost = full - ill, x = lost > 1e-7 ? std::clamp((now - ill) / lost, 0.0, 1.0) : 1;
    p = x * healthy + (1 - x) * lumen.diseased(static_cast<std::size_t>(narrowed_[v]), moment.phase, moment.breath);
    scale = now > full ? now / full : now < ill ? now / ill : 1;
  } else {
    scale = now / full;
  }
  if (std::fabs(scale - 1) < 1e-6) return p;
  const Eigen::Vector3d centre = (1 - w) * map_.coronary.position(from.below, moment.phase) +
                                 w * map_.coronary.position(from.above, moment.phase) + moment.breath * lumen.breath[v];
  return p + own * (scale - 1) * (p - centre);
}

void WallShape::at(std::span<const double> radius_m, const LumenMoment& moment,
                   std::vector<Eigen::Vector3d>& vertices) const {
  vertices.resize(patient_.lumen.vertices());
  const PeriodicPoints::Moment beat = moment_of(patient_.lumen, moment.phase);
  for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = vertex(v, radius_m, moment, beat) + aside(v, moment);
}

void WallShape::at(std::span<const int> which, std::span<const double> radius_m, const LumenMoment& moment,
                   Eigen::Matrix3Xf& out) const {
  const PeriodicPoints::Moment beat = moment_of(patient_.lumen, moment.phase);
  for (const int vertex_id : which) {
    const auto v = static_cast<std::size_t>(vertex_id);
    out.col(vertex_id) = (vertex(v, radius_m, moment, beat) + aside(v, moment)).cast<float>();
  }
}

core::SurfaceDescription WallShape::wall(std::span<const double> radius_m) const {
  core::SurfaceDescription wall;
  wall.triangles = patient_.lumen.triangles;
  wall.sway = patient_.lumen.breath;
  wall.frames.resize(beat_frames);
  core::in_parallel(beat_frames, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f)
      at(radius_m, {.phase = static_cast<double>(f) / beat_frames}, wall.frames[f]);
  });
  return wall;
}

}  // namespace ostium::vascular
