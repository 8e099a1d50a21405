#pragma once
/// How the triangles of any mesh hang together: which run on across an edge, in pieces, up to which openings. Meshes of
/// others branch at edges and face both ways; here each half-edge has one partner at most.
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct Sheets {
  /// Of half-edge 3 t + k (of triangle t, from its corner k to the next): the one that goes on there; -1: none.
  std::vector<int> opposite;
  std::vector<int> piece;  ///< of each triangle, from 0
  int pieces = 0;
};

/// Where more than two triangles meet in an edge, those that go on flattest belong together; an odd one stays open.
Sheets sheets_of(const Mesh& mesh);

/// What `orient` changed.
struct Orientation {
  std::vector<Eigen::Vector3d> flipped;   ///< middles of triangles that faced another way than most of their piece
  std::vector<Eigen::Vector3d> inverted;  ///< a point of each piece that faced inwards as a whole
};

/// Turns triangles so that pieces face one way, and outwards (by their volume, openings capped); `sheets` follows.
/// Where a piece has one side only (a Moebius strip), it is opened.
Orientation orient(Mesh& mesh, Sheets& sheets);

/// A row of open half-edges.
struct Opening {
  std::vector<int> half_edges;  ///< each begins where the one before ends, the first where the last ends
  int piece = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d outwards = Eigen::Vector3d::Zero();  ///< unit, of a lid; zero if the opening has no area
  double diameter_m = 0;                               ///< of a circle with the lid's area
  double length_m = 0;                                 ///< of the edge
  /// The wall runs towards the opening (a vessel ends there) instead of around it (a hole in a wall).
  bool end = false;
  bool pinhole() const;
};

/// Of an oriented mesh.
std::vector<Opening> openings_of(const Mesh& mesh, const Sheets& sheets);

/// A fan of triangles about the opening's middle.
void cap(Mesh& mesh, const Opening& opening);

/// A band of triangles from one opening to another that faces it.
void join(Mesh& mesh, const Opening& a, const Opening& b);

}  // namespace ostium::vascular
