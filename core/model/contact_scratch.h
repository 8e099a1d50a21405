#pragma once
/// Working memory of contact, per rod.
#include <vector>

#include "core/math/field.h"
#include "core/wall/pose.h"

namespace ostium::core {

inline constexpr int max_planes = 6;  ///< per node

/// A wall near a node, as a plane that moves with the wall: normal . r >= place.
struct WallPlane {
  V3<double> normal;     ///< into the lumen
  double place = 0;      ///< m, of the node's centre when touching
  double softness = 0;   ///< m/N, compliance of the wall
  V3<double> across;     ///< unit vector around the instrument: rod's tangent x normal
  double beside = 0;     ///< m: across . r of the node's last position, carried along by the wall
  double curvature = 0;  ///< 1/m, of the path of the node's centre in the wall's hollow, along `across`
  double stay = 0;       ///< N/m of the tie along `across`: in a hollow the force turns with the node, as on a pendulum
  V3<double> carried;    ///< m, displacement of the wall in the step
  double friction = 0;
  double gap = 0;     ///< m, at the beginning of the step; negative: behind it
  double facing = 1;  ///< cosine between its triangle's normal and the way from the nearest point to the node, 0 to 1
  bool soft = false;  ///< the wall has finite stiffness
  bool active = false;
  /// The triangle, if its nearest point is on its rim: from another position the plane is different.
  int surface = -1, cluster = -1, triangle = -1;
};

/// Walls near a node.
struct NodeWalls {
  int count = 0;
  WallPlane planes[max_planes];
};

/// A point between a node of a chain and the next.
struct RodSpot {
  int node = 0;
  double share[2] = {1, 0};  ///< weights of the two nodes
};

/// A contact between two strands, or two parts of one.
struct RodContact {
  int a = 0, b = 0;  ///< strands
  RodSpot at_a, at_b;
  V3<double> normal;          ///< from b to a
  double radii = 0;           ///< m, sum of both
  double stiffness = 0;       ///< N/m
  double deep = 0;            ///< m, penetration as this round began
  double push_N = 0;          ///< force between the two, current estimate
  bool active = false;        ///< in this round
  V3<double> seen_a, seen_b;  ///< m: the two points as this round began
};

inline constexpr int most_in_block = 8;  ///< nodes that share a query for walls

/// Leaves of a surface's tree near a block of nodes, kept from step to step; most of them sleep (core/contact/sleep.h).
struct KeptLeaves {
  struct Sleep {
    int node = 0;          ///< of the tree
    int version = 0;       ///< of its cluster
    float speed_m = 0;     ///< per frame of the cycle, relative to the reference: any corner, at most
    float nears_m = 0;     ///< ... and how much nearer it may seem to come to a node within one step
    float wakes_at_m = 0;  ///< way at which a node may meet it
  };
  LeafList list;
  std::vector<Sleep> sleep;   ///< of each leaf
  std::vector<Sleep> before;  ///< working memory: those of the list before this one
  long made = -1;             ///< LeafList::made for which they were set, and
  int interval = -1;          ///< LeafList::interval
  long edits = 0;             ///< of Surface
  int reference = 0;          ///< node of the tree: the middle of its box moves as the walls here do, about
  double sway_m = 0;          ///< per unit of sway, relative to the reference: any leaf, at most
  double way_m = 0;           ///< how far the block's nodes have gone relative to the reference: at most
  double frames = 0;          ///< how far the cycle has gone
  // --- as the last step began
  int nodes = 0;
  V3<double> seen[most_in_block];    ///< m, relative to the reference
  double reach[most_in_block];       ///< m
  int in_interval = 0;               ///< of SurfaceMoment, as are
  double share = 0, sway = 0;        ///< these
  double moved_m = 0;                ///< of Surface
  double to_next_m = 0;              ///< until the next interval began: what any leaf moved, at most
  Eigen::Vector3d shift_W{0, 0, 0};  ///< of SurfaceMoment

  KeptLeaves() { sleep.reserve(LeafList::most), before.reserve(LeafList::most); }
};

/// Blocks of a rod's neighbouring nodes that look for walls together. Blocks lie fixed in the rod, so that what they
/// keep serves them as the rod moves on.
struct Lookouts {
  std::vector<int> block;          ///< (#nodes)
  std::vector<KeptLeaves> leaves;  ///< [block][surface]
};

struct ContactScratch {
  std::vector<NodeWalls> walls;  ///< (#nodes)
  Field<3> expected;             ///< m, (#nodes): where a node was expected to go when its walls were looked for
  int changes = 0;               ///< changes of ties since the last linearisation
  int settling = 0;              ///< ... and since the planes last changed
  /// The nodes whose ties are being settled, while the others' are left alone; -1: all.
  int window_first = -1, window_last = -1;
  std::vector<char> changed;  ///< (#nodes): changed by continuous collision
  int same = 0;               ///< elements at either end that the last change of ties left unchanged
  Field<6> free_compliance;   ///< (#nodes), compliance without walls
  Field<3> free_target;
  // --- friction, at nodes
  std::vector<char> rubs;  ///< whether the node has any
  Field<1> stiffness;      ///< N/m
  Field<3> along, across;  ///< unit vectors
  Field<3> from;           ///< m, position at which the friction spring exerts no force
  // --- line search, at nodes
  Field<3> anchor, ahead;            ///< m: best point so far of this linearisation; solution of the last solve
  Field<3> anchor_push, ahead_push;  ///< N: wall forces that would balance the node there
  /// A plane on the way from the anchor: the wall's push there, N, how it changes until the point ahead, and how far
  /// the way goes along the normal, m.
  struct PlaneAhead {
    double push, change, along;
  };
  std::vector<PlaneAhead> planes_ahead;
  // --- other rods
  std::vector<double> rod_shares;  ///< (#nodes): total share of rod contacts
  std::vector<int> clusters;       ///< of queries
};

}  // namespace ostium::core
