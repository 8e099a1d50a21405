#include "data/identification/characterisation/characterised_wire.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace ostium::data {

namespace {

constexpr double same_place_m = 1e-6;
constexpr double rare = 0.01;

struct OfSet {
  std::size_t set;
  double log_value, sigma;
};

double chi2(const Combined& c) {
  double sum = 0;
  for (const double off : c.off) sum += off * off;
  return sum;
}

Combined mean_of(const std::vector<OfSet>& list) {
  Combined out;
  double weights = 0, sum = 0;
  for (const OfSet& e : list) weights += 1 / (e.sigma * e.sigma), sum += e.log_value / (e.sigma * e.sigma);
  const double mean = sum / weights;
  for (const OfSet& e : list) out.sets.push_back(e.set), out.off.push_back((e.log_value - mean) / e.sigma);
  const double freedom = static_cast<double>(list.size()) - 1;
  out.value = std::exp(mean);
  out.sigma = std::sqrt((freedom > 0 ? std::max(1.0, chi2(out) / freedom) : 1.0) / weights);
  return out;
}

/// What the sets say of one stiffness on [from, to], which no estimate's end divides.
Combined on_stretch(Stiffness of, double from_m, double to_m, double declared,
                    const std::vector<std::vector<StiffnessEstimate>>& estimates) {
  std::vector<OfSet> list;
  for (std::size_t k = 0; k < estimates.size(); ++k)
    for (const StiffnessEstimate& e : estimates[k])
      if (e.of == of && e.from_tip_m < to_m - same_place_m && e.to_tip_m > from_m + same_place_m)
        list.push_back({k, std::log(e.value_N_m2), std::hypot(e.sigma, calibrated_to)});
  if (!list.empty()) return mean_of(list);
  Combined as_declared;
  as_declared.value = declared;
  return as_declared;
}

}  // namespace

bool Combined::disagree() const {
  const double freedom = static_cast<double>(off.size()) - 1;
  if (freedom <= 0) return false;
  return cdf(complement(boost::math::chi_squared(freedom), chi2(*this))) < rare;
}

CharacterisedWire combined(const std::vector<DeclaredStretch>& declared,
                           const std::vector<std::vector<StiffnessEstimate>>& estimates,
                           const std::vector<std::optional<FrictionEstimate>>& friction) {
  std::vector<double> ends;
  for (const DeclaredStretch& d : declared) ends.insert(ends.end(), {d.from_tip_m, d.to_tip_m});
  const double length_m = declared.back().to_tip_m;
  for (const auto& list : estimates)
    for (const StiffnessEstimate& e : list)
      for (const double end : {e.from_tip_m, e.to_tip_m})
        if (end < length_m) ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end(), [](double a, double b) { return b - a < same_place_m; }),
             ends.end());
  CharacterisedWire out;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = (ends[i] + ends[i + 1]) / 2;
    const auto& d =
        *std::find_if(declared.begin(), declared.end(), [&](const DeclaredStretch& s) { return middle < s.to_tip_m; });
    Stretch s{ends[i], ends[i + 1], {}, {}};
    s.EI_N_m2 = on_stretch(Stiffness::bending, s.from_tip_m, s.to_tip_m, d.EI_N_m2, estimates);
    s.GJ_N_m2 = on_stretch(Stiffness::torsion, s.from_tip_m, s.to_tip_m, d.GJ_N_m2, estimates);
    if (s.EI_N_m2.measured() && !s.GJ_N_m2.measured()) s.GJ_N_m2.value *= s.EI_N_m2.value / d.EI_N_m2;
    out.stretches.push_back(s);
  }
  std::vector<OfSet> list;
  for (std::size_t k = 0; k < friction.size(); ++k)
    if (friction[k] && friction[k]->value > 0)
      list.push_back(
          {k, std::log(friction[k]->value), std::hypot(friction[k]->sigma / friction[k]->value, calibrated_to)});
  if (!list.empty()) out.friction = mean_of(list);
  return out;
}

}  // namespace ostium::data
