#pragma once
/// The electrocardiogram: waves as Gaussians in time about the R wave (McSharry et al., IEEE Trans Biomed Eng
/// 2003;50:289), in six leads, with the effects of ischaemia.
#include <array>

#include "vascular/heart/heart.h"

namespace ostium::vascular {

/// Coronary territories.
enum class Territory { lad, lcx, rca };
inline constexpr int territories = 3;
/// Of the left ventricle's muscle [estimates, from the 17 segments].
inline constexpr double left_share[territories] = {0.45, 0.25, 0.3};
inline constexpr const char* territory_names[territories] = {"LAD", "LCx", "RCA"};

enum class Lead { II, III, aVF, aVL, V2, V5 };
inline constexpr int leads = 6;
inline constexpr const char* lead_names[leads] = {"II", "III", "aVF", "aVL", "V2", "V5"};

/// Lack of supply of each territory: `early` controls the T wave, `late` the ST segment. A closed artery drives them
/// through two equal time constants in series, so that a shift of 0.1 mV appears after 19 s and is gone 20 s after
/// deflation (Griffin 1987: 19 +- 12 s and 20 +- 9 s; about a third of people silent).
struct IschaemiaModel {
  double time_s = 13.8;  ///< time constant of each
  std::array<double, territories> ST_mV = {0.25, 0.25,
                                           0.25};  ///< in the worst lead at full ischaemia; below 0.1: silent
};
/// Another person: a third are silent, the others vary.
IschaemiaModel ischaemia_of(std::uint64_t seed);

struct IschaemiaState {
  std::array<double, territories> early{}, late{};  ///< [0, 1]
};
constexpr auto fields(const IschaemiaState*) {
  return std::tuple{core::field("early", &IschaemiaState::early), core::field("late", &IschaemiaState::late)};
}
/// `supply`: ratio of flow to need per territory; 1 or more is enough.
void step(const IschaemiaModel& model, const std::array<double, territories>& supply, double dt_s, IschaemiaState& s);

/// What of the ventricles' muscle no longer contracts, sets `body`'s losses: dyskinesis 15 s after a closure, function
/// back within 40 s of its end (Am J Cardiol 1987;60:460), by territory (left_share); of the
/// right ventricle the RCA has 0.7 [estimate].
void weaken(const IschaemiaState& ischaemia, CirculationInputs& body);

/// mV. Fluid in the pericardium makes it low; fibrillation and asystole have their own.
std::array<double, leads> ecg(const HeartModel& model, const HeartState& heart, const IschaemiaModel& ischaemia_model,
                              const IschaemiaState& ischaemia);

/// Largest absolute ST shift, mV.
double ST_shift_mV(const IschaemiaModel& model, const IschaemiaState& ischaemia);

}  // namespace ostium::vascular
