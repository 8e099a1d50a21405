#pragma once
/// The conditions that a step of a script may check, one row each: reader, schema and messages follow from the rows.
/// They are evaluated in app/session/operator/condition_evaluator.cpp, which does not compile while one is missing.
#include <iterator>

#include "core/base/units.h"
#include "data/formats/json/json_type.h"

namespace ostium::data {

enum class ConditionKind {
  tip_passes,
  tip_leaves,
  tip_in,
  tip_on,
  tip_astray,
  tip_points,
  tip_faces,
  tip_drops,
  fed,
  inserted,
  out,
  turned,
  hub_within,
  push_exceeds,
  torque_exceeds,
  wall_force_exceeds,
  tip_force_exceeds,
  seconds,
  beats,
  balloon_at,
  balloon_within,
  balloon_spans,
  distal_marker_at,
  balloon_clear,
  balloon_open,
  balloon_empty,
  engaged,
  trace,
  contrast_in,
  flow_below,
  ST_exceeds,
  act_exceeds,
  stenosis_below,
  stent_beyond,
  unharmed,
  systolic_below,
  systolic_exceeds,
  rate_below,
  rate_exceeds,
  pericardium_below,
  pericardium_exceeds,
  thrombus_below,
  thrombus_exceeds,
  sealed,
  pulseless,
  stopped
};

/// The type of the condition key's value.
enum class ConditionValue {
  number,
  only_true,
  place,          ///< a distance beyond a branch's origin, or a landmark
  branch,         ///< the name of a branch
  ostium,         ///< an artery that leaves the aorta
  contrast,       ///< a point in a coronary artery
  direction,      ///< left, right, head, feet, front, back
  pressure_trace  ///< normal, damped, ...
};

/// What the condition is about, and so what must exist.
enum class ConditionOf { tool, time, patient, lesion };

struct ConditionRow {
  ConditionKind kind;
  const char* key;
  ConditionValue value;
  ConditionOf of;
  double unit;         ///< converts the file's number to SI
  JsonRange range;     ///< allowed numbers, in the file's unit
  const char* beside;  ///< a companion key of `condition_companions`; empty if none
  const char* expected;
};

namespace condition_units {
inline constexpr double none = 1, mm = 1e-3, deg = units::pi / 180, N = 1, mNm = 1e-3, s = 1, percent = 1e-2, mV = 1e-3,
                        mmHg = units::mmHg, mL = units::mL, mm3 = units::mm3;
}

// clang-format off
inline constexpr ConditionRow condition_rows[] = {
    {ConditionKind::tip_passes, "tip_passes", ConditionValue::place, ConditionOf::tool, 0, {}, "if_there",
     "a landmark: the tip is there or beyond, as seen from the access"},
    {ConditionKind::tip_leaves, "tip_leaves", ConditionValue::place, ConditionOf::tool, 0, {}, "if_there",
     "a landmark: the tip is on the near side of it"},
    {ConditionKind::tip_in, "tip_in", ConditionValue::branch, ConditionOf::tool, 0, {}, "if_there",
     "the name of a branch: the tip is in it, or in one that leaves it"},
    {ConditionKind::tip_on, "tip_on", ConditionValue::branch, ConditionOf::tool, 0, {}, "",
     "the name of a branch: the tip is in it, and in none that leaves it"},
    {ConditionKind::tip_astray, "tip_astray", ConditionValue::branch, ConditionOf::tool, 0, {}, "by_mm",
     "the name of a branch: the tip is in one that leaves it, so far as by_mm says"},
    {ConditionKind::tip_points, "tip_points", ConditionValue::direction, ConditionOf::tool, 0, {}, "within_deg",
     "where the tip points"},
    {ConditionKind::tip_faces, "tip_faces", ConditionValue::branch, ConditionOf::tool, 0, {}, "within_deg",
     "the name of a branch: the tip points to the side of the vessel that the branch leaves from"},
    {ConditionKind::tip_drops, "tip_drops_mm", ConditionValue::number, ConditionOf::tool, condition_units::mm, above_zero, "",
     "how far the tip jumps in 0.25 s beyond what the hand moved, in mm, > 0"},
    {ConditionKind::fed, "fed_mm", ConditionValue::number, ConditionOf::tool, condition_units::mm, above_zero, "",
     "length fed or drawn back since the step began, in mm, > 0"},
    {ConditionKind::inserted, "inserted_mm", ConditionValue::number, ConditionOf::tool, condition_units::mm, from_zero, "",
     "length in the body, reached from either side, in mm, >= 0"},
    {ConditionKind::out, "out", ConditionValue::only_true, ConditionOf::tool, 0, {}, "",
     "true: the tool is out of the body"},
    {ConditionKind::turned, "turned_deg", ConditionValue::number, ConditionOf::tool, condition_units::deg, above_zero, "",
     "turn since the step began, either way, in degrees, > 0"},
    {ConditionKind::hub_within, "hub_within_deg", ConditionValue::number, ConditionOf::tool, condition_units::deg, above_zero, "",
     "the hand's turns, one way less the other, add up to no more degrees: the hub is as it was at first, > 0; whole turns count"},
    {ConditionKind::push_exceeds, "push_exceeds_N", ConditionValue::number, ConditionOf::tool, condition_units::N, above_zero, "",
     "push or pull at the hand in N, > 0; forces are felt behind a low pass of 10 Hz"},
    {ConditionKind::torque_exceeds, "torque_exceeds_mNm", ConditionValue::number, ConditionOf::tool, condition_units::mNm, above_zero, "",
     "torque at the hand in mN m, > 0"},
    {ConditionKind::wall_force_exceeds, "wall_force_exceeds_N", ConditionValue::number, ConditionOf::tool, condition_units::N, above_zero, "",
     "sum of the walls' normal forces on the tool in N, > 0"},
    {ConditionKind::tip_force_exceeds, "tip_force_exceeds_N", ConditionValue::number, ConditionOf::tool, condition_units::N, above_zero, "",
     "that on its last 10 mm in N, > 0"},
    {ConditionKind::seconds, "seconds", ConditionValue::number, ConditionOf::time, condition_units::s, above_zero, "",
     "since the step began, > 0"},
    {ConditionKind::beats, "beats", ConditionValue::number, ConditionOf::time, condition_units::none, above_zero, "",
     "of the heart since the step began, > 0"},
    {ConditionKind::balloon_at, "balloon_at_mm", ConditionValue::number, ConditionOf::lesion, condition_units::mm, {}, "",
     "the middle between the markers, from the middle of the lesion, along the artery, in mm, distal is positive: reached "
     "from either side, judged while the heart rests"},
    {ConditionKind::balloon_within, "balloon_within_mm", ConditionValue::number, ConditionOf::lesion, condition_units::mm, above_zero, "",
     "that middle is no farther from the lesion's, either way, in mm, > 0; judged while the heart rests"},
    {ConditionKind::balloon_spans, "balloon_spans_mm", ConditionValue::number, ConditionOf::lesion, condition_units::mm, {}, "",
     "both markers lie so far beyond the lesion's ends, or, if negative, short of them by no more, at this moment of the "
     "beat, in mm"},
    {ConditionKind::distal_marker_at, "distal_marker_at", ConditionValue::branch, ConditionOf::patient, 0, {}, "beyond_mm",
     "the name of a coronary branch: the balloon's distal marker has come, from either side, so far beyond the place where "
     "that leaves its parent; judged while the heart rests"},
    {ConditionKind::balloon_clear, "balloon_clear_of_guide_mm", ConditionValue::number, ConditionOf::patient, condition_units::mm, above_zero, "",
     "its proximal marker is so far out of the guide, or the guide is out of the body, in mm, > 0"},
    {ConditionKind::balloon_open, "balloon_open", ConditionValue::only_true, ConditionOf::patient, 0, {}, "",
     "true: its waist is gone"},
    {ConditionKind::balloon_empty, "balloon_empty", ConditionValue::only_true, ConditionOf::patient, 0, {}, "",
     "true: nothing is seen in the balloon"},
    {ConditionKind::engaged, "engaged", ConditionValue::ostium, ConditionOf::patient, 0, {}, "",
     "an artery that leaves the aorta: the guide's tip is in its ostium"},
    {ConditionKind::trace, "trace", ConditionValue::pressure_trace, ConditionOf::patient, 0, {}, "",
     "what the guide's pressure looked like in the last beat"},
    {ConditionKind::contrast_in, "contrast_in", ConditionValue::contrast, ConditionOf::patient, 0, {}, "",
     "a landmark in a coronary artery: contrast is seen there while the beam is on"},
    {ConditionKind::flow_below, "flow_below_percent", ConditionValue::number, ConditionOf::lesion, condition_units::percent, above_zero, "",
     "of what the muscle behind the lesion needs, > 0"},
    {ConditionKind::ST_exceeds, "ST_exceeds_mV", ConditionValue::number, ConditionOf::patient, condition_units::mV, above_zero, "",
     "largest shift in the leads, > 0"},
    {ConditionKind::act_exceeds, "act_exceeds_s", ConditionValue::number, ConditionOf::patient, condition_units::s, above_zero, "",
     "activated clotting time, > 0"},
    {ConditionKind::stenosis_below, "stenosis_below_percent", ConditionValue::number, ConditionOf::lesion, condition_units::percent, above_zero_to(100), "",
     "of the lesion's diameter, as measured on a film, > 0 and at most 100"},
    {ConditionKind::stent_beyond, "stent_beyond_mm", ConditionValue::number, ConditionOf::lesion, condition_units::mm, above_zero, "",
     "stents cover the lesion without a gap and reach so far beyond it at both ends, in mm, > 0; no farther than the "
     "artery goes"},
    {ConditionKind::unharmed, "unharmed", ConditionValue::only_true, ConditionOf::patient, 0, {}, "",
     "true: no artery is perforated, no dissection of type C to F lies outside a stent"},
    {ConditionKind::systolic_below, "systolic_below_mmHg", ConditionValue::number, ConditionOf::patient, condition_units::mmHg, above_zero, "",
     "the aorta's pressure in the last beat, > 0"},
    {ConditionKind::systolic_exceeds, "systolic_exceeds_mmHg", ConditionValue::number, ConditionOf::patient, condition_units::mmHg, above_zero, "",
     "the aorta's pressure in the last beat, > 0"},
    {ConditionKind::rate_below, "rate_below_1_min", ConditionValue::number, ConditionOf::patient, condition_units::none, above_zero, "",
     "beats a minute, > 0"},
    {ConditionKind::rate_exceeds, "rate_exceeds_1_min", ConditionValue::number, ConditionOf::patient, condition_units::none, above_zero, "",
     "beats a minute, > 0"},
    {ConditionKind::pericardium_below, "pericardium_below_mL", ConditionValue::number, ConditionOf::patient, condition_units::mL, above_zero, "",
     "fluid round the heart, as an echo shows it, in mL, > 0"},
    {ConditionKind::pericardium_exceeds, "pericardium_exceeds_mL", ConditionValue::number, ConditionOf::patient, condition_units::mL, above_zero, "",
     "fluid round the heart, as an echo shows it, in mL, > 0"},
    {ConditionKind::thrombus_below, "thrombus_below_mm3", ConditionValue::number, ConditionOf::patient, condition_units::mm3, above_zero, "",
     "in the coronary arteries, in mm3, > 0"},
    {ConditionKind::thrombus_exceeds, "thrombus_exceeds_mm3", ConditionValue::number, ConditionOf::patient, condition_units::mm3, above_zero, "",
     "in the coronary arteries, in mm3, > 0"},
    {ConditionKind::sealed, "sealed", ConditionValue::only_true, ConditionOf::patient, 0, {}, "",
     "true: no hole leaks more than a film shows, 0.02 mL/s"},
    {ConditionKind::pulseless, "pulseless", ConditionValue::only_true, ConditionOf::patient, 0, {}, "",
     "true: the last beat made no pulse"},
    {ConditionKind::stopped, "stopped", ConditionValue::only_true, ConditionOf::patient, 0, {}, "",
     "true: the heart stands still"}};
// clang-format on

inline constexpr int condition_kinds = static_cast<int>(std::size(condition_rows));

/// The row of a kind.
constexpr const ConditionRow& row_of(ConditionKind kind) {
  for (const ConditionRow& row : condition_rows)
    if (row.kind == kind) return row;
  throw "every kind has a row";
}

/// Checks that each kind has exactly one row.
constexpr bool each_condition_has_a_row() {
  for (int kind = 0; kind < condition_kinds; ++kind) row_of(static_cast<ConditionKind>(kind));
  return true;
}
static_assert(each_condition_has_a_row());

/// A companion key that some conditions take.
struct ConditionCompanion {
  const char* key;
  bool required;  ///< whether those conditions need it
  double unit;    ///< converts the number, which becomes the condition's value; 0: the key is true or false
  JsonRange range;
  const char* expected;  ///< before "; beside ..."
};
inline constexpr ConditionCompanion condition_companions[] = {
    {"by_mm", true, condition_units::mm, above_zero, "how far from the line of that branch, in mm, > 0"},
    {"beyond_mm",
     true,
     condition_units::mm,
     {},
     "how far, along the artery that the balloon lies in, in mm, distal is positive"},
    {"within_deg", true, condition_units::deg, above_zero_to(90), "how exactly, in degrees, > 0 and at most 90"},
    {"if_there", false, 0, {}, "true or false, true: where the vessel has no such place, no tip is in it"}};

inline constexpr const char* direction_names[] = {"left", "right", "head", "feet", "front", "back"};
inline constexpr const char* trace_names[] = {"normal", "damped", "ventricularised", "ventricle", "absent"};

/// Whether the condition needs arteries and a lesion, as treatment does.
constexpr bool needs_patient(ConditionKind kind) {
  return row_of(kind).of == ConditionOf::patient || row_of(kind).of == ConditionOf::lesion;
}

/// Whether the condition is about one of the case's lesions.
constexpr bool is_about_a_lesion(ConditionKind kind) { return row_of(kind).of == ConditionOf::lesion; }

}  // namespace ostium::data
