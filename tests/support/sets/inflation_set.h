#pragma once
/// Made-up inflations of a balloon, free, in vessels and in stents.
///
/// Balloon and wall are two springs in parallel inside the balloon's skin, followed in time until they are at rest:
/// the balloon's own pressure at a diameter (its chart read the other way) and the wall's add up to that of the gauge.
#include <string>
#include <vector>

namespace ostium::bench_sets {

/// As density_set does.
std::string inflation_set(const std::string& effect, double over_noise, unsigned seed);
const std::vector<std::string>& inflation_effects();

}  // namespace ostium::bench_sets
