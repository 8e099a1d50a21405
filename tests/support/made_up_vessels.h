#pragma once
/// Made-up vessels, to see what they are taken for: hearts and aortas of made-up people, and what is neither.
#include <string>
#include <vector>

#include "vascular/geometry/implicit/tube.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::synthetic {

struct MadeUpVessels {
  std::vector<vascular::Tube> tubes;  ///< in whatever direction; parents before children
  bool heart = false, aorta = false;  ///< what should be recognised in them
};

const std::vector<std::string>& made_up_kinds();
/// Throws std::invalid_argument for another kind.
MadeUpVessels made_up_vessels(const std::string& kind, unsigned seed);
/// Their closed surface, coarser than that of a case.
vascular::Mesh mesh_of(const MadeUpVessels& vessels);

}  // namespace ostium::synthetic
