#pragma once
/// Helpers shared by several effects.
#include <algorithm>

#include "core/base/units.h"
#include "data/identification/effects/effect.h"

namespace ostium::data {

inline bool chosen(std::optional<int> instrument, std::size_t i) {
  return !instrument || *instrument == static_cast<int>(i);
}

/// The longest insertion of any of the chosen instruments, m.
inline double longest_inserted(const MeasurementSet& set, std::optional<int> instrument) {
  double longest = 0;
  for (const Experiment& e : set.experiments)
    for (std::size_t i = 0; i < e.set.size(); ++i)
      if (chosen(instrument, i)) longest = std::max(longest, e.set[i].inserted_m);
  return longest;
}

/// Cuts `sections` at from and to and calls change(section) for those in between.
template <class Change>
void change_stretch(std::vector<core::Section>& sections, double from_m, double to_m, Change&& change) {
  constexpr double least = 1e-6;  // ignore shorter pieces
  std::vector<core::Section> out;
  for (const core::Section& s : sections) {
    double at = s.from_tip_m;
    for (double end : {from_m, to_m, s.to_tip_m}) {
      end = std::min(end, s.to_tip_m);
      if (end < s.to_tip_m && (end - at < least || s.to_tip_m - end < least)) continue;
      if (end <= at) continue;
      core::Section piece = s;
      piece.from_tip_m = at, piece.to_tip_m = end;
      const double middle = 0.5 * (at + end);
      if (middle > from_m && middle < to_m) change(piece);
      out.push_back(piece);
      at = end;
    }
  }
  sections = out;
}

inline constexpr double everywhere_mm = 1e5;  ///< behind every hub

/// Stretches that an effect may act on: everywhere, and each section that is inserted. They hold from_tip_mm and
/// to_tip_mm.
inline std::vector<EffectForm> stretches_of(const MeasurementSet& set, std::optional<int> instrument) {
  std::vector<EffectForm> out = {{"", {{"from_tip_mm", 0}, {"to_tip_mm", everywhere_mm}}}};
  if (!instrument && set.instruments.size() > 1) return out;
  const auto& sections = set.instruments[instrument.value_or(0)].sections;
  if (sections.size() < 2) return out;
  const double longest = longest_inserted(set, instrument);
  for (const core::Section& s : sections)
    if (s.from_tip_m < longest)
      out.push_back({"from " + std::to_string(static_cast<int>(s.from_tip_m / units::mm)) + " mm",
                     {{"from_tip_mm", s.from_tip_m / units::mm}, {"to_tip_mm", s.to_tip_m / units::mm}}});
  return out;
}

/// Whether the roll of any chosen instrument differs between experiments, whether turned at the base or with it.
inline bool roll_varies(const MeasurementSet& set, std::optional<int> instrument) {
  for (const Experiment& e : set.experiments)
    for (std::size_t i = 0; i < e.set.size(); ++i)
      if (chosen(instrument, i) && e.set[i].roll_rad != set.experiments[0].set[i].roll_rad) return true;
  return false;
}

/// Why a law of the instrument cannot be learned from this set; "" if it can.
inline std::string why_not_learned(const MeasurementSet& set, std::optional<int>) {
  constexpr int least = 4;
  if (set.instruments.size() > 1) return "laws are learned of an instrument alone";
  if (set.vessel) return "in a vessel a history is too dear to learn a law from";
  const auto shapes = std::count_if(set.experiments.begin(), set.experiments.end(), [](const Experiment& e) {
    return e.kind == Experiment::Kind::centreline || e.kind == Experiment::Kind::projections;
  });
  return shapes < least ? "a law is learned from whole shapes, of four experiments or more" : "";
}

inline bool tip_loads(const MeasurementSet& set) {
  return std::any_of(set.experiments.begin(), set.experiments.end(),
                     [](const Experiment& e) { return !e.tip_force_N.isZero(); });
}

}  // namespace ostium::data
