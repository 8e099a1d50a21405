#pragma once
/// Bending of no form that an effect has: a tangent without memory, or springs behind sliders, side by side.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "tests/support/dice.h"

namespace ostium::synthetic {

inline constexpr std::size_t most_sliders = 12;
using SlidersAt = std::array<double, most_sliders>;

class BendLaw {
 public:
  BendLaw() = default;
  /// "law:two_stage", "law:locking", "law:stiffening" (without memory), "law:many_sliders"; else linear.
  BendLaw(const std::string& content, Dice& dice) {
    const auto rise = [](double k, double at, double over) { return 1 / (1 + std::exp(-(k - at) / over)); };
    const double a = dice.uniform(0.25, 0.45), c = dice.uniform(0.25, 0.45), at = dice.log_uniform(0.004, 0.007),
                 then = at * dice.uniform(2.5, 4), over = dice.uniform(0.12, 0.25);
    if (content == "law:two_stage")
      tabulate([=](double k) { return 1 - a * rise(k, at, over * at) - c * rise(k, then, over * then); });
    if (content == "law:locking")
      tabulate([=](double k) { return 1 - 1.6 * a * rise(k, at, over * at) + c * rise(k, then, over * then); });
    if (content == "law:stiffening") tabulate([=](double k) { return 1 + 2 * a * rise(k, 2 * at, over * then); });
    if (content != "law:many_sliders") return;
    const double lost = dice.uniform(0.5, 0.8), power = dice.uniform(-0.4, 0.4);
    double sum = 0;
    for (std::size_t j = 1; j <= most_sliders; ++j) sum += std::pow(j, power);
    for (std::size_t j = 0; j < most_sliders; ++j)
      sliders_.push_back({lost * std::pow(j + 1.0, power) / sum, 0.001 * std::pow(25.0, j / (most_sliders - 1.0))});
  }

  bool linear() const { return curvature_.empty() && sliders_.empty(); }
  /// What explanation.json calls it.
  std::string id() const { return sliders_.empty() ? "law:bending" : "law:bending_hysteresis"; }

  /// Curvature under a moment over EI; `before` was the last one, and is changed.
  double curvature(double moment, double& before, SlidersAt& at) const {
    if (sliders_.empty()) return std::copysign(of_table(moment_, curvature_, std::fabs(moment)), moment);
    double k = before;
    for (int i = 0; i < 40; ++i) {  // Newton's steps on a line in pieces
      double carried = k, slope = 1;
      for (std::size_t j = 0; j < sliders_.size(); ++j) {
        const double off = k - at[j], most = sliders_[j].slips_at;
        carried -= sliders_[j].share * (k - std::clamp(off, -most, most));
        if (std::fabs(off) > most) slope -= sliders_[j].share;
      }
      const double by = (moment - carried) / slope;
      k += by;
      if (std::fabs(by) < 1e-12) break;
    }
    for (std::size_t j = 0; j < sliders_.size(); ++j)
      at[j] = std::clamp(at[j], k - sliders_[j].slips_at, k + sliders_[j].slips_at);
    return before = k;
  }

  /// Moment over EI and curvature, when first bent.
  double secant(double k) const {
    double out = curvature_.empty() ? 1 : of_table(curvature_, moment_, k) / k;
    for (const Slider& s : sliders_) out -= s.share * (1 - std::min(k, s.slips_at) / k);
    return out;
  }

 private:
  struct Slider {
    double share, slips_at;
  };

  void tabulate(const std::function<double(double)>& tangent) {
    constexpr double step = 2e-5;
    curvature_ = {0}, moment_ = {0};
    for (double k = 0; k < 0.4; k += step)
      curvature_.push_back(k + step), moment_.push_back(moment_.back() + step * tangent(k + step / 2));
  }
  static double of_table(const std::vector<double>& from, const std::vector<double>& to, double x) {
    const auto i = static_cast<std::size_t>(std::upper_bound(from.begin() + 1, from.end() - 1, x) - from.begin());
    return to[i - 1] + (to[i] - to[i - 1]) * (x - from[i - 1]) / (from[i] - from[i - 1]);
  }

  std::vector<double> curvature_, moment_;
  std::vector<Slider> sliders_;
};

}  // namespace ostium::synthetic
