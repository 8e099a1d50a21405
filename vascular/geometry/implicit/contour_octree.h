#pragma once
/// An octree around the surface of a union of tubes, and the quadrilaterals of its dual contour. Internal to
/// contour.cpp.
#include <array>
#include <unordered_map>
#include <vector>

#include "vascular/geometry/implicit/contour.h"

namespace ostium::vascular {

/// Corners of a quadrilateral, counter-clockwise as seen from outside; two neighbours may be equal (a triangle).
using Quad = std::array<int, 4>;

class ContourOctree {
 public:
  /// `shift`, in finest cells, offsets the grid.
  ContourOctree(const TubeUnion& lumen, const ContourSettings& settings, double shift);

  /// The dual contour. Fills `places` and `near` per vertex: a surface point in its cell, and the segments that
  /// determine the surface there (valid until the next call of refine).
  std::vector<Quad> extract(std::vector<Eigen::Vector3d>& places, std::vector<Eigen::Vector3d>& outwards,
                            std::vector<const std::vector<int>*>& near);

  /// Halves the cells of some vertices of the last contour. False if none can be halved.
  bool refine(const std::vector<int>& vertices);

 private:
  struct Cell {
    std::array<int, 3> corner;  ///< in units
    int size;                   ///< edge in units, a power of two
    int children = -1;          ///< index of the first of eight; -1: a leaf
    int vertex = -1;            ///< for a leaf that may contain the surface
  };
  struct Vertex {
    int cell;
    std::vector<int> segments;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();  ///< of the surface's crossings with edges
    int count = 0;
    bool placed = false;  ///< `sum` is now a point of the surface
    Eigen::Vector3d outwards = Eigen::Vector3d::Zero();
    std::array<double, 8> corners{};  ///< the union's function at the corners
    int index = -1;                   ///< in the last contour
  };

  static std::array<int, 3> corner(const Cell& cell, int k);
  Eigen::Vector3d position(const std::array<int, 3>& at) const;
  double wanted_size(double radius_m) const;
  double value_at(const std::array<int, 3>& at, const std::vector<int>& near);
  int child(int c, int k) const { return cells_[c].children < 0 ? c : cells_[c].children + k; }
  bool leaf(int c) const { return cells_[c].children < 0; }
  bool empty(int c) const { return leaf(c) && cells_[c].vertex < 0; }

  void grow(int c, const std::vector<int>& candidates);
  void divide(int c, const std::vector<int>& candidates);

  // The three recursions of dual contouring: within a cell; across a face (cells a, b, with b further along `axis`);
  // around an edge along `axis` (bit 0 of the cell's number along sides[0], bit 1 along sides[1], which follow `axis`
  // cyclically).
  void cell_edges(int c);
  void face_edges(int a, int b, int axis);
  void edge(const std::array<int, 4>& around, int axis, const std::array<int, 2>& sides);
  void emit(const std::array<int, 4>& around, int axis, const std::array<int, 2>& sides);

  const TubeUnion& lumen_;
  const ContourSettings& settings_;
  double unit_m_;  ///< smallest possible cell
  Eigen::Vector3d origin_;
  std::vector<Cell> cells_;
  std::vector<Vertex> vertices_;
  std::vector<int> used_;  ///< vertices of the last contour
  std::vector<Quad> quads_;
  std::unordered_map<long, double> values_;
};

/// Moves p onto the surface by Newton steps along the gradient; `outwards` becomes the unit normal.
Eigen::Vector3d onto_surface(const TubeUnion& lumen, const std::vector<int>& near, Eigen::Vector3d p, int steps,
                             Eigen::Vector3d& outwards);

}  // namespace ostium::vascular
