#include "vascular/heart/ecg.h"

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "core/base/units.h"
#include "vascular/motion/heart_cycle.h"

namespace ostium::vascular {

namespace {

/// A wave: amplitude in each lead (mV), centre and width (s). [Typical sizes, from memory.]
struct Wave {
  std::array<double, leads> mV;
  double width_s;
};
//                       II     III    aVF    aVL    V2     V5
constexpr Wave P = {{0.12, 0.07, 0.09, 0.04, 0.06, 0.08}, 0.025};
constexpr Wave Q = {{-0.08, -0.05, -0.06, -0.04, 0.15, -0.10}, 0.009};
constexpr Wave R = {{1.00, 0.45, 0.72, 0.40, 0.30, 1.35}, 0.011};
constexpr Wave S = {{-0.18, -0.12, -0.15, -0.08, -1.10, -0.25}, 0.011};
constexpr Wave T = {{0.28, 0.14, 0.21, 0.10, 0.45, 0.32}, 0.045};
constexpr double PR_s = 0.16, Q_s = -0.024, S_s = 0.026, J_s = 0.05;

/// ST shift of each lead relative to the worst one, by territory. [Textbook: anterior, lateral, inferior; reciprocal in
/// aVL.]
constexpr double ST[territories][leads] = {
    {0.0, -0.25, -0.15, 0.35, 1.0, 0.55}, {0.25, 0.15, 0.2, 0.4, -0.6, 1.0}, {0.85, 1.0, 0.95, -0.6, -0.3, 0.1}};

double bump(double t, double width) { return std::exp(-0.5 * t * t / (width * width)); }

double smooth(double a, double b, double t) {
  const double x = std::clamp((t - a) / (b - a), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

}  // namespace

IschaemiaModel ischaemia_of(std::uint64_t seed) {
  IschaemiaModel model;
  if (seed == 0) return model;
  for (int i = 0; i < territories; ++i) {
    const double u = core::uniform(seed, 21, static_cast<std::uint64_t>(i));
    model.ST_mV[static_cast<std::size_t>(i)] = u < 1.0 / 3 ? 0.09 * 3 * u : 0.15 + 0.3 * (u - 1.0 / 3);
  }
  model.time_s *= 0.6 + 0.8 * core::uniform(seed, 22, 0);
  return model;
}

void step(const IschaemiaModel& model, const std::array<double, territories>& supply, double dt_s, IschaemiaState& s) {
  const double share = -std::expm1(-dt_s / model.time_s);
  for (std::size_t i = 0; i < territories; ++i) {
    // Resting myocardium tolerates the loss of a third of its flow.
    const double want = std::clamp((0.67 - supply[i]) / 0.67, 0.0, 1.0);
    s.early[i] += share * (want - s.early[i]);
    s.late[i] += share * (s.early[i] - s.late[i]);
  }
}

void weaken(const IschaemiaState& s, CirculationInputs& body) {
  constexpr double right[territories] = {0.1, 0, 0.7};
  constexpr double all_lost = 0.65;  // of `early`, which a closed artery reaches after a time constant
  body.left_lost = body.right_lost = 0;
  for (std::size_t i = 0; i < territories; ++i) {
    const double lost = smooth(0.1, all_lost, s.early[i]);
    body.left_lost += left_share[i] * lost, body.right_lost += right[i] * lost;
  }
}

namespace {

/// Coarse fibrillation: three sines whose periods have nothing in common.
std::array<double, leads> fibrillating(double t) {
  const double v = 0.4 * std::sin(2 * units::pi * 4.7 * t) + 0.25 * std::sin(2 * units::pi * 5.9 * t + 1) +
                   0.2 * std::sin(2 * units::pi * 3.3 * t + 2);
  std::array<double, leads> out{};
  for (std::size_t k = 0; k < leads; ++k) out[k] = v * std::clamp(R.mV[k], -1.0, 1.0);
  return out;
}

/// A pacemaker's spike before its beat, and what compressions add: the heart moves under the leads [sizes estimated].
double spike_mV(double t) { return 1.5 * bump(t + 0.03, 0.0015); }
double shaken_mV(double compression) { return compression > 0 ? 0.4 * std::sin(2 * units::pi * compression) : 0; }

/// Time to the next P wave of atria that do not lead.
double to_own_P_s(const HeartState& heart) {
  const double cycle_s = 60 / heart.circulation.rate_1_min;
  return cycle_s / 2 - std::fmod(heart.time_s, cycle_s);
}

}  // namespace

std::array<double, leads> ecg(const HeartModel& heart_model, const HeartState& heart, const IschaemiaModel& model,
                              const IschaemiaState& ischaemia) {
  std::array<double, leads> out{};
  if (!beats(heart)) {
    if (heart.rhythm == Rhythm::fibrillation) out = fibrillating(heart.time_s);
    for (double& v : out) v += shaken_mV(heart.compression);
    return out;
  }
  const double rate_1_min = vascular::rate_1_min(heart_model, heart);
  // Low voltage: halved by 250 mL [estimate].
  const double voltage = 1 / (1 + heart.circulation.pericardium_m3 / 250e-6);
  const double t = heart.since_R_s;
  // Time to the next R wave.
  const double left = (heart.next_ectopic ? 0.33 : 1) * (time_at(1, rate_1_min) - time_at(heart.phase, rate_1_min));
  const double T_s = 0.86 * time_at(end_systole, rate_1_min) + 0.03;
  const bool wide = heart.ectopic || heart.paced, apart = heart.rhythm == Rhythm::block || heart.paced;
  const double spread = wide ? 3.2 : 1, coming = heart.next_ectopic ? 3.2 : 1;
  for (std::size_t k = 0; k < leads; ++k) {
    double v = shaken_mV(heart.compression) + (heart.paced ? spike_mV(t) + spike_mV(-left) : 0);
    const double sign = wide ? -0.9 : 1;
    v += Q.mV[k] * (bump(t - Q_s * spread, Q.width_s * spread) + bump(left + Q_s * coming, Q.width_s * coming));
    v += R.mV[k] * sign * bump(t, R.width_s * spread) +
         R.mV[k] * (coming > 1 ? -0.9 : 1) * bump(left, R.width_s * coming);
    v += S.mV[k] * bump(t - S_s * spread, S.width_s * spread);
    if (!heart.next_ectopic) v += P.mV[k] * bump(apart ? to_own_P_s(heart) : left - PR_s, P.width_s);
    double shift = 0, early = 0;
    for (std::size_t i = 0; i < territories; ++i) {
      shift += model.ST_mV[i] * ischaemia.late[i] * ST[i][k];
      early += std::min(1.0, model.ST_mV[i] / 0.25) * ischaemia.early[i] * ST[i][k];
    }
    // T peaks first, then ST follows and lifts it.
    v += (T.mV[k] * (wide ? -1.3 : 1) + 0.25 * early) * bump(t - T_s, T.width_s * (t > T_s ? 0.75 : 1.1));
    v += shift * smooth(J_s - 0.02, J_s, t) * (1 - smooth(T_s, T_s + 0.08, t));
    out[k] = voltage * v;
  }
  return out;
}

double ST_shift_mV(const IschaemiaModel& model, const IschaemiaState& ischaemia) {
  double largest = 0;
  for (std::size_t k = 0; k < leads; ++k) {
    double shift = 0;
    for (std::size_t i = 0; i < territories; ++i) shift += model.ST_mV[i] * ischaemia.late[i] * ST[i][k];
    largest = std::max(largest, std::fabs(shift));
  }
  return largest;
}

}  // namespace ostium::vascular
