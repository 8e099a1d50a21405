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

OpenedWall::OpenedWall(const Vessel& vessel, core::Surface& surface)
    : coronaries_(*vessel.coronaries), editor_(vessel.wall, surface), now_m_(untreated(vessel.coronaries->tree())) {
  changed_.reserve(now_m_.size());
}

void OpenedWall::set(const std::vector<double>& wall_m) {
  if (wall_m == now_m_) return;
  changed_.clear();
  for (std::size_t c = 0; c < now_m_.size(); ++c)
    if (wall_m[c] != now_m_[c]) changed_.push_back(static_cast<int>(c));
  now_m_ = wall_m;
  for (int c : changed_)
    for (int k = coronaries_.first_vertex[c]; k < coronaries_.first_vertex[c + 1]; ++k) {
      const int v = coronaries_.vertices[k];
      for (int f = 0; f < vascular::beat_frames; ++f)
        editor_.place(v, f,
                      coronaries_.shape->vertex(static_cast<std::size_t>(v), now_m_,
                                                static_cast<double>(f) / vascular::beat_frames, 0));
    }
  editor_.refit();
}

Eigen::Vector3d wall_vertex(const Vessel& vessel, const std::vector<double>& wall_m, int vertex, double frame,
                            double breath) {
  if (!vessel.coronaries || static_cast<std::size_t>(vertex) >= vessel.coronaries->map.sources.size())
    return vertex_at(vessel.wall, vertex, frame, breath);  // a mesh or the ventricle
  const Coronaries& c = *vessel.coronaries;
  const vascular::VertexSource& from = c.map.sources[static_cast<std::size_t>(vertex)].first;
  const auto untouched = [&](int cell) { return wall_m[cell] == c.tree().cells[cell].diseased_m; };
  if (from.part != vascular::VertexSource::coronary || (untouched(from.below) && untouched(from.above)))
    return vertex_at(vessel.wall, vertex, frame, breath);
  const double k = std::floor(frame);
  const std::array<double, 4> w = core::frame_weights(frame - k);
  Eigen::Vector3d p = Eigen::Vector3d::Zero();
  for (int j = 0; j < 4; ++j) {
    const int f =
        ((static_cast<int>(k) + j - 1) % vascular::beat_frames + vascular::beat_frames) % vascular::beat_frames;
    p += w[j] * c.shape->vertex(static_cast<std::size_t>(vertex), wall_m,
                                static_cast<double>(f) / vascular::beat_frames, breath);
  }
  return p;
}

}  // namespace ostium::app
