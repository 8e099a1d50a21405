#pragma once
/// Made-up films of an injection: iodine along an artery, by a solver of its own.
///
/// The flow is integrated in steps of 0.5 ms. Contrast is a density over the volume that has passed the ostium, which
/// spreads by diffusion (implicit finite volumes) from one slice of the artery to the next.
#include <string>
#include <vector>

namespace ostium::bench_sets {

struct MadeSet {
  std::string json;               ///< the file
  std::vector<double> flow_mL_s;  ///< true mean flow of each run
  double strength = 0;            ///< of the effect, 0 to 1 of the strongest that is made
};

/// `effect`: an id, or "id form"; empty: nothing undeclared. `over_noise`: what the declared model leaves against the
/// noise, about; 0: a strong effect.
MadeSet density_set(const std::string& effect, double over_noise, unsigned seed);

/// Every effect that `density_set` makes.
const std::vector<std::string>& density_effects();

}  // namespace ostium::bench_sets
