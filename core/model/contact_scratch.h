#pragma once
/// Working memory of contact, per rod.
#include <vector>

#include "core/math/field.h"

namespace ostium::core {

inline constexpr int max_planes = 6;  ///< at one node

/// A wall beside a node, as a plane that moves with it: normal . r >= place.
struct WallPlane {
  V3<double> normal;     ///< into the lumen
  double place = 0;      ///< m, of the node's centre when it touches
  double softness = 0;   ///< m/N of the wall
  V3<double> across;     ///< round the instrument: rod's tangent x normal
  double beside = 0;     ///< m: across . r where it was, carried along by the wall
  double curvature = 0;  ///< 1/m, of the wall's hollow towards `across`, for the node's centre
  double stay = 0;       ///< N/m of the tie along `across`: in a hollow, the force turns with the node, like a pendulum
  V3<double> carried;    ///< m, how far the wall beside it moves in the step
  double friction = 0;
  double gap = 0;     ///< m, at the beginning of the step; negative: it pressed into a soft wall
  bool soft = false;  ///< the wall gives way
  bool active = false;
  /// The triangle that it is seen of, if its nearest point is at that one's rim: from elsewhere it is another.
  int surface = -1, cluster = -1, triangle = -1;
};

/// What is near a node, at most.
struct NodeWalls {
  int count = 0;
  WallPlane planes[max_planes];
};

/// A point of a chain: between a node and the next.
struct RodSpot {
  int node = 0;
  double share[2] = {1, 0};  ///< of both
};

/// Where two strands, or two pieces of one, are near each other.
struct RodContact {
  int a = 0, b = 0;  ///< strands
  RodSpot at_a, at_b;
  V3<double> normal;          ///< from b to a
  double radii = 0;           ///< m, of both
  double stiffness = 0;       ///< N/m
  double deep = 0;            ///< m, of one in the other, as this round began
  double push_N = 0;          ///< of each on the other, by what is known
  bool active = false;        ///< in this round
  V3<double> seen_a, seen_b;  ///< m: where the points were as this round began
};

struct ContactScratch {
  std::vector<NodeWalls> walls;  ///< (#nodes)
  Field<1> travel;               ///< m, (#nodes): how far it may go within the walls that were found
  int changes = 0;               ///< of ties since the last linearisation
  std::vector<char> changed;     ///< (#nodes), by what was met on the way
  int same = 0;                  ///< elements at either end that the last change of ties has left as they were
  Field<6> free_compliance;      ///< (#nodes), as they would be without walls
  Field<3> free_target;
  // --- friction, at nodes
  std::vector<char> rubs;  ///< whether there is any
  Field<1> stiffness;      ///< N/m
  Field<3> along, across;  ///< unit vectors
  Field<3> from;           ///< m, where it would not pull the node at all
  // --- descent, at nodes
  Field<3> anchor, ahead;            ///< m: the best point yet of this linearisation; what the last solve leads to
  Field<3> anchor_push, ahead_push;  ///< N: what walls would have to push with for balance there
  // --- other rods
  std::vector<double> rod_shares;  ///< (#nodes): of contacts with them
  // --- queries
  std::vector<int> clusters;
};

}  // namespace ostium::core
