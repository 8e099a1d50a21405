#pragma once
/// Random numbers for synthetic sets.
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <string>

#include "core/base/units.h"

namespace ostium::synthetic {

/// The same numbers with every library.
class Dice {
 public:
  Dice(const std::string& kind, unsigned seed) {
    unsigned hash = 2166136261u;  // FNV-1a
    for (char c : kind) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    random_.seed(hash ^ (seed * 2654435761u));
  }
  double uniform(double from, double to) { return from + (to - from) * (random_() + 0.5) / 4294967296.0; }
  double log_uniform(double from, double to) { return std::exp(uniform(std::log(from), std::log(to))); }
  double sign() { return random_() & 1u ? 1 : -1; }
  double either(double from, double to) { return sign() * uniform(from, to); }
  int whole(int from, int to) { return from + static_cast<int>(random_() % static_cast<unsigned>(to - from + 1)); }
  double normal() {
    const double u = uniform(0, 1), v = uniform(0, 1);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * units::pi * v);
  }
  Eigen::Vector3d normals() {
    const double x = normal(), y = normal(), z = normal();
    return {x, y, z};
  }
  Eigen::Vector3d direction() { return normals().normalized(); }

 private:
  std::mt19937 random_;
};

}  // namespace ostium::synthetic
