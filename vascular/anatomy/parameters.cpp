#include "vascular/anatomy/parameters.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace ostium::vascular {

namespace {

/// Normal deviates that are the same on every system (std::normal_distribution is not).
class Deviates {
 public:
  explicit Deviates(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) / 9007199254740992.0; }
  /// Standard normal, limited to two standard deviations (Box and Muller).
  double normal() {
    const double z = std::sqrt(-2 * std::log(uniform())) * std::cos(2 * 3.14159265358979323846 * uniform());
    return std::clamp(z, -2.0, 2.0);
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace

AnatomyParameters mean_of(Dominance dominance, Access access) {
  AnatomyParameters p;
  p.dominance = dominance;
  p.access = access;
  if (dominance == Dominance::left) p.lcx_proximal_mm = 4.2, p.rca_proximal_mm = 2.8;
  return p;
}

AnatomyParameters person(std::uint64_t seed, const AnatomyParameters& base) {
  AnatomyParameters p = base;
  if (seed == 0) return p;
  Deviates draw(seed);
  p.heart_scale *= 1 + 0.06 * draw.normal();
  for (int i = 0; i < 3; ++i) p.heart_turn_rad[i] += 0.08 * draw.normal();
  p.course_wander_m = 2e-3;
  p.wander_seed = seed;
  const double count = draw.uniform();
  p.diagonals = count < 0.14 ? 1 : count < 0.76 ? 2 : 3;
  p.ramus = draw.uniform() < 0.2;
  // Sizes of one person's arteries are correlated: half of the variance is common.
  const double common = draw.normal();
  const auto coronary = [&](double& mm, double sd) {
    mm += sd * std::clamp((common + draw.normal()) / std::sqrt(2.0), -2.0, 2.0);
  };
  coronary(p.left_main_mm, 0.5);
  coronary(p.lad_proximal_mm, 0.4);
  coronary(p.lad_distal_mm, 0.25);
  coronary(p.lcx_proximal_mm, 0.5);
  coronary(p.rca_proximal_mm, 0.5);
  p.lad_proximal_mm = std::min(p.lad_proximal_mm, p.left_main_mm - 0.3);
  p.lcx_proximal_mm = std::min(p.lcx_proximal_mm, p.left_main_mm - 0.3);
  p.side_branch_scale *= 1 + 0.1 * std::clamp((common + draw.normal()) / std::sqrt(2.0), -2.0, 2.0);
  // So are the parts of an aorta; beyond 1.5 deviations it would be a different kind of patient.
  const double wide = draw.normal();
  const auto aortic = [&](double& mm, double sd) {
    mm += sd * std::clamp(0.9 * wide + 0.44 * draw.normal(), -1.5, 1.5);
  };
  aortic(p.sinus_mm, 4.6);
  aortic(p.ascending_mm, 4.1);
  aortic(p.arch_mm, 3.7);
  aortic(p.isthmus_mm, 4.0);
  aortic(p.diaphragm_mm, 3.5);
  aortic(p.infrarenal_mm, 2.1);
  aortic(p.common_iliac_mm, 1.2);
  aortic(p.external_iliac_mm, 0.9);
  aortic(p.femoral_mm, 1.4);
  p.arch_height_mm += 6 * draw.normal();
  p.arch_width_mm += 8 * draw.normal();
  return p;
}

}  // namespace ostium::vascular
