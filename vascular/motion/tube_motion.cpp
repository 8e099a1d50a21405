#include "vascular/motion/tube_motion.h"

#include <Eigen/Core>
#include <algorithm>

#include "core/math/alignment.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::vascular {

namespace {

constexpr double junction_m = 5e-3;   // length after its parent's wall over which a branch's own motion sets in
constexpr double root_end_m = 20e-3;  // stretch of the aorta that moves as a whole

/// The rotation nearest to `F` (Higham's iteration; F is near one).
Eigen::Matrix3d rotation_in(Eigen::Matrix3d F) {
  for (int i = 0; i < 5; ++i) F = 0.5 * (F + F.inverse().transpose());
  return F;
}

}  // namespace

bool of_heart(const Anatomy& anatomy, int tube) {
  const auto names = {"LAD", "LCx", "left sinus", "right sinus", "non-coronary sinus"};
  for (int t = tube; t >= 0 && !is_aorta(anatomy, t); t = anatomy.tubes[t].parent) {
    const std::string& name = anatomy.tubes[t].name;
    if (std::find(names.begin(), names.end(), name) != names.end()) return true;
    const NamedBranch* rca = find_branch(anatomy, "RCA");
    if (rca && rca->tube == t) return true;
  }
  return false;
}

bool is_aorta(const Anatomy& anatomy, int tube) { return anatomy.aorta && tube == 0; }

bool is_displaced(const std::vector<Eigen::Vector3d>& rest, const std::vector<std::vector<Eigen::Vector3d>>& frames,
                  int v) {
  constexpr double rounding_m = 1e-6;
  return std::any_of(frames.begin(), frames.end(), [&](const std::vector<Eigen::Vector3d>& frame) {
    return (frame[v] - rest[v]).squaredNorm() > rounding_m * rounding_m;
  });
}

/// How the first stretch of a branch is attached to its parent.
struct TubeMotion::Origin {
  int parent;
  double s_m, radius_m;
  Eigen::Vector3d p;
};

/// Motion of the tissue around each node to end-systole: displacement `shift` with gradient `slope`.
struct TubeMotion::Tissue {
  Eigen::Vector3d shift;
  Eigen::Matrix3d slope;
};

TubeMotion::Tissue TubeMotion::tissue(int tube, const TubeNode& node, const HeartMotion& motion) const {
  if (is_aorta(anatomy_, tube))
    return {(1 - smooth_step(root_end_m, anatomy_.ascending_m, node.s_m)) * motion.root_displacement(),
            Eigen::Matrix3d::Zero()};
  constexpr double h = 0.5e-3;
  Tissue result{motion.displacement(node.p), {}};
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(axis);
    result.slope.col(axis) = (motion.displacement(node.p + step) - motion.displacement(node.p - step)) / (2 * h);
  }
  return result;
}

void TubeMotion::set_frame(int t, int frame, const std::vector<Tissue>& tissues, const Origin* origin) {
  const std::vector<TubeNode>& nodes = anatomy_.tubes[t].nodes;
  const std::size_t n = nodes.size();
  const double c = contraction(static_cast<double>(frame) / beat_frames);
  Pose* poses = &poses_[t][static_cast<std::size_t>(frame) * n];
  std::vector<Eigen::Matrix3d> F(n);
  for (std::size_t i = 0; i < n; ++i) {
    poses[i].centre = nodes[i].p + c * tissues[i].shift;
    F[i] = Eigen::Matrix3d::Identity() + c * tissues[i].slope;
    if (!origin) continue;
    // At its origin a branch moves rigidly with its parent.
    const double wall = 1.2 * origin->radius_m, own = smooth_step(wall, wall + junction_m, nodes[i].s_m);
    if (own == 1) continue;
    const Pose pose = pose_at(origin->parent, origin->s_m, frame);
    const Eigen::Matrix3d turn = pose.turn.cast<double>();
    poses[i].centre = own * poses[i].centre + (1 - own) * (pose.centre + turn * (nodes[i].p - origin->p));
    F[i] = own * F[i] + (1 - own) * turn;
  }
  for (std::size_t i = 0; i < n; ++i) {
    // The tissue's rotation, then the smallest rotation that aligns the tangent with the moved centreline.
    const Eigen::Matrix3d turn = rotation_in(F[i]);
    const std::size_t a = i ? i - 1 : 0, b = std::min(i + 1, n - 1);
    const Eigen::Vector3d before = nodes[b].p - nodes[a].p, after = poses[b].centre - poses[a].centre;
    poses[i].turn = (core::rotation_between(turn * before, after).toRotationMatrix() * turn).cast<float>();
  }
}

/// The vertices that mainly belong to a tube, by position along it.
class TubeMotion::Around {
 public:
  Around(int tube, const std::vector<std::vector<TubeShare>>& shares) {
    for (std::size_t v = 0; v < shares.size(); ++v)
      for (const TubeShare& share : shares[v])
        if (share.tube == tube && share.weight > 0.5) at_.emplace_back(share.s_m, static_cast<int>(v));
    std::sort(at_.begin(), at_.end());
  }
  bool enough() const { return at_.size() >= least; }
  const std::vector<std::pair<double, int>>& all() const { return at_; }
  /// Vertices within `half_m` to either side, or farther if there are too few.
  std::vector<int> near(double s_m, double half_m) const {
    std::vector<int> found;
    for (double reach = half_m; found.size() < least; reach *= 2) {
      found.clear();
      const auto from = std::lower_bound(at_.begin(), at_.end(), std::pair(s_m - reach, -1));
      for (auto it = from; it != at_.end() && it->first <= s_m + reach; ++it) found.push_back(it->second);
    }
    return found;
  }

