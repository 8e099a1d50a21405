#pragma once
/// The surroundings that an X-ray passes: trunk, lungs with their vessels, heart, great vessels, fat, gas, spine,
/// ribs, sternum, clavicles. For imaging only: simple shapes of published or typical size [from memory: the skeleton's
/// dimensions]. What anatomy does not say (build, density of the lungs, gas, fat) is drawn by chance from a seed that
/// the heart's landmarks make: one person, one chest.
///
/// Each body is a closed surface that replaces its surroundings, so that path lengths add up: the attenuation along a
/// ray is the sum over bodies of length times (attenuation of `tissue` minus that of `within`).
#include <string>

#include "vascular/anatomy/anatomy.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

enum class BodyTissue { air, soft_tissue, lung, blood, muscle, fat, cortical_bone, spongy_bone, loose_bone };

struct XrayBody {
  std::string name;
  BodyTissue tissue = BodyTissue::soft_tissue;  ///< inside
  BodyTissue within = BodyTissue::air;          ///< the tissue it replaces
  Mesh mesh = {};                               ///< at end-diastole, breathed out
  std::vector<Eigen::Vector3d> beat = {};       ///< per vertex: displacement at end-systole; empty: none
  std::vector<Eigen::Vector3d> breath = {};     ///< per vertex: displacement at full inspiration; empty: none
  double density = 1;                           ///< of `tissue`, relative to its usual
};

/// Vertebrae, ribs and shoulders have two layers: cortical bone in soft tissue, and inside that spongy or loose bone
/// (the latter half as dense). The sternum is loose bone throughout: its cortex is thinner than these meshes resolve.
std::vector<XrayBody> make_thorax(const Anatomy& anatomy);

/// Vertices at a contraction (heart_cycle.h) and a depth of breath.
Mesh at(const XrayBody& body, double contraction, double breath_depth);

}  // namespace ostium::vascular
