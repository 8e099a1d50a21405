#pragma once
/// What was done to a lesion of the case, in numbers, at a moment: the truth that signals and metrics are made of.
/// Lesions are counted from 0 in the case's order; the model must have the one that is asked for.
#include <optional>

#include "app/session/model/session.h"

namespace ostium::app {

/// Diastasis: a beat carries arteries and shafts past each other by millimetres, so places along an artery are compared
/// while the heart rests, before the R wave (heart_cycle.cpp).
bool heart_rests(const SessionState& state);

struct LesionNow {
  double mld_m = 0;          ///< smallest diameter of the lumen within the lesion
  double segment_mld_m = 0;  ///< the same with 5 mm on both sides and whatever a stent covers
  double reference_m = 0;    ///< of the healthy artery about it: mean of 5 mm ahead of it and behind it
  double stenosis = 0;       ///< 1 - mld / reference; of the diameter
};
LesionNow lesion_now(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Flow through the muscle behind the lesion over what it needs, averaged over a beat or two.
double supply_behind_lesion(const SessionModel& model, const SessionState& state, int lesion = 0);

/// The middle between the balloon's markers, from the lesion's middle along the artery, m, distal is positive; empty if
/// the balloon does not lie in the lesion's artery.
std::optional<double> balloon_from_lesion_m(const SessionModel& model, const SessionState& state, int lesion = 0);

/// First and last point of the stents at the lesion, from its proximal end, m: of the one in its artery that covers
/// most of it, or is nearest, and of all that are joined to that one without a gap.
struct Stretch {
  double from_m = 0, to_m = 0;
};
std::optional<Stretch> stented(const SessionModel& model, const SessionState& state, int lesion = 0);

/// The middle of one of the session's stents that lies in that artery, from the lesion's middle, m, distal is positive;
/// empty if it lies elsewhere, or is still on its balloon.
std::optional<double> stent_from_lesion_m(const SessionModel& model, const SessionState& state, int stent,
                                          int lesion = 0);

/// Whether they cover the lesion and reach `margin_m` beyond it at both ends, or as far as the artery goes: a stent
/// need not stand out into the aorta.
bool lesion_is_covered(const SessionModel& model, const SessionState& state, double margin_m, int lesion = 0);

/// Of all lesions: the largest stenosis, and the least that stents reach beyond a lesion at either end, as `stented`
/// has it, negative inside; empty while there is a lesion in whose artery there is none.
struct WorstOfLesions {
  double stenosis = 0;
  std::optional<double> margin_m;
};
WorstOfLesions worst_of_lesions(const SessionModel& model, const SessionState& state);

/// No artery is perforated, and every dissection of type C to F lies under a stent.
bool is_unharmed(const SessionModel& model, const SessionState& state);

/// How well the same stents are open, as intravascular ultrasound would have it: the worst of them.
struct StentNow {
  double minimal_area_m2 = 0;  ///< inside
  double expansion = 0;        ///< that over the reference's area
  double apposed = 0;          ///< share of points that lie on the wall (apposed_m of stent_shape.h)
};
std::optional<StentNow> stent_now(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Fractional flow reserve 20 mm behind the lesion, named `model`: see ffr_model of flow.h. Takes a millisecond and
/// allocates.
double ffr_behind_lesion(const SessionModel& model, const SessionState& state, int lesion = 0);

/// Diameter of the balloon where it is widest between its markers over the local reference.
double balloon_artery_ratio(const SessionModel& model, const SessionState& state);

}  // namespace ostium::app
