#pragma once
/// The current result of treating a lesion, in numbers: the ground truth for signals and metrics. Lesions are counted
/// from 0 in the case's order; the lesion must exist in the model.
#include <optional>
#include <string>

#include "app/session/model/session.h"

namespace ostium::app {

/// Diastasis. A beat moves arteries and shafts relative to each other by millimetres, so positions along an artery are
/// compared only while the heart rests, before the R wave (heart_cycle.cpp).
bool heart_rests(const SessionState& state);

struct LesionNow {
  double mld_m = 0;          ///< smallest diameter of the lumen within the lesion
  double segment_mld_m = 0;  ///< the same including 5 mm on both sides and any stented length
  double reference_m = 0;    ///< diameter of the adjacent healthy artery: mean of 5 mm proximal and distal to it
  double stenosis = 0;       ///< 1 - mld / reference; of the diameter
};
LesionNow lesion_now(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Flow through the muscle beyond the lesion relative to its need, averaged over a beat or two.
double supply_behind_lesion(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Middle of the balloon (between its markers) from the lesion's middle along the artery, m, positive distally; empty
/// if the balloon is not in the lesion's artery.
std::optional<double> balloon_from_lesion_m(const SessionModel& model, const SessionState& state, int lesion = 0,
                                            int tool = -1);

/// How far its markers lie beyond the lesion's ends, m: the one that lies less far; empty as above.
std::optional<double> balloon_beyond_lesion_m(const SessionModel& model, const SessionState& state, int lesion = 0,
                                              int tool = -1);

/// Extent of the stents at the lesion, from its proximal end, m: the stent in its artery that overlaps it most or is
/// nearest, and all that adjoin it without a gap.
struct Stretch {
  double from_m = 0, to_m = 0;
};
std::optional<Stretch> stented(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Middle of one of the session's stents in that artery, from the lesion's middle, m, positive distally; empty if it
/// lies elsewhere or is still on its balloon.
std::optional<double> stent_from_lesion_m(const SessionModel& model, const SessionState& state, int stent,
                                          int lesion = 0);

/// Whether the stents cover the lesion and extend `margin_m` beyond both ends, or as far as the artery goes: a stent
/// need not protrude into the aorta.
bool lesion_is_covered(const SessionModel& model, const SessionState& state, double margin_m, int lesion = 0);

/// Over all lesions: the largest stenosis, and the smallest margin of stents beyond a lesion's end (see `stented`),
/// negative inside; empty while a lesion's artery has no stent.
struct WorstOfLesions {
  double stenosis = 0;
  std::optional<double> margin_m;
};
WorstOfLesions worst_of_lesions(const SessionModel& model, const SessionState& state);

/// No artery is perforated, and every dissection of type C to F is covered by a stent.
bool is_unharmed(const SessionModel& model, const SessionState& state);

/// What it came to for the patient: "alive: 112/70 mmHg, 92 beats a minute, 45 mL round the heart, perforation closed";
/// empty while nothing has happened to them.
std::string patient_words(const SessionState& state);

/// Expansion of these stents as seen by intravascular ultrasound; the worst of them.
struct StentNow {
  double minimal_area_m2 = 0;  ///< inside the stent
  double expansion = 0;        ///< minimal area over the reference area
  double apposed = 0;          ///< share of points lying on the wall (apposed_m of stent_shape.h)
};
std::optional<StentNow> stent_now(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Fractional flow reserve 20 mm beyond the lesion by the `model` method: see ffr_model of flow.h. Takes a millisecond
/// and allocates.
double ffr_behind_lesion(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Largest diameter of the balloon between its markers over the local reference diameter.
double balloon_artery_ratio(const SessionModel& model, const SessionState& state);

}  // namespace ostium::app
