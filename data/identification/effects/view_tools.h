#pragma once
/// What effects of single views share. Their first parameter is `view`: the index of the view that they act in, -1 for
/// all; it is chosen by the form and never fitted.
#include <string>

#include "data/identification/effects/effect.h"

namespace ostium::data {

inline EffectParameter view_parameter() {
  return {"view", "1", "the view it acts in, counted from 0; -1: all of them", -1, 1, -1, 100, false};
}

inline bool in_view(const ActiveEffect& effect, std::size_t view) {
  return effect.values[0] < 0 || effect.values[0] == static_cast<double>(view);
}

inline std::string no_views(const MeasurementSet& set, std::optional<int>) {
  return set.views.empty() ? "the set has no views" : "";
}

/// Forms of one view each, with `held` besides; of several views also of all together, if `all`.
inline std::vector<EffectForm> forms_of_views(const MeasurementSet& set, bool all,
                                              const std::vector<std::pair<std::string, double>>& held = {},
                                              const std::string& name = "") {
  std::vector<EffectForm> out;
  const auto add = [&](const std::string& of, double view) {
    out.push_back({name.empty() ? of : name + ", " + of, held});
    out.back().held.emplace_back("view", view);
  };
  if (all && set.views.size() > 1) add("all views", -1);
  for (std::size_t v = 0; v < set.views.size(); ++v) add("view " + set.views[v].id, static_cast<double>(v));
  return out;
}

}  // namespace ostium::data
