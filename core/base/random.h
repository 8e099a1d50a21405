#pragma once
/// Uniform random numbers from a seed and a counter; the only state is how many were drawn.
#include <cstdint>

namespace ostium::core {

/// In [0, 1), from splitmix64 (Steele, Lea, Flood 2014).
inline double uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t count) {
  std::uint64_t z = seed * 0x9e3779b97f4a7c15u + stream * 0xd1342543de82ef95u + (count + 1) * 0x9e3779b97f4a7c15u;
  for (int round = 0; round < 2; ++round) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) * 0x1p-53;
}

}  // namespace ostium::core
