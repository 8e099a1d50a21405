#pragma once
/// Cardiac and breathing motion of an anatomy's tubes.
#include "vascular/anatomy/anatomy.h"
#include "vascular/motion/heart_motion.h"
#include "vascular/motion/periodic_points.h"

namespace ostium::vascular {

/// Motion of the tubes' local frames: cross-sections keep their shape and are carried and turned with the centreline.
class TubeMotion {
 public:
  TubeMotion(const Anatomy& anatomy, const HeartMotion& motion);
  /// From a surface that was given in every frame of the cycle (frames[f][v], beat_frames of them, `rest` the first):
  /// each tube moves by the rotation and shift that fit the surface around it best (Kabsch 1976). `shares`: of its
  /// vertices.
  TubeMotion(const Anatomy& anatomy, const std::vector<Eigen::Vector3d>& rest,
             const std::vector<std::vector<TubeShare>>& shares,
             const std::vector<std::vector<Eigen::Vector3d>>& frames);

  /// Whether any part of it moves.
  bool moves(int tube) const { return moves_[static_cast<std::size_t>(tube)]; }
  /// Position, in a frame of the cycle, of the lumen point that is at `p` at end-diastole.
  Eigen::Vector3d carried(const Eigen::Vector3d& p, const std::vector<TubeShare>& shares, int frame) const;
  /// Position of a point of a tube's centreline.
  Eigen::Vector3d centre(int tube, double s_m, int frame) const;
  /// Share of breathing motion at a point of a tube: 1 at the heart, 0 in the arch.
  double breath_share(int tube, double s_m) const;

 private:
  struct Pose {
    Eigen::Matrix3f turn;
    Eigen::Vector3d centre;
  };
  const Anatomy& anatomy_;
  std::vector<bool> moves_, breathes_;
  std::vector<std::vector<Pose>> poses_;  ///< per tube: frame by node
  class Around;
  struct Tissue;
  struct Origin;
  Tissue tissue(int tube, const TubeNode& node, const HeartMotion& motion) const;
  void set_frame(int tube, int frame, const std::vector<Tissue>& tissues, const Origin* origin);
  Pose pose_at(int tube, double s_m, int frame) const;
};

bool is_aorta(const Anatomy& anatomy, int tube);
/// Whether it is a coronary artery or a sinus, which the heart carries along.
bool of_heart(const Anatomy& anatomy, int tube);

/// Whether a vertex of a surface that was given frame by frame ever moves by more than file rounding.
bool is_displaced(const std::vector<Eigen::Vector3d>& rest, const std::vector<std::vector<Eigen::Vector3d>>& frames,
                  int v);

}  // namespace ostium::vascular
