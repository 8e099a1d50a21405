#pragma once
/// Generalised winding number: 1 inside a closed surface that faces outwards, 0 outside, 2 where two overlap, and
/// something in between near openings (Jacobson et al., ACM TOG 2013;32:33). Far triangles are combined into dipoles
/// (Barill et al., ACM TOG 2018;37:43).
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

class WindingNumber {
 public:
  /// Keeps a reference to `mesh`.
  explicit WindingNumber(const Mesh& mesh);
  double at(const Eigen::Vector3d& p) const;
  bool inside(const Eigen::Vector3d& p) const { return at(p) > 0.5; }

 private:
  struct Node {
    Eigen::Vector3d middle, dipole;  ///< area-weighted centre of its triangles; sum of areas times normals
    double reach;                    ///< largest distance of its triangles from that centre
    int first, last, right;          ///< triangles order_[first..last); second child, -1: a leaf
  };
  int build(int first, int last);
  double triangle_at(int t, const Eigen::Vector3d& p) const;

  const Mesh& mesh_;
  std::vector<int> order_;
  std::vector<Eigen::Vector3d> middles_;
  std::vector<Node> nodes_;
};

/// Triangles with inside on one of their sides and outside on the other, `step_m` away from them: without those of a
/// piece that lie in another one, which would spoil distances to the wall.
std::vector<std::array<int, 3>> bordering_triangles(const Mesh& closed, const WindingNumber& winding, double step_m);

}  // namespace ostium::vascular
