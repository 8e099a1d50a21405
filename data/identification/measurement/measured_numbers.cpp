#include "data/identification/measurement/measured_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace ostium::data {

std::vector<MeasuredNumbers> measured_numbers(const MeasurementSet& set) {
  const double unit = set.unit().size;
  std::vector<MeasuredNumbers> out;
  for (const Experiment& e : set.experiments) {
    MeasuredNumbers of{e.id, {}};
    for (const Eigen::Vector3d& p : e.points_m)
      for (const double x : p) of.numbers.push_back(x / unit);
    for (const ClickedPolyline& clicked : e.polylines)
      for (const Eigen::Vector2d& p : clicked.points_px) of.numbers.insert(of.numbers.end(), {p.x(), p.y()});
    out.push_back(std::move(of));
  }
  return out;
}

std::vector<std::string> copies_in_words(const std::vector<MeasuredNumbers>& list) {
  std::map<std::vector<double>, std::string> first;
  std::vector<std::string> out;
  for (const MeasuredNumbers& m : list) {
    if (m.numbers.empty()) continue;
    const auto [same, is_new] = first.try_emplace(m.numbers, m.id);
    if (!is_new)
      out.push_back(
          fmt::format("{} and {} are the same measurement, number for number: it counts twice; leave one out.",
                      same->second, m.id));
  }
  return out;
}

double written_to(const std::vector<MeasuredNumbers>& list) {
  constexpr std::size_t enough = 20;
  constexpr double rounding = 1e-6;  // of a multiple, by the arithmetic of units
  std::size_t count = 0;
  for (const MeasuredNumbers& m : list) count += m.numbers.size();
  if (count < enough) return 0;
  const auto whole = [](double x) { return std::fabs(x - std::round(x)) < rounding; };
  for (int digits = 0; digits <= 6; ++digits) {
    const double each = std::pow(10.0, digits);
    if (std::all_of(list.begin(), list.end(), [&](const MeasuredNumbers& m) {
          return std::all_of(m.numbers.begin(), m.numbers.end(), [&](double x) { return whole(x * each); });
        }))
      return 1 / each;
  }
  return 0;
}

std::string doubt_of_noise_below_rounding(const std::vector<MeasuredNumbers>& list, double sigma,
                                          const std::string& unit) {
  const double step = written_to(list), least = step / std::sqrt(12.0);
  if (!(sigma < least)) return "";
  return fmt::format("is {:g} {}, and all are written to {:g} {}: rounding alone makes {:.2g}", sigma, unit, step, unit,
                     least);
}

}  // namespace ostium::data
