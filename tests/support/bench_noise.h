#pragma once
/// Noise of made-up curves: independent and normal, or not as a file declares it.
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/dice.h"

namespace ostium::synthetic {

class NoiseMaker {
 public:
  NoiseMaker(const std::string& content, Dice& dice) : dice_(dice) {
    shared_ = content == "noise:shared", heavy_ = content == "noise:heavy", twice_ = content == "noise:twice";
  }

  /// What the file says of the noise's size, against what it is.
  double declared_share() const { return twice_ ? 0.5 : 1; }

  /// Of one run, variance 1 (heavy: of most samples). Neighbours share what they share over some five samples.
  std::vector<double> run(std::size_t count) {
    std::vector<double> out = independent(count);
    const double rho = 0.75;
    for (std::size_t k = 1; shared_ && k < count; ++k) out[k] = rho * out[k - 1] + std::sqrt(1 - rho * rho) * out[k];
    for (double& e : out)
      if (heavy_ && dice_.uniform(0, 1) < 0.03) e *= 8;
    return out;
  }
  std::vector<double> independent(std::size_t count) {
    std::vector<double> out(count);
    for (double& e : out) e = dice_.normal();
    return out;
  }

 private:
  Dice& dice_;
  bool shared_ = false, heavy_ = false, twice_ = false;
};

}  // namespace ostium::synthetic
