#pragma once
/// The closed pieces of a lumen, each with its centreline-sphere tree.
#include <functional>
#include <string>
#include <vector>

#include "vascular/anatomy/lumen/courses.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

using Progress = std::function<void(const std::string&)>;

struct LumenPart {
  Mesh mesh;
  SphereTree tree;
  std::vector<Course> courses;
  Eigen::Vector3d root;  ///< where its tree begins
  double widest_m = 0;   ///< radius
  struct Role {
    Eigen::Vector3d end;
    std::string name;
  };
  std::vector<Role> roles;  ///< identified ends, most important first
};

/// Throws MeshError if the longest way through a lumen is not several times as long as its widest place, a diameter.
void require_vessel(double longest_m, double widest_m);

/// Widest first. Throws MeshError if none contains a vessel, or all are too small for one.
std::vector<LumenPart> lumen_parts(const Mesh& lumen, const Progress& say);

}  // namespace ostium::vascular
