#pragma once
/// Wires pushed into tubes with bends and pulled out: their shape in the tube by an interior-point method, friction
/// from node to node.
#include "tests/support/one_wire.h"
#include "tests/support/sets/bench_set.h"

namespace ostium::synthetic {

/// A tube's bend: begins `at` from the entrance, mm and rad.
struct TubeBend {
  double at, radius, angle;
};

/// Where a weightless wire presses on its tube, with which force, without an axial one.
struct Touch {
  double at, force;
};

/// Nodes `step` mm apart from `from` on to the tip; `stiffness(distance from the tip)` in N mm2.
std::vector<Touch> touches_of(const std::vector<TubeBend>& bends, double clearance, double from, double tip,
                              double step, double (*stiffness)(double from_tip, const void* data), const void* data);

BenchKind push_kind();
/// A clean set of this wire.
BenchSet push_of(const BenchWire& wire, unsigned seed);

}  // namespace ostium::synthetic
