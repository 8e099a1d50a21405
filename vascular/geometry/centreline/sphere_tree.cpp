#include "vascular/geometry/centreline/sphere_tree.h"

namespace ostium::vascular {

std::size_t SphereTree::spheres() const {
  std::size_t sum = 0;
  for (const TreeBranch& branch : branches) sum += branch.spheres.size();
  return sum;
}

}  // namespace ostium::vascular
