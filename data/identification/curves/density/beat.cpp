#include <algorithm>
#include <cmath>

#include "data/identification/curves/density/density.h"

namespace ostium::data::density {

namespace {

constexpr double step_height = 0.2;  // of the mean flow
constexpr double step_slope = 4;     // times the slope on either side

/// After sample `i`; the beat comes round: its last sample, at 1, is its first.
double slope(const Beat& beat, std::size_t i) {
  i %= beat.phase.size() - 1;
  return (beat.relative[i + 1] - beat.relative[i]) / (beat.phase[i + 1] - beat.phase[i]);
}
double slope_before(const Beat& beat, std::size_t i) { return slope(beat, i + beat.phase.size() - 2); }

}  // namespace

std::vector<Step> steps_of(const Beat& sampled) {
  std::vector<Step> out;
  const std::size_t n = sampled.phase.size();
  for (std::size_t i = 0; i + 1 < n && n > 4; ++i) {
    const double aside = std::max(std::fabs(slope_before(sampled, i)), std::fabs(slope(sampled, i + 1)));
    if (std::fabs(sampled.relative[i + 1] - sampled.relative[i]) < step_height) continue;
    if (std::fabs(slope(sampled, i)) < step_slope * aside) continue;
    out.push_back({i, i + 2 == n ? 1 : (sampled.phase[i] + sampled.phase[i + 1]) / 2});
  }
  return out;
}

Beat with_steps(const Beat& sampled, const std::vector<Step>& steps) {
  Beat out{sampled.length_s, {}, {}};
  const auto add = [&](double phase, double relative) { out.phase.push_back(phase), out.relative.push_back(relative); };
  for (std::size_t i = 0; i < sampled.phase.size(); ++i) {
    add(sampled.phase[i], sampled.relative[i]);
    for (const Step& step : steps) {
      if (step.after != i) continue;
      add(step.at_phase, sampled.relative[i] + slope_before(sampled, i) * (step.at_phase - sampled.phase[i]));
      add(step.at_phase, sampled.relative[i + 1] - slope(sampled, i + 1) * (sampled.phase[i + 1] - step.at_phase));
    }
  }
  return out;
}

}  // namespace ostium::data::density
