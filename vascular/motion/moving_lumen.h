#pragma once
/// The lumen of an anatomy as a surface with cardiac and breathing motion.
#include "vascular/anatomy/lesion.h"
#include "vascular/geometry/implicit/contour.h"
#include "vascular/motion/periodic_points.h"
#include "vascular/motion/tube_motion.h"

namespace ostium::vascular {

/// At lesions, both the healthy and the diseased wall are stored; a wall opened by a balloon lies in between.
struct MovingLumen {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::vector<TubeShare>> shares;  ///< per vertex; moving vertices come first
  std::size_t moving = 0;                      ///< vertices [0, moving) have cardiac motion
  PeriodicPoints beat;                         ///< their healthy wall over a cycle
  std::vector<Eigen::Vector3d> still;          ///< the other vertices
  std::vector<Eigen::Vector3d> breath;         ///< per vertex: displacement at full inspiration
  std::vector<int> narrowed;                   ///< vertices moved by lesions, ascending; all have cardiac motion
  PeriodicPoints diseased_beat;                ///< their diseased wall over a cycle

  std::size_t vertices() const { return breath.size(); }
  /// `depth`: breath_depth, 0 without breathing.
  Eigen::Vector3d healthy(std::size_t vertex, double phase, double depth) const {
    return healthy(vertex, vertex < moving ? beat.moment(phase) : PeriodicPoints::Moment{}, depth);
  }
  /// For many vertices at one moment, which is that of `beat`.
  Eigen::Vector3d healthy(std::size_t vertex, const PeriodicPoints::Moment& moment, double depth) const;
  /// Position of vertex narrowed[i] on the diseased wall.
  Eigen::Vector3d diseased(std::size_t i, double phase, double depth) const;
  /// The whole surface; `opened`: 0 with lesions as they are, 1 healthy.
  Mesh at(double phase, double depth, double opened = 0) const;
};

/// `smoothing`: number of times that each vertex's path is averaged with its neighbours', for surfaces with abrupt
/// changes of shares. `own`: the healthy wall's vertices in each frame (own[f][v], beat_frames of them, the first equal
/// to `contour`), from which `tubes` was made; empty: the tubes move the wall. Throws std::invalid_argument if a lesion
/// lies where there is no cardiac motion.
MovingLumen make_moving_lumen(const Anatomy& anatomy, const std::vector<Lesion>& lesions, const HeartMotion& motion,
                              const TubeMotion& tubes, Contour contour, int smoothing = 0,
                              const std::vector<std::vector<Eigen::Vector3d>>& own = {});

}  // namespace ostium::vascular
