#include "app/commands/treat/strips.h"

#include <algorithm>

#include "core/base/units.h"

namespace ostium::app {

namespace {

using units::atm, units::mmHg;

/// A lead's strip, scaled to the lead's amplitude.
fluoro::Strip strip_of(vascular::Lead lead) {
  constexpr std::pair<float, float> range[vascular::leads] = {{-0.3F, 1.15F}, {-0.3F, 0.8F}, {-0.3F, 0.9F},
                                                              {-0.4F, 0.6F},  {-1.1F, 0.8F}, {-0.4F, 1.5F}};
  const auto [low, high] = range[static_cast<int>(lead)];
  return {vascular::lead_names[static_cast<int>(lead)], "mV", 250, {}, low, high};
}

/// The two leads that show ischaemia of the territory best.
std::array<vascular::Lead, 2> telling_leads(const std::string& artery) {
  if (artery == "RCA") return {vascular::Lead::III, vascular::Lead::aVL};
  if (artery == "LCx") return {vascular::Lead::V5, vascular::Lead::V2};
  return {vascular::Lead::II, vascular::Lead::V2};
}

}  // namespace

InflationStrips::InflationStrips(const std::string& artery) : which(telling_leads(artery)) {
  for (vascular::Lead lead : which) strips.push_back(strip_of(lead));
  strips.push_back({"Ao", "mmHg", 250, {}, 50, 130});
  strips.push_back({"gauge", "atm", 250, {}, -2, 22});
}

void InflationStrips::end(double seconds) {
  for (fluoro::Strip& strip : strips)
    strip.samples.resize(std::min(strip.samples.size(), static_cast<std::size_t>(seconds * strip.samples_per_s)));
}

void InflationStrips::listen(const Bedside& bed) {
  if (step++ % 4) return;
  const auto leads = ecg(bed.physiology.heart, bed.blood.heart, bed.physiology.ischaemia, bed.blood.ischaemia);
  for (int k = 0; k < 2; ++k) strips[k].samples.push_back(static_cast<float>(leads[static_cast<int>(which[k])]));
  const vascular::Pressures p = pressures(bed.physiology.heart, bed.blood.heart);
  strips[2].samples.push_back(static_cast<float>(p.aorta_Pa / mmHg));
  strips[3].samples.push_back(static_cast<float>(bed.device.balloons[0].gauge_Pa / atm));
}

}  // namespace ostium::app
