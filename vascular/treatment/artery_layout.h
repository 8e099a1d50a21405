#pragma once
/// How the coronary arteries lie to each other, for arteries that give way (artery_bed.h): whose wall goes with whose,
/// and how much room there is between them.
///
/// A displacement of a wall leaves it a wall, neither folded nor through itself, if it differs by less between any two
/// of its points than they lie apart. An edge's two vertices follow cells with weights of their own: what the edge can
/// bear is shared out among the cells that they differ in. Most edges lie along an artery; those across the ridge
/// between two arteries that part hold these together, and where they have parted, the room between the walls does.
#include <Eigen/Core>
#include <vector>

#include "core/wall/surface.h"
#include "vascular/contrast/lumen_map.h"
#include "vascular/flow/flow_tree.h"

namespace ostium::vascular {

/// Two cells, a < b, that should not go apart or together by more than a part of this.
struct ArteryTie {
  int a = 0, b = 0;
  double room_m = 0;
};

struct ArteryLayout {
  std::vector<int> upstream;       ///< (#cells) that a cell hangs on as a beam; a side branch on the one it lies beside
  std::vector<double> from_m;      ///< (#cells) distance from it
  std::vector<ArteryTie> ties;     ///< by b, then a
  std::vector<double> anchored_m;  ///< (#cells) room to what never moves, as a tie's
};

/// Of straight tubes.
ArteryLayout layout_of(const FlowTree& tree);
/// Of a patient's: `wall` in all frames of the beat.
ArteryLayout layout_of(const FlowTree& tree, const LumenMap& map, const core::SurfaceDescription& wall);

}  // namespace ostium::vascular
