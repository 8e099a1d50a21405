#pragma once
/// Connectivity of any mesh: which triangles continue across an edge, the pieces, and their openings. External meshes
/// branch at edges and face both ways; here each half-edge has at most one partner.
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

struct Sheets {
  /// Per half-edge 3 t + k (of triangle t, from its corner k to the next): its partner; -1: none.
  std::vector<int> opposite;
  std::vector<int> piece;  ///< of each triangle, from 0
  int pieces = 0;
};

/// Where more than two triangles share an edge, the flattest pairs belong together; an odd one stays open.
Sheets sheets_of(const Mesh& mesh);

/// Whether the way along the surface from one triangle to another is at most so long; `middles`: of all triangles.
bool reached_along(const Sheets& sheets, const std::vector<Eigen::Vector3d>& middles, int from, int to, double limit_m);

/// False of a soup of loose triangles: `orient` leaves it as it is.
bool sides_known(const Sheets& sheets);

/// What `orient` changed.
struct Orientation {
  std::vector<Eigen::Vector3d> flipped;   ///< centres of triangles that faced differently from most of their piece
  std::vector<Eigen::Vector3d> inverted;  ///< a point of each piece that faced inwards as a whole
};

/// Flips triangles so that each piece faces one way, and outwards (by its volume with openings capped); updates
/// `sheets`. A one-sided piece (Moebius strip) is cut open.
Orientation orient(Mesh& mesh, Sheets& sheets);

/// A closed row of open half-edges.
struct Opening {
  std::vector<int> half_edges;  ///< each begins where the previous ends; the first where the last ends
  int piece = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d outwards = Eigen::Vector3d::Zero();  ///< unit normal of a lid; zero if the opening has no area
  double diameter_m = 0;                               ///< of a circle of the lid's area
  double length_m = 0;                                 ///< of the rim
  /// True if the wall runs towards the opening (end of a vessel), false if around it (a hole in a wall).
  bool end = false;
  bool pinhole() const;
};

/// Openings of an oriented mesh.
std::vector<Opening> openings_of(const Mesh& mesh, const Sheets& sheets);

/// Closes an opening by a fan of triangles about its centre.
void cap(Mesh& mesh, const Opening& opening);

/// Turns all pieces outwards and closes every opening; returns those.
std::vector<Opening> close_all(Mesh& mesh);

/// Joins two facing openings by a band of triangles.
void join(Mesh& mesh, const Opening& a, const Opening& b);

}  // namespace ostium::vascular
