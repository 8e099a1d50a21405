#pragma once
/// What stands in the beam: closed surfaces with a tissue each, iodine in some of them, instruments as lines.
/// Frame P of the patient (c_arm.h), metres. Whoever has an anatomy fills this; fluoro asks for nothing else.
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "fluoro/matter/material.h"

namespace ostium::fluoro {

using Triangles = Eigen::Matrix3Xi;

/// What a body is made of, as a mixture of two attenuators (basis materials): soft tissue (ICRP) and cortical bone
/// (ICRP), each as volume at its own density. Away from K-edges two are enough for every tissue (Alvarez and Macovski
/// 1976, Phys Med Biol 21:733); the table of tissues is in tissue.cpp.
struct Tissue {
  float soft = 0, bone = 0;
};

/// Iodine dissolved in what fills a body.
struct Contrast {
  Eigen::VectorXf iodine_kg_m3;  ///< at each vertex; 1 kg/m3 is 1 mg/mL; >= 0
  /// For each vertex the point of the centreline that it belongs to: depths are counted from there, so that a gradient
  /// of concentration along the vessel is not multiplied by the distance to the source.
  Eigen::Matrix3Xf p_PC;
  /// At each vertex, where concentration is counted along the centreline: the integral of concentration times dp_PC
  /// from a common origin to there, kg/m2. Without it (empty) a ray that runs along a vessel misses what its centreline
  /// moved by: a vessel seen at an angle a to its axis would be sin^2 a as dark as it is.
  Eigen::Matrix3Xf along_kg_m2 = {};
};

/// Where there is no more than this anywhere, nothing is drawn of it: 3 cm of it take a two-thousandth of the beam, and
/// a tree that nothing was injected into takes longer to draw than lungs and heart.
inline constexpr float faintest_iodine_kg_m3 = 0.01f;
bool is_seen(const Contrast& contrast);

/// A closed surface: every edge belongs to two triangles that run along it in opposite directions; corners
/// anticlockwise as seen from outside. What it holds takes the place of what is around it.
struct Body {
  std::string name;
  std::shared_ptr<const Triangles> triangles;
  Eigen::Matrix3Xf p_P;  ///< vertices
  Tissue tissue;         ///< inside
  Tissue within;         ///< what it takes the place of; zero: air
  Contrast contrast;     ///< empty: none
};

/// A stretch of an instrument, measured along it from its tip.
struct OpaqueSection {
  double from_tip_m = 0, to_tip_m = 0;
  Material material = Material::polymer;
  double outer_radius_m = 0, inner_radius_m = 0;  ///< of the ring that the material fills; inner 0: a rod
  double filling = 1;                             ///< share of that ring which is solid: below 1 for coils and braids
};

/// A wire, catheter, marker or strut.
struct Shaft {
  std::string name;
  Eigen::Matrix3Xd p_P;                 ///< points along its axis, the tip first; at least 2
  std::vector<OpaqueSection> sections;  ///< may overlap: they add up
  double lumen_radius_m = 0;            ///< of the bore that contrast fills
  Eigen::VectorXd lumen_iodine_kg_m3;   ///< at each point; empty: none
};

struct Scene {
  /// What stays where it is while the C-arm stands still. Shared, and never changed once given: its images are kept for
  /// as long as it is the same object.
  std::shared_ptr<const std::vector<Body>> fixed;
  std::vector<Body> moving;
  std::vector<Shaft> shafts;
};

/// Throws std::invalid_argument naming the body and what is wrong with it: indices out of range, a surface that is not
/// closed (how many edges are open, and where the first is), contrast of another size than the vertices.
void check(const Body& body);
void check(const Scene& scene);

}  // namespace ostium::fluoro
