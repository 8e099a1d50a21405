#pragma once
/// The objects in the beam: closed surfaces with one tissue each, iodine in some of them, instruments as lines. Frame P
/// of the patient (c_arm.h), metres. This is fluoro's only input from an anatomy.
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fluoro/matter/material.h"

namespace ostium::fluoro {

using Triangles = Eigen::Matrix3Xi;

/// A body's material as a mixture of two attenuators (basis materials): soft tissue (ICRP) and cortical bone (ICRP),
/// each as a volume fraction at its own density. Away from K-edges two suffice for every tissue (Alvarez and Macovski
/// 1976, Phys Med Biol 21:733); the table of tissues is in tissue.h.
struct Tissue {
  float soft = 0, bone = 0;
};

/// Iodine dissolved in the contents of a body.
struct Contrast {
  Eigen::VectorXf iodine_kg_m3;  ///< at each vertex; 1 kg/m3 is 1 mg/mL; >= 0
  /// For each vertex, its point on the centreline: depths are measured from there, so that a concentration gradient
  /// along the vessel is not multiplied by the distance to the source.
  Eigen::Matrix3Xf p_PC;
  /// At each vertex, if concentration is integrated along the centreline: the integral of concentration times dp_PC
  /// from a common origin to there, kg/m2. Without it (empty), a ray along a vessel misses what the centreline advances
  /// by: a vessel at an angle a to the ray would be only sin^2 a as dark as it should be.
  Eigen::Matrix3Xf along_kg_m2 = {};
};

/// If the concentration nowhere exceeds this, iodine is not drawn: 3 cm of it absorb a two-thousandth of the beam, and
/// drawing a tree without contrast would take longer than lungs and heart.
inline constexpr float faintest_iodine_kg_m3 = 0.01f;
bool is_seen(const Contrast& contrast);

/// A closed surface: every edge belongs to two triangles that traverse it in opposite directions; corners anticlockwise
/// as seen from outside. The body displaces what surrounds it.
struct Body {
  std::string name;
  std::shared_ptr<const Triangles> triangles;
  Eigen::Matrix3Xf p_P;  ///< vertices
  Tissue tissue;         ///< inside
  Tissue within;         ///< surrounding tissue that it displaces; zero: air
  Contrast contrast;     ///< empty: none
  /// So many of its first triangles join vertices that rest: the same in all scenes with the same `fixed`. Their tissue
  /// is drawn once for a pose of the C-arm, as the sum over triangles can be split anywhere.
  int still = 0;
  std::shared_ptr<const std::vector<int>> corners = {};  ///< vertices of the other triangles; if `still` is above 0
};

/// Sorts the triangles, those first whose corners all rest, and sets `still` and `corners`.
void set_still(const std::function<bool(int vertex)>& rests, Body& body);

/// A section of an instrument, measured along it from its tip.
struct OpaqueSection {
  double from_tip_m = 0, to_tip_m = 0;
  Material material = Material::polymer;
  double outer_radius_m = 0, inner_radius_m = 0;  ///< of the ring filled with material; inner 0: a rod
  double filling = 1;                             ///< solid share of that ring: below 1 for coils and braids
};

/// A wire, catheter, marker or strut.
struct Shaft {
  std::string name;
  Eigen::Matrix3Xd p_P;                 ///< points along its axis, the tip first; at least 2
  std::vector<OpaqueSection> sections;  ///< may overlap: their attenuations add up
  double lumen_radius_m = 0;            ///< of the bore that contrast fills
  Eigen::VectorXd lumen_iodine_kg_m3;   ///< at each point; empty: none
  Eigen::Matrix3Xd v_P = {};            ///< velocities of the points, m/s; empty: it rests
};

struct Scene {
  /// Bodies that do not move relative to a resting C-arm. Shared, and never changed once given: their images are cached
  /// as long as the object is the same.
  std::shared_ptr<const std::vector<Body>> fixed;
  std::vector<Body> moving;
  std::vector<Shaft> shafts;
};

/// Throws std::invalid_argument naming the body and the problem: indices out of range, a surface that is not closed
/// (how many edges are open, and where the first is), a contrast array whose size differs from the vertices, or
/// triangles that rest without the corners of the others, or in a scene without `fixed`.
void check(const Body& body);
void check(const Scene& scene);

}  // namespace ostium::fluoro
