#pragma once
/// For each vertex of the lumen's surface, the source of its contrast, radius and centre.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "vascular/contrast/contrast.h"

namespace ostium::vascular {

/// How the heart's vessels lie: by heartbeat and breath, and pushed aside by instruments (motion/artery_bed.h).
struct LumenMoment {
  double phase = 0, breath = 0;                   ///< cardiac phase; depth of breath
  std::span<const Eigen::Vector3d> aside_P = {};  ///< (#cells) of the coronary arteries, m; empty: nothing is

  Eigen::Vector3d aside(std::size_t cell) const {
    return aside_P.empty() ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : aside_P[cell];
  }
};

/// A position between two neighbouring cells of the coronaries or the aorta, or a sinus. `none`: a vessel without
/// contrast that leaves the aorta at `below`.
struct VertexSource {
  enum Part : unsigned char { none, coronary, aorta, left_sinus, right_sinus } part = none;
  int below = 0, above = 0;  ///< cells
  float share = 0;           ///< of `above`
};

struct LumenMap {
  /// (#vertices of MovingLumen) The two main sources of a vertex, and the weight of the second.
  struct Vertex {
    VertexSource first, second;
    float second_share = 0;
  };
  std::vector<Vertex> sources;
  PeriodicPoints coronary, aorta;                              ///< centres of the cells
  std::vector<Eigen::Vector3d> coronary_breath, aorta_breath;  ///< their displacements at full inspiration, m
  /// (#cells) Start of a branch's depth integral, so that nothing is counted twice: the parent's centre as a cell and
  /// weight.
  std::vector<std::pair<int, float>> parent_centre;

  /// Centre of a coronary or aortic cell.
  Eigen::Vector3d centre(std::size_t cell, const LumenMoment& at) const {
    return coronary.position(cell, at.phase) + at.breath * coronary_breath[cell] + at.aside(cell);
  }
  Eigen::Vector3d aorta_centre(std::size_t cell, const LumenMoment& at) const {
    return aorta.position(cell, at.phase) + at.breath * aorta_breath[cell];
  }
};
LumenMap make_lumen_map(const Patient& patient, const FlowModel& flow);

}  // namespace ostium::vascular
