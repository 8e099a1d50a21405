#include "vascular/heart/compressions.h"

#include <cmath>

namespace ostium::vascular {

double pressed_Pa(const CompressionModel& model, double share_of_period) {
  if (share_of_period >= model.pressed) return 0;
  return model.most_Pa * std::sin(units::pi * share_of_period / model.pressed);
}

}  // namespace ostium::vascular
