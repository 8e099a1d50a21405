#include "vascular/motion/moving_lumen.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/base/parallel_loop.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::vascular {

Eigen::Vector3d MovingLumen::healthy(std::size_t vertex, const PeriodicPoints::Moment& moment, double depth) const {
  const Eigen::Vector3d p = vertex < moving ? beat.position(vertex, moment) : still[vertex - moving];
  return p + depth * breath[vertex];
}

Eigen::Vector3d MovingLumen::diseased(std::size_t i, double phase, double depth) const {
  return diseased_beat.position(i, phase) + depth * breath[narrowed[i]];
}

Mesh MovingLumen::at(double phase, double depth, double opened) const {
  Mesh mesh{.vertices = {}, .triangles = triangles};
  mesh.vertices.reserve(vertices());
  for (std::size_t i = 0; i < vertices(); ++i) mesh.vertices.push_back(healthy(i, phase, depth));
  for (std::size_t i = 0; i < narrowed.size(); ++i) {
    Eigen::Vector3d& p = mesh.vertices[narrowed[i]];
    p = opened * p + (1 - opened) * diseased(i, phase, depth);
  }
  return mesh;
}

namespace {

/// Averages displacements from `rest` with the neighbours' mean, half and half; vertices beyond the size of `rest` do
/// not move.
void smooth_paths(const std::vector<std::array<int, 3>>& triangles, const std::vector<Eigen::Vector3d>& rest,
                  int rounds, std::vector<std::vector<Eigen::Vector3d>>& frames) {
  const std::size_t n = rest.size();
  std::vector<std::vector<int>> ring(n);
  for (const auto& t : triangles)
    for (int k = 0; k < 3; ++k)
      if (static_cast<std::size_t>(t[k]) < n) ring[t[k]].push_back(t[(k + 1) % 3]);
  for (std::vector<Eigen::Vector3d>& frame : frames) {
    for (std::size_t i = 0; i < n; ++i) frame[i] -= rest[i];
    for (int round = 0; round < rounds; ++round) {
      std::vector<Eigen::Vector3d> next(n);
      for (std::size_t i = 0; i < n; ++i) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int other : ring[i])
          if (static_cast<std::size_t>(other) < n) sum += frame[other];
        next[i] =
            ring[i].empty() ? frame[i] : Eigen::Vector3d((frame[i] + sum / static_cast<double>(ring[i].size())) / 2);
      }
      frame = std::move(next);
    }
    for (std::size_t i = 0; i < n; ++i) frame[i] += rest[i];
  }
}

}  // namespace

MovingLumen make_moving_lumen(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const HeartMotion& motion,
                              const TubeMotion& tubes, Contour contour, int smoothing,
                              const std::vector<std::vector<Eigen::Vector3d>>& own) {
  for (const Lesion& lesion : lesions)
    if (const int tube = find_branch(anatomy, lesion.branch)->tube; is_aorta(anatomy, tube) || !tubes.moves(tube))
      throw std::invalid_argument("there is no lesion model for " + lesion.branch + "; expected a coronary artery");
  const std::size_t n = contour.mesh.vertices.size();
  const auto beats = [&](int v) {
    if (!own.empty()) {
      const Eigen::Vector3d& p = contour.mesh.vertices[v];
      return is_displaced(contour.mesh.vertices, own, v) ||
             vascular::diseased(anatomy, lesions, p, contour.shares[v]) != p;
    }
    for (const TubeShare& s : contour.shares[v])
      if (tubes.breath_share(s.tube, s.s_m) > 0) return true;
    return false;
  };
  std::vector<int> order(n), new_index(n);
  std::iota(order.begin(), order.end(), 0);
  const auto first_still = std::stable_partition(order.begin(), order.end(), beats);
  for (std::size_t i = 0; i < n; ++i) new_index[order[i]] = static_cast<int>(i);

  MovingLumen lumen;
  lumen.moving = static_cast<std::size_t>(first_still - order.begin());
  lumen.triangles = std::move(contour.mesh.triangles);
  for (auto& triangle : lumen.triangles)
    for (int& v : triangle) v = new_index[v];
  std::vector<std::vector<Eigen::Vector3d>> frames(beat_frames, std::vector<Eigen::Vector3d>(lumen.moving));
  std::vector<std::vector<Eigen::Vector3d>> diseased_frames(beat_frames);
  std::vector<Eigen::Vector3d> rest;
  core::in_parallel(lumen.moving, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (int f = 0; f < beat_frames; ++f)
        frames[f][i] = own.empty() ? tubes.carried(contour.mesh.vertices[order[i]], contour.shares[order[i]], f)
                                   : own[f][order[i]];
  });
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d p = contour.mesh.vertices[order[i]];
    lumen.shares.push_back(std::move(contour.shares[order[i]]));
    const std::vector<TubeShare>& shares = lumen.shares.back();
    double breath = 0;
    for (const TubeShare& s : shares) breath += s.weight * tubes.breath_share(s.tube, s.s_m);
    lumen.breath.push_back(breath * motion.breath_displacement(p, 1));
    if (i >= lumen.moving) {
      lumen.still.push_back(p);
      continue;
    }
    rest.push_back(p);
    const Eigen::Vector3d q = vascular::diseased(anatomy, lesions, p, shares);
    if (q == p) continue;
    lumen.narrowed.push_back(static_cast<int>(i));
    for (int f = 0; f < beat_frames; ++f)
      diseased_frames[f].push_back(tubes.carried(q, shares, f) -
                                   (own.empty() ? frames[f][i] : tubes.carried(p, shares, f)));
  }
  if (smoothing > 0) smooth_paths(lumen.triangles, rest, smoothing, frames);
  for (int f = 0; f < beat_frames; ++f)
    for (std::size_t i = 0; i < lumen.narrowed.size(); ++i) diseased_frames[f][i] += frames[f][lumen.narrowed[i]];
  lumen.beat = PeriodicPoints(frames);
  lumen.diseased_beat = PeriodicPoints(diseased_frames);
  return lumen;
}

}  // namespace ostium::vascular
