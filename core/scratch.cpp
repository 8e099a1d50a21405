#include "core/scratch.h"

#include <algorithm>

namespace ostium {

Scratch::Scratch(const Model& model) {
  check(model);
  int longest = 0;
  for (const Rod& rod : model.rods) {
    const int N = rod.elements;
    longest = std::max(longest, N);
    RodScratch& s = rods.emplace_back();
    s.inside = rod;
    s.chain = Chain(N);
    s.target.resize(N + 1);
    s.position.resize(N + 1);
    s.orientation.resize(N);
    s.turn.resize(N);
    s.force.resize(N);
    if (rod.damping.material_time_s > 0) s.strain.resize(N + 1);
  }
  factors.resize(longest);
}

}  // namespace ostium
