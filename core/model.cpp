#include "core/model.h"

#include <stdexcept>

namespace ostium {

void check(const Model& model) {
  if (model.rods.empty()) throw std::invalid_argument("model: it has no rod; give at least one");
  if (!model.gravity_W.allFinite()) throw std::invalid_argument("model: gravity is not finite");
  if (!(model.step_s > 0 && model.step_s <= 0.01))
    throw std::invalid_argument("model: the step is " + std::to_string(model.step_s) + " s; it must lie in (0, 0.01]");
}

}  // namespace ostium
