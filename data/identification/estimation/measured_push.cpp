#include "data/identification/estimation/measured_push.h"

#include <cmath>

namespace ostium::data {

namespace {

constexpr double known_to = 0.1;

struct Squares {
  double sum = 0, count = 0;

  void add(double x) { sum += x * x, count += 1; }
  std::optional<double> rms() const { return count > 0 ? std::optional(std::sqrt(sum / count)) : std::nullopt; }
};

}  // namespace

std::optional<double> push_sigma_N(const MeasurementSet& set) {
  Squares squares;
  for (const Experiment& e : set.experiments)
    if (e.proximal_force_N) squares.add(*e.proximal_force_N);
  if (!set.vessel || !(squares.sum > 0)) return {};
  return known_to * *squares.rms();
}

std::optional<double> push_misfit_N(const Experiment& e, const PredictedShape& shape) {
  if (!e.proximal_force_N) return {};
  return *e.proximal_force_N - shape.base_push_N;
}

std::optional<double> push_rms_N(const MeasurementSet& set, const std::vector<PredictedShape>& shapes) {
  Squares squares;
  for (std::size_t e = 0; e < shapes.size(); ++e)
    if (const auto off = push_misfit_N(set.experiments[e], shapes[e])) squares.add(*off);
  return squares.rms();
}

}  // namespace ostium::data
