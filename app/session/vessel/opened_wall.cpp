#include "app/session/vessel/opened_wall.h"

#include <algorithm>
#include <cmath>

namespace ostium::app {

namespace {

std::vector<double> untreated(const vascular::FlowTree& tree) {
  std::vector<double> radii;
  for (const vascular::FlowCell& cell : tree.cells) radii.push_back(cell.diseased_m);
  return radii;
}

}  // namespace

void follow_lumen(const vascular::FlowTree& tree, const std::vector<double>& radius_m, int& cursor,
                  std::vector<double>& wall_m) {
  const int n = static_cast<int>(wall_m.size());
  int moved = 0, c = cursor < n ? cursor : 0;
  for (int k = 0; k < n; ++k, c = c + 1 < n ? c + 1 : 0) {
    const vascular::FlowCell& cell = tree.cells[c];
    const double slack = cell.diseased_m < 0.98 * cell.healthy_m || radius_m[c] > 1.02 * cell.healthy_m
                             ? wall_follows_m
                             : wall_follows_share * cell.healthy_m;
    if (std::fabs(radius_m[c] - wall_m[c]) <= slack) continue;
    wall_m[c] = radius_m[c];
    cursor = c + 1 < n ? c + 1 : 0;
    if (++moved == wall_cells_a_step) return;
  }
}

bool is_opened(const Vessel& vessel, const std::vector<double>& wall_m) {
  const std::vector<vascular::FlowCell>& cells = vessel.coronaries->tree().cells;
  return !std::equal(wall_m.begin(), wall_m.end(), cells.begin(), cells.end(),
                     [](double radius_m, const vascular::FlowCell& cell) { return radius_m == cell.diseased_m; });
}

void follow_aside(const std::vector<Eigen::Vector3d>& aside_P, std::vector<Eigen::Vector3d>& wall_aside_P) {
  for (std::size_t c = 0; c < aside_P.size(); ++c) {
    const Eigen::Vector3d lags = aside_P[c] - wall_aside_P[c];
    if (const double far_m = lags.norm(); far_m > aside_follows_m)
      wall_aside_P[c] += std::min(1.0, aside_step_m / far_m) * lags;
  }
}

bool is_aside(const std::vector<Eigen::Vector3d>& wall_aside_P) {
  return std::any_of(wall_aside_P.begin(), wall_aside_P.end(), [](const Eigen::Vector3d& p) { return !p.isZero(0); });
}

OpenedWall::OpenedWall(const Vessel& vessel, core::Surface& surface, bool yields)
    : coronaries_(*vessel.coronaries),
      editor_(vessel.wall, surface),
      now_m_(untreated(vessel.coronaries->tree())),
      is_listed_(coronaries_.map.sources.size(), 0),
      placed_(3, static_cast<Eigen::Index>(coronaries_.map.sources.size())) {
  listed_.reserve(is_listed_.size());
  if (!yields) return;
  editor_.let_yield();
  now_aside_P_.assign(now_m_.size(), Eigen::Vector3d::Zero());
}

void OpenedWall::list(const CellVertices& of_cells, std::size_t cell) {
  for (const int v : of_cells.of(cell))
    if (!is_listed_[v]) is_listed_[v] = 1, listed_.push_back(v);
}

void OpenedWall::open(const std::vector<double>& wall_m) {
  for (std::size_t c = 0; c < now_m_.size(); ++c)
    if (wall_m[c] != now_m_[c]) list(coronaries_.opened_with, c);
  now_m_ = wall_m;
  for (int f = 0; f < vascular::beat_frames; ++f) {
    coronaries_.shape->at(listed_, now_m_, {.phase = static_cast<double>(f) / vascular::beat_frames}, placed_);
    for (const int v : listed_) editor_.place(v, f, placed_.col(v).cast<double>());
  }
  editor_.refit();
}

void OpenedWall::move_aside(const std::vector<Eigen::Vector3d>& wall_aside_P) {
  for (std::size_t c = 0; c < now_aside_P_.size(); ++c)
    if (wall_aside_P[c] != now_aside_P_[c]) list(coronaries_.aside_with, c);
  now_aside_P_ = wall_aside_P;
  for (const int v : listed_)
    editor_.put_aside(v, coronaries_.shape->aside(static_cast<std::size_t>(v), {.aside_P = now_aside_P_}));
  editor_.refit_aside();
}

void OpenedWall::set(const std::vector<double>& wall_m, const std::vector<Eigen::Vector3d>& wall_aside_P) {
  const auto forget = [&] {
    for (const int v : listed_) is_listed_[v] = 0;
    listed_.clear();
  };
  if (wall_m != now_m_) open(wall_m), forget();
  if (wall_aside_P != now_aside_P_) move_aside(wall_aside_P), forget();
}

Eigen::Vector3d wall_vertex(const Vessel& vessel, const std::vector<double>& wall_m, int vertex,
                            const vascular::LumenMoment& moment) {
  const double frame = vessel_frame(vessel, moment.phase);
  const auto untreated = [&] { return vertex_at(vessel.wall, vertex, frame, moment.breath); };
  if (!vessel.coronaries || static_cast<std::size_t>(vertex) >= vessel.coronaries->map.sources.size())
    return untreated();  // a mesh or the ventricle
  const Coronaries& c = *vessel.coronaries;
  const auto v = static_cast<std::size_t>(vertex);
  const vascular::VertexSource& from = c.map.sources[v].first;
  const auto untouched = [&](int cell) { return wall_m[cell] == c.tree().cells[cell].diseased_m; };
  if (from.part != vascular::VertexSource::coronary || (untouched(from.below) && untouched(from.above)))
    return untreated() + c.shape->aside(v, moment);
  const double k = std::floor(frame);
  const std::array<double, 4> w = core::frame_weights(frame - k);
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (int j = 0; j < 4; ++j) {
    const int f =
        ((static_cast<int>(k) + j - 1) % vascular::beat_frames + vascular::beat_frames) % vascular::beat_frames;
    p += w[j] *
         c.shape->vertex(v, wall_m, {static_cast<double>(f) / vascular::beat_frames, moment.breath, moment.aside_P});
  }
  return p;
}

}  // namespace ostium::app
