/// The wire was taken out and put back, or its index on the hub slipped: from one run on the distal scale shows a
/// constant angle more.
#include <cmath>

#include "core/base/units.h"
#include "data/identification/curves/torque_response/torque_response.h"

namespace ostium::data::torque_response {

namespace {

void offset(const std::vector<double>& v, Setup& setup) {
  const auto from = static_cast<std::size_t>(std::lround(v[1]));
  for (std::size_t r = from; r < setup.runs.size(); ++r) setup.runs[r].distal_more_rad += v[0] * units::degree;
}

}  // namespace

Effect reseated_instrument(std::size_t from, const std::string& id) {
  Effect effect;
  effect.head.id = "reseated_instrument";
  effect.head.form = "from " + id + " on";
  effect.head.of_data = true;
  effect.head.what = "an instrument that was put back at another angle before " + id;
  const auto run = static_cast<double>(from);
  // The run is not fitted: one form for each, with its number held.
  effect.head.parameters = {
      {"distal_deg", "deg", "by how much the distal scale shows more", 0, 30, -400, 400, false},
      {"from_run", "1", "from which run on, counted from 0", run, 1e-3, run - 0.4, run + 0.4, false}};
  effect.apply = offset;
  return effect;
}

}  // namespace ostium::data::torque_response
