#include "data/effects/roll_loss.h"

namespace ostium {

namespace {

bool chosen(std::optional<int> instrument, std::size_t i) { return !instrument || *instrument == static_cast<int>(i); }

std::string why_not(const MeasurementSet& set, std::optional<int> instrument) {
  for (const Experiment& e : set.experiments)
    for (std::size_t i = 0; i < e.set.size(); ++i)
      if (chosen(instrument, i) && e.set[i].roll_rad != 0) return "";
  return "nothing was rolled";
}

void apply(const ActiveEffect& effect, const MeasurementSet&, const Experiment&, Setup& setup) {
  for (std::size_t i = 0; i < setup.nest.parts.size(); ++i)
    if (chosen(effect.instrument, i)) setup.nest.parts[i].roll_rad *= 1 - effect.values[0];
}

}  // namespace

Effect roll_loss() {
  return {"roll_loss",
          "loss of commanded roll",
          {{"fraction", "1", "part of the commanded roll that does not arrive", 0, 0.1, -0.2, 0.8, false}},
          why_not,
          apply};
}

}  // namespace ostium
