#pragma once
/// Sets of curves with one thing in them that their file does not declare, made by solvers that share nothing with
/// core or data/identification. A set is determined by kind, what is in it, its size, and seed.
#include <functional>
#include <string>
#include <vector>

namespace ostium::synthetic {

struct BenchSet {
  std::string json;                  ///< measurement.json
  std::vector<std::string> effects;  ///< ids that would be right; empty: the right verdict is "explained"
  /// The true law, of x and in units as in explanation.json, if what is in it is a law that no effect has.
  std::function<double(double)> law;
};

struct BenchKind {
  std::string name;
  std::vector<std::string> contents;  ///< "clean", ids of effects, "fault:...", "noise:..."
  /// `size`: root mean square of what is undeclared, in units of the noise, after the declared fit has had its say.
  BenchSet (*make)(const std::string& content, double size, unsigned seed);
};

const std::vector<BenchKind>& bench_kinds();

}  // namespace ostium::synthetic
