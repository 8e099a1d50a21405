#pragma once
#include <Eigen/Core>
#include <random>

namespace ostium::fluoro::phantom {

/// Reproducible everywhere: the engine is fixed by the standard, library distributions are not.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * (double(engine_()) / 4294967296.0); }
  /// Within the cube of half side 1.
  Eigen::Vector3d vector() {
    const double x = uniform(-1, 1), y = uniform(-1, 1), z = uniform(-1, 1);
    return {x, y, z};
  }

 private:
  std::mt19937 engine_;
};

}  // namespace ostium::fluoro::phantom
