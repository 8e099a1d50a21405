#pragma once
/// The lumen of an anatomy as a surface that beats and breathes, and its centrelines with it.
#include "vascular/anatomy/lesion.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/motion/periodic_points.h"
#include "vascular/motion/tube_motion.h"

namespace ostium::vascular {

/// Where lesions are, both walls are known, and a wall that a balloon opens lies between them.
struct MovingLumen {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::vector<TubeShare>> shares;  ///< of each vertex: the moving ones first
  std::size_t moving = 0;                      ///< vertices [0, moving) beat
  PeriodicPoints beat;                         ///< of these, the healthy wall
  std::vector<Eigen::Vector3d> still;          ///< of the others
  std::vector<Eigen::Vector3d> breath;         ///< displacement of each vertex at the top of a breath
  std::vector<int> narrowed;                   ///< vertices that lesions move, ascending; all of them beat
  PeriodicPoints diseased_beat;                ///< of these, the diseased wall

  std::size_t vertices() const { return breath.size(); }
  /// `depth`: breath_depth, 0 without breathing.
  Eigen::Vector3d healthy(std::size_t vertex, double phase, double depth) const;
  /// narrowed[i]'s place on the diseased wall.
  Eigen::Vector3d diseased(std::size_t i, double phase, double depth) const;
  /// The whole surface; lesions opened by so much (0: as they are, 1: healthy).
  Mesh at(double phase, double depth, double opened = 0) const;
};

/// `smoothing`: so many times each vertex's path becomes the mean of its own and its neighbours'; for surfaces whose
/// shares change abruptly. `own`: the healthy wall's vertices in each frame (own[f][v], beat_frames of them, the first
/// those of `contour`), and `tubes` is made of them; empty: the tubes carry the wall. Throws std::invalid_argument if a
/// lesion lies where nothing beats.
MovingLumen make_moving_lumen(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const HeartMotion& motion,
                              const TubeMotion& tubes, Contour contour, int smoothing = 0,
                              const std::vector<std::vector<Eigen::Vector3d>>& own = {});

}  // namespace ostium::vascular
