#include "vascular/treatment/stent_shape.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "core/math/alignment.h"

namespace ostium::vascular {

namespace {

/// How much nearer to its middle than a round ring of its length a ring lies at an angle: an ellipse, narrow across.
double flat_m(const StentState& s, int ring, double angle) {
  const double r = s.radius_m[ring], c = std::cos(angle), sn = std::sin(angle) / s.narrow[ring];
  const double wide = r * 2 / (1 + s.narrow[ring]);
  return std::max(0.0, r - wide / std::sqrt(c * c + sn * sn));
}

}  // namespace

double gap_of(const StentModel& m, const StentState& s, const VesselPath& path, const PlaqueState& wall, int point) {
  const int around = 2 * m.crowns, ring = point / around;
  const double at = place_of_m(s, point), angle = angle_of(m, s, point);
  const double room = path.value(wall.radius_m, at) - s.radius_m[ring] - m.strut_m;
  if (room <= 0) return 0;
  // A wall that is hardly longer than the ring bulges only as far as an arc on a chord.
  const double flat = s.narrow[ring] < 1 ? std::min(flat_m(s, ring, angle), std::sqrt(room * s.radius_m[ring])) : 0;
  return room * (1 - std::cos(angle)) + flat;
}

std::vector<std::pair<int, int>> struts_of(const StentModel& m) {
  std::vector<std::pair<int, int>> out;
  const int around = 2 * m.crowns, every = m.crowns / m.links;
  for (int k = 0; k < m.rings; ++k) {
    for (int j = 0; j < around; ++j) out.emplace_back(k * around + j, k * around + (j + 1) % around);
    if (k + 1 == m.rings) break;
    for (int crown = k % 2; crown < m.crowns; crown += every) {
      const int j = (2 * crown + 1) % around;
      out.emplace_back(k * around + j, (k + 1) * around + j);
    }
  }
  return out;
}

PathFrames::PathFrames(const LumenMap& map, const VesselPath& path, double least_m, const LumenMoment& moment)
    : map_(map), path_(path), moment_(moment), side_(Eigen::Vector3d::UnitX()) {
  along_ = (centre(2) - centre(0)).normalized();
  if (std::fabs(along_.x()) > 0.9) side_ = Eigen::Vector3d::UnitY();
  side_ = (side_ - side_.dot(along_) * along_).normalized();
  carry(first_, path.at(least_m).index, along_, side_);
}

Eigen::Vector3d PathFrames::centre(int i) const {
  const int last = static_cast<int>(path_.cells.size()) - 1;
  return map_.centre(static_cast<std::size_t>(path_.cells[std::clamp(i, 0, last)]), moment_);
}

void PathFrames::carry(int& index, int to, Eigen::Vector3d& along, Eigen::Vector3d& side) const {
  while (index < to) {
    ++index;
    const Eigen::Vector3d next = (centre(index + 2) - centre(index - 1)).normalized();
    side = core::rotation_between(along, next) * side;
    along = next;
  }
}

PathFrame PathFrames::at(double s_m) const {
  const VesselPath::Place place = path_.at(s_m);
  int index = first_;
  Eigen::Vector3d along = along_, side = side_;
  carry(index, place.index, along, side);
  PathFrame f;
  f.centre = (1 - place.share) * centre(place.index) + place.share * centre(place.index + 1);
  f.along = along, f.side = (side - side.dot(along) * along).normalized(), f.up = f.along.cross(f.side);
  return f;
}

PathFrame PathFrames::go_to(double s_m) {
  carry(first_, path_.at(s_m).index, along_, side_);
  return at(s_m);
}

PathPoint point_at(const LumenMap& map, const VesselPath& path, double s_m, const LumenMoment& moment) {
  const int last = static_cast<int>(path.cells.size()) - 1;
  const auto centre = [&](int i) {
    return map.centre(static_cast<std::size_t>(path.cells[static_cast<std::size_t>(std::clamp(i, 0, last))]), moment);
  };
  const VesselPath::Place place = path.at(s_m);
  const int i = place.index;
  return {(1 - place.share) * centre(i) + place.share * centre(i + 1), (centre(i + 2) - centre(i - 1)).normalized()};
}

PathFrame frame_at(const LumenMap& map, const VesselPath& path, double s_m, const LumenMoment& moment) {
  return PathFrames(map, path, s_m, moment).at(s_m);
}

std::vector<Eigen::Vector3d> points_on_path(const StentModel& m, const StentState& s, const LumenMap& map,
                                            const VesselPath& path, const LumenMoment& moment,
                                            const std::function<Eigen::Vector2d(double)>& aside_m) {
  std::vector<Eigen::Vector3d> out;
  double least_m = place_of_m(s, 0);
  for (int i = 1; i < m.points(); ++i) least_m = std::min(least_m, place_of_m(s, i));
  const PathFrames frames(map, path, least_m, moment);
  for (int i = 0; i < m.points(); ++i) {
    out.push_back(point_on_path(m, s, frames, i));
    if (!aside_m) continue;
    const double at_m = place_of_m(s, i);
    const PathFrame f = frames.at(at_m);
    out.back() += aside_m(at_m).x() * f.side + aside_m(at_m).y() * f.up;
  }
  return out;
}

Eigen::Vector3d point_on_path(const StentModel& m, const StentState& s, const PathFrames& frames, int i) {
  const int around = 2 * m.crowns;
  const PathFrame f = frames.at(place_of_m(s, i));
  const double a = angle_of(m, s, i), r = s.radius_m[i / around] + m.strut_m / 2;
  return f.centre + r * (std::cos(a) * f.side + std::sin(a) * f.up);
}

bool is_tied(const StentState& s) {
  return std::all_of(s.ties.begin(), s.ties.end(), [](const StentTie& tie) { return tie.triangle >= 0; });
}

std::vector<Eigen::Vector3d> points_on_wall(const StentModel& m, const StentState& s, const Patient& patient,
                                            const WallShape& shape, std::span<const double> radius_m,
                                            const LumenMoment& moment) {
  std::vector<Eigen::Vector3d> out;
  for (int i = 0; i < m.points(); ++i) {
    const StentTie& tie = s.ties[i];
    const auto& triangle = patient.lumen.triangles[static_cast<std::size_t>(tie.triangle)];
    const auto corner = [&](int k) { return shape.vertex(static_cast<std::size_t>(triangle[k]), radius_m, moment); };
    const Eigen::Vector3d a = corner(0), u = corner(1) - a, v = corner(2) - a;
    out.push_back(a + tie.u * u + tie.v * v - tie.depth_m * u.cross(v).normalized());
  }
  return out;
}

std::vector<double> gaps(const StentModel& m, const StentState& s, const VesselPath& path, const PlaqueState& wall) {
  std::vector<double> out;
  for (int i = 0; i < m.points(); ++i) out.push_back(gap_of(m, s, path, wall, i));
  return out;
}

Apposition apposition(const StentModel& m, const StentState& s, const VesselPath& path, const PlaqueState& wall) {
  Apposition out{.share = 0};
  for (int i = 0; i < m.points(); ++i) {
    const double gap = gap_of(m, s, path, wall, i);
    out.share += gap <= apposed_m ? 1.0 / m.points() : 0;
    out.worst_m = std::max(out.worst_m, gap);
  }
  return out;
}

}  // namespace ostium::vascular
