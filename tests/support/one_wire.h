#pragma once
/// One uniform wire that was measured on several benches, by generators that share nothing with core or
/// data/identification.

namespace ostium::synthetic {

/// What it is, and what the files of its sets declare. N mm2.
struct BenchWire {
  double EI = 30, GJ = 23, friction = 0.08;
  double declared_EI = 30, declared_GJ = 23, declared_friction = 0.08;
};

}  // namespace ostium::synthetic
