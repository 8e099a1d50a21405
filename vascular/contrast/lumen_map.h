#pragma once
/// For each vertex of the lumen's surface, the source of its contrast, radius and centre.
#include <Eigen/Core>
#include <span>
#include <vector>

#include "vascular/contrast/contrast.h"

namespace ostium::vascular {

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

  /// Centre of a coronary or aortic cell at a cardiac phase and depth of breath.
  Eigen::Vector3d centre(std::size_t cell, double phase, double breath) const {
    return coronary.position(cell, phase) + breath * coronary_breath[cell];
  }
  Eigen::Vector3d aorta_centre(std::size_t cell, double phase, double breath) const {
    return aorta.position(cell, phase) + breath * aorta_breath[cell];
  }
};
LumenMap make_lumen_map(const Patient& patient, const FlowModel& flow);

}  // namespace ostium::vascular
