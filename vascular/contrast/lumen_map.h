#pragma once
/// What each vertex of the lumen's surface belongs to: where its contrast, its radius and its centre come from.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "vascular/contrast/contrast.h"

namespace ostium::vascular {

/// Between two neighbouring cells, of the coronaries or of the aorta; or a sinus. `none`: a vessel without contrast,
/// that leaves the aorta at `below`.
struct VertexSource {
  enum Part : unsigned char { none, coronary, aorta, left_sinus, right_sinus } part = none;
  int below = 0, above = 0;  ///< cells
  float share = 0;           ///< of `above`
};

struct LumenMap {
  /// (#vertices of MovingLumen) The two parts that decide most where a vertex is, and the second's share.
  struct Vertex {
    VertexSource first, second;
    float second_share = 0;
  };
  std::vector<Vertex> sources;
  PeriodicPoints coronary, aorta;                              ///< centres of the cells
  std::vector<Eigen::Vector3d> coronary_breath, aorta_breath;  ///< their displacements at the top of a breath, m
  /// (#cells) A branch's depths are counted from its parent's centre where it begins, so that none is counted twice:
  /// that cell, and its share.
  std::vector<std::pair<int, float>> parent_centre;

  /// Centre of a coronary cell, or one of the aorta, at a phase and depth of breath.
  Eigen::Vector3d centre(std::size_t cell, double phase, double breath) const {
    return coronary.position(cell, phase) + breath * coronary_breath[cell];
  }
  Eigen::Vector3d aorta_centre(std::size_t cell, double phase, double breath) const {
    return aorta.position(cell, phase) + breath * aorta_breath[cell];
  }
};
LumenMap make_lumen_map(const Patient& patient, const FlowModel& flow);

}  // namespace ostium::vascular
