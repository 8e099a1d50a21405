#pragma once
/// How deep instruments are in the wall, told by the triangles alone, in code that shares nothing with contact.
#include "app/session/model/session.h"

namespace ostium::app {

struct Penetration {
  double deepest_m = 0;  ///< that a node's ball is in the wall; of nodes that lie in no other instrument
  int outside = 0;       ///< nodes, of those looked at, that the winding number finds outside
};

/// Of one state; takes some 50 ms with 160,000 triangles. All nodes are measured; tips and nodes whose middle is near
/// the wall are also told inside or outside.
Penetration penetration(const SessionModel& model, const SessionState& state);

}  // namespace ostium::app
