#pragma once
/// A script: what an operator does, and until when. Files are data/scripts/NAME.json (schemas/script.schema.json).
///
/// A step moves tools, or waits, until one of its conditions holds. It looks at what an operator or the recording can
/// see; it moves hands, not nodes.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "data/catalogue/script/script_actions.h"
#include "data/catalogue/script/script_conditions.h"
#include "vascular/anatomy/parameters.h"

namespace ostium::data {

struct ScriptCondition {
  ConditionKind kind = ConditionKind::seconds;
  int tool = 0;      ///< of Script::tools
  int lesion = 0;    ///< of the case's, from 0; where `is_about_a_lesion`
  double value = 0;  ///< SI: m, rad, N, N m, s, beats, V, shares
  std::string
      place;  ///< of tip_passes, tip_leaves, tip_in, tip_on, tip_astray, tip_faces, engaged, contrast_in; of trace
  Eigen::Vector3d direction_P = Eigen::Vector3d::Zero();  ///< of tip_points, unit; `value` is the angle
  std::string words;                                      ///< as the file has it, for people: "tip_passes arch"
  bool if_there = false;  ///< of tip_in, tip_leaves, tip_passes: where there is no such place, no tip is in it
  std::string file;       ///< where it stands
  int line = 0;
};

struct ScriptStep {
  ScriptAction action = ScriptAction::wait;
  std::string label;       ///< empty: none
  std::vector<int> tools;  ///< moved together
  double feed_m_s = 0;     ///< along, positive into the patient
  double turn_rad_s = 0;   ///< right-handed about the direction of advance
  std::vector<ScriptCondition> until, unless;
  double timeout_s = 60;
  enum class Otherwise { fail, go_on, jump } otherwise = Otherwise::fail;
  int jump_to = -1;      ///< a step
  int tries = 1;         ///< that it jumps
  int last_resort = -1;  ///< a step; there it jumps once when `tries` are used up, and has as many again. -1: none
  bool detour = false;   ///< only a label leads to it: whatever goes on from before it goes past it
  // view
  std::optional<double> lao_rad, cran_rad, field_m;
  std::optional<Eigen::Vector3d> table_P;
  bool on = false;                                          ///< fluoroscopy, cine
  double rate_1_min = 0;                                    ///< heart_rate
  std::string text;                                         ///< mark
  double rate_m3_s = 0, volume_m3 = 0, iodine_kg_m3 = 350;  ///< inject
  double gauge_Pa = 0, over_s = 0;                          ///< inflate
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;   ///< drug
  int line = 0;                                             ///< where it stands
  std::string words() const;                                ///< "advance", or "advance (label)"
};

struct ScriptTool {
  std::string name, instrument;
  int line = 0;
  /// Instruments of which the operator takes, once the vessel was measured, the widest that fits, or the narrowest if
  /// all are wider: a balloon or stent whose nominal diameter is at most `of_reference` times the healthy artery's
  /// beside lesion `lesion` (of the case's, from 0), or a guide whose width is at most `of_aorta` times the ascending
  /// aorta's; one of the two is 0. Empty: `instrument`, whatever the vessel is like.
  std::vector<std::string> sizes;
  double of_reference = 0, of_aorta = 0;
  int lesion = 0;
};

struct ScriptLandmark {
  std::string name;
  Eigen::Vector3d p_P = Eigen::Vector3d::Zero();
};

struct Script {
  std::string file, name, title;
  std::optional<vascular::Access> access;  ///< it begins there, and is refused on a case with another; none: anywhere
  std::vector<ScriptTool> tools;
  std::vector<ScriptLandmark> landmarks;
  std::vector<ScriptStep> steps;
  std::string source;  ///< the file's text; where other scripts' steps stand in it, with these written out
};

/// A step { "do": "script", "script": "parts/treat" } stands for the steps of that file, looked for from the folder of
/// the file that names it; `with`, `label` and `lesion` beside it say with which tools, under which labels and at which
/// lesion. Throws LoadError with file, line, key, value found and what was expected.
Script read_script(const std::string& file, const std::string& text);
Script load_script(const std::string& file);

/// data/scripts/NAME.json, or the file of that name; throws LoadError with those that there are.
Script find_script(const std::string& name_or_file);
std::vector<Script> load_scripts();

/// Throws LoadError "FILE:LINE: WHAT".
[[noreturn]] void refuse(const ScriptCondition& condition, const std::string& what);

}  // namespace ostium::data
