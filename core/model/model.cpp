#include "core/model/model.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace ostium::core {

namespace {

std::vector<Nesting> by_inner_rod(std::vector<Nesting> nestings) {
  std::stable_sort(nestings.begin(), nestings.end(),
                   [](const Nesting& a, const Nesting& b) { return a.inner < b.inner; });
  return nestings;
}

void check_nestings(const Model& model) {
  const int rods = static_cast<int>(model.rods.size());
  // The longest stack that ends with each rod; alternatives side by side do not add up.
  std::vector<int> stacked(model.rods.size(), 1);
  for (const Nesting& n : by_inner_rod(model.nestings))
    if (n.outer >= 0 && n.outer < n.inner && n.inner < rods)
      stacked[n.inner] = std::max(stacked[n.inner], stacked[n.outer] + 1);
  for (std::size_t i = 0; i < model.nestings.size(); ++i) {
    const Nesting& n = model.nestings[i];
    const auto refuse = [&](const std::string& what) {
      throw std::invalid_argument("model: nesting " + std::to_string(i) + " (rod " + std::to_string(n.inner) +
                                  " in rod " + std::to_string(n.outer) + "): " + what);
    };
    if (n.outer < 0 || n.inner >= rods || n.outer >= n.inner)
      refuse("there are " + std::to_string(rods) + " rods, and the outer one must come before the inner one");
    if (!(n.lumen_m > 0)) refuse("its lumen must be longer than 0");
    if (stacked[n.inner] > max_outer_rods + 1) refuse("a rod can run in at most three others at once");
    if (!(n.friction >= 0 && n.friction <= 2)) refuse("its friction must be within 0 to 2");
    const double room = tightest_clearance_m(model.rods[n.outer], model.rods[n.inner], n.lumen_m);
    if (!(room > 0))
      refuse("the inner one is too thick for the lumen, by " + std::to_string(-1e3 * room) + " mm of radius");
  }
}

}  // namespace

void check(const Model& model) {
  if (model.rods.empty()) throw std::invalid_argument("model: it has no rod; give at least one");
  if (!model.gravity_W.allFinite()) throw std::invalid_argument("model: gravity is not finite");
  if (!(model.step_s > 0 && model.step_s <= 0.01))
    throw std::invalid_argument("model: the step is " + std::to_string(model.step_s) + " s; it must lie in (0, 0.01]");
  check_nestings(model);
}

}  // namespace ostium::core