 private:
  static constexpr std::size_t least = 12;
  std::vector<std::pair<double, int>> at_;
};

TubeMotion::TubeMotion(const Anatomy& anatomy, const std::vector<Eigen::Vector3d>& rest,
                       const std::vector<std::vector<TubeShare>>& shares,
                       const std::vector<std::vector<Eigen::Vector3d>>& frames)
    : anatomy_(anatomy) {
  for (int t = 0; t < static_cast<int>(anatomy.tubes.size()); ++t) {
    const Tube& tube = anatomy.tubes[t];
    const Around around(t, shares);
    breathes_.push_back(is_aorta(anatomy, t) || of_heart(anatomy, t));
    poses_.emplace_back();
    // A tube with hardly a wall of its own lies in its parent and moves with it.
    const bool with_parent = !around.enough() && tube.parent >= 0 && moves_[tube.parent];
    moves_.push_back(with_parent ||
                     (around.enough() && std::any_of(around.all().begin(), around.all().end(), [&](const auto& at) {
                        return is_displaced(rest, frames, at.second);
                      })));
    if (!moves_.back()) continue;
    const std::size_t n = tube.nodes.size();
    poses_.back().resize(beat_frames * n);
    for (std::size_t i = 0; i < n; ++i) {
      const TubeNode& node = tube.nodes[i];
      const std::vector<int> near = with_parent ? std::vector<int>{} : around.near(node.s_m, 0.5 * node.radius_m);
      for (int f = 0; f < beat_frames; ++f) {
        Pose& pose = poses_.back()[static_cast<std::size_t>(f) * n + i];
        if (with_parent) {
          const double s = nearest_s(anatomy.tubes[tube.parent], node.p);
          const Pose origin = pose_at(tube.parent, s, f);
          pose.turn = origin.turn;
          pose.centre = origin.centre + origin.turn.cast<double>() * (node.p - anatomy.tubes[tube.parent].at(s).p);
          continue;
        }
        Eigen::Vector3d from = Eigen::Vector3d::Zero(), to = from;
        for (int v : near) from += rest[v] / double(near.size()), to += frames[f][v] / double(near.size());
        Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
        for (int v : near) spread += (frames[f][v] - to) * (rest[v] - from).transpose();
        const Eigen::Matrix3d turn = core::nearest_rotation(spread);
        pose = {turn.cast<float>(), to + turn * (node.p - from)};
      }
    }
  }
}

TubeMotion::TubeMotion(const Anatomy& anatomy, const HeartMotion& motion) : anatomy_(anatomy) {
  for (int t = 0; t < static_cast<int>(anatomy.tubes.size()); ++t) {
    const Tube& tube = anatomy.tubes[t];
    moves_.push_back(is_aorta(anatomy, t) || of_heart(anatomy, t));
    poses_.emplace_back();
    if (!moves_.back()) continue;
    std::vector<Tissue> tissues;
    for (const TubeNode& node : tube.nodes) tissues.push_back(tissue(t, node, motion));
    poses_.back().resize(beat_frames * tube.nodes.size());
    Origin origin{};
    const bool branch = tube.parent >= 0;
    if (branch) {
      const double s = nearest_s(anatomy.tubes[tube.parent], tube.nodes.front().p);
      const TubeNode at = anatomy.tubes[tube.parent].at(s);
      origin = {tube.parent, s, at.radius_m, at.p};
    }
    for (int f = 0; f < beat_frames; ++f) set_frame(t, f, tissues, branch && moves_[tube.parent] ? &origin : nullptr);
  }
  breathes_ = moves_;
}

TubeMotion::Pose TubeMotion::pose_at(int tube, double s_m, int frame) const {
  const std::vector<TubeNode>& nodes = anatomy_.tubes[tube].nodes;
  const auto above = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, s_m,
                                      [](double s, const TubeNode& node) { return s < node.s_m; });
  const std::size_t j = static_cast<std::size_t>(above - nodes.begin()), i = j - 1;
  const double w = std::clamp((s_m - nodes[i].s_m) / (nodes[j].s_m - nodes[i].s_m), 0.0, 1.0);
  const Pose* poses = &poses_[tube][static_cast<std::size_t>(frame) * nodes.size()];
  return {static_cast<float>(1 - w) * poses[i].turn + static_cast<float>(w) * poses[j].turn,
          (1 - w) * poses[i].centre + w * poses[j].centre};
}

Eigen::Vector3d TubeMotion::centre(int tube, double s_m, int frame) const {
  return moves_[tube] ? pose_at(tube, s_m, frame).centre : anatomy_.tubes[tube].at(s_m).p;
}

Eigen::Vector3d TubeMotion::carried(const Eigen::Vector3d& p, const std::vector<TubeShare>& shares, int frame) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const TubeShare& share : shares) {
    if (!moves_[share.tube]) {
      sum += share.weight * p;
      continue;
    }
    const Pose pose = pose_at(share.tube, share.s_m, frame);
    sum += share.weight * (pose.centre + pose.turn.cast<double>() * (p - anatomy_.tubes[share.tube].at(share.s_m).p));
  }
  return sum;
}

double TubeMotion::breath_share(int tube, double s_m) const {
  if (!breathes_[tube]) return 0;
  return is_aorta(anatomy_, tube) ? 1 - smooth_step(root_end_m, anatomy_.ascending_m, s_m) : 1;
}

}  // namespace ostium::vascular
