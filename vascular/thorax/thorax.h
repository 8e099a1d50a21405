#pragma once
/// What else an X-ray meets: trunk, lungs, heart, great vessels, spine, ribs, sternum, clavicles. Made to be looked
/// through, not to be operated on: simple shapes of published or usual size [from memory: the skeleton's dimensions].
///
/// Each body is a closed surface that takes the place of what is around it, so that path lengths add up: what a ray
/// meets is the sum over bodies of length times (attenuation of `tissue` less that of `within`).
#include <string>

#include "vascular/anatomy/anatomy.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

enum class BodyTissue { air, soft_tissue, lung, blood, cortical_bone, spongy_bone, loose_bone };

struct XrayBody {
  std::string name;
  BodyTissue tissue = BodyTissue::soft_tissue;  ///< inside
  BodyTissue within = BodyTissue::air;          ///< what it takes the place of
  Mesh mesh;                                    ///< at end-diastole, breathed out
  std::vector<Eigen::Vector3d> beat;            ///< displacement of each vertex at end-systole; empty: it is still
  std::vector<Eigen::Vector3d> breath;          ///< and at the top of a breath; empty: it is still
};

/// Vertebrae, ribs and shoulders have two layers: cortical bone within soft tissue, spongy or loose bone within that.
/// The sternum is loose throughout: its cortex is thinner than these meshes would show.
std::vector<XrayBody> make_thorax(const Anatomy& anatomy);

/// Vertices at a phase of the heart (contraction, heart_cycle.h) and a depth of breath.
Mesh at(const XrayBody& body, double contraction, double breath_depth);

}  // namespace ostium::vascular
