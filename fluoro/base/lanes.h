#pragma once
/// Eight pixels at a time.
#include <cstdint>
#include <cstring>

namespace ostium::fluoro {

inline constexpr int lanes = 8;
using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
inline constexpr Ints counting_ints{0, 1, 2, 3, 4, 5, 6, 7};
inline constexpr Floats counting{0, 1, 2, 3, 4, 5, 6, 7};

/// The first `count` lanes, the others 0. Only the last of a row are fewer, so that a copy of a known size is the rule.
inline Floats load(const float* from, int count = lanes) {
  Floats out{};
  if (count >= lanes)
    std::memcpy(&out, from, sizeof out);
  else
    for (int i = 0; i < count; ++i) out[i] = from[i];
  return out;
}
inline void store(const Floats& value, float* to, int count = lanes) {
  if (count >= lanes)
    std::memcpy(to, &value, sizeof value);
  else
    for (int i = 0; i < count; ++i) to[i] = value[i];
}
inline Ints load(const std::int32_t* from) {
  Ints out;
  std::memcpy(&out, from, sizeof out);
  return out;
}
inline void store(const Ints& value, std::int32_t* to) { std::memcpy(to, &value, sizeof value); }

inline Floats all(float value) { return Floats{} + value; }
/// Of what is no number, the second.
inline Floats least(const Floats& a, const Floats& b) { return a < b ? a : b; }
inline Floats most(const Floats& a, const Floats& b) { return a > b ? a : b; }
inline Floats to_floats(const Ints& a) { return __builtin_convertvector(a, Floats); }
inline Ints truncated(const Floats& a) { return __builtin_convertvector(a, Ints); }

/// e^x to 3e-7 and as much as x is rounded by; from x = -87 down, what it is there.
inline Floats exponential(const Floats& x) {
  const Floats by_two = most(all(-126), least(all(126), 1.44269504f * x));
  constexpr float to_whole = 12582912;  // 1.5 2^23: what is added to it is rounded to a whole number
  const Floats whole = (by_two + to_whole) - to_whole, f = by_two - whole;
  const Floats power =
      1.00000007f + f * (0.69314695f + f * (0.24022122f + f * (0.05550743f + f * (0.00967546f + f * 0.0013267f))));
  const Ints exponent = (truncated(whole) + 127) << 23;
  Floats scale;
  std::memcpy(&scale, &exponent, sizeof scale);
  return scale * power;
}

/// ln x to 1e-7 or two units in the last place, for a normal x above 0.
inline Floats logarithm(const Floats& x) {
  Ints bits;
  std::memcpy(&bits, &x, sizeof bits);
  constexpr std::int32_t root_of_half = 0x3f3504f3;
  const Ints exponent = (bits - root_of_half) >> 23, mantissa = bits - (exponent << 23);
  Floats m;  // from sqrt(1/2) to sqrt(2)
  std::memcpy(&m, &mantissa, sizeof m);
  const Floats s = (m - 1) / (m + 1), q = s * s;  // ln m = 2 artanh s
  return 0.69314718f * to_floats(exponent) +
         2 * s * (1 + q * (1 / 3.0f + q * (1 / 5.0f + q * (1 / 7.0f + q * (1 / 9.0f)))));
}

}  // namespace ostium::fluoro
