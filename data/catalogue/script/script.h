#pragma once
/// A script: what an operator does, and until when. Files: data/scripts/NAME.json (schemas/script.schema.json).
///
/// A step moves tools, or waits, until one of its conditions holds. Conditions look only at what an operator or the
/// recording can see; motion is applied at the hub, never to nodes.
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
  int tool = 0;      ///< index into Script::tools
  int lesion = 0;    ///< index of the case's lesion, from 0; used if `is_about_a_lesion`
  double value = 0;  ///< SI: m, rad, N, N m, s, beats, V, shares
  std::string
      place;  ///< of tip_passes, tip_leaves, tip_in, tip_on, tip_astray, tip_faces, engaged, contrast_in; of trace
  Eigen::Vector3d direction_P = Eigen::Vector3d::Zero();  ///< for tip_points, unit vector; `value` is the angle
  std::string words;                                      ///< as written in the file, for messages: "tip_passes arch"
  bool if_there = false;  ///< of tip_in, tip_leaves, tip_passes: a missing place holds no tip
  std::string file;       ///< file and line of the condition
  int line = 0;
};

struct ScriptStep {
  ScriptAction action = ScriptAction::wait;
  std::string label;       ///< empty if it has none
  std::vector<int> tools;  ///< tools moved together
  double feed_m_s = 0;     ///< positive into the patient
  double turn_rad_s = 0;   ///< right-handed about the direction of advance
  std::vector<ScriptCondition> until, unless;
  double timeout_s = 60;
  enum class Otherwise { fail, go_on, jump } otherwise = Otherwise::fail;
  int jump_to = -1;      ///< index of a step
  int tries = 1;         ///< how often it may jump
  int last_resort = -1;  ///< a step to jump to once `tries` are used up; the tries then start again. -1: none
  bool detour = false;   ///< reached only by its label; steps before it that go on skip it
  // view
  std::optional<double> lao_rad, cran_rad, field_m;
  std::optional<Eigen::Vector3d> table_P;
  bool on = false;                                          ///< fluoroscopy, cine
  double rate_1_min = 0;                                    ///< heart_rate
  std::string text;                                         ///< mark
  double rate_m3_s = 0, volume_m3 = 0, iodine_kg_m3 = 350;  ///< inject
  double gauge_Pa = 0, over_s = 0;                          ///< inflate
  double heparin_U = 0, nitrate_ug = 0, adenosine_ug = 0;   ///< drug
  std::string drug, dose_unit;                              ///< give
  double dose = 0;                                          ///< give, in that unit
  double energy_J = 0;                                      ///< shock
  int breath_asked = 0;                                     ///< breathe: vascular::BreathAsked
  double current_mA = 0;                                    ///< pace
  int complication = 0;                                     ///< provoke: vascular::Provoked
  std::string at;                                           ///< provoke: a place in a coronary artery
  double size = 0;                                          ///< provoke: vascular::Provocation::size
  int line = 0;                                             ///< line in the file
  std::string words() const;                                ///< "advance", or "advance (label)"
};

struct ScriptTool {
  std::string name, instrument;
  int line = 0;
  /// If not empty, the operator measures the vessel and takes the widest of these instruments that fits, or the
  /// narrowest if all are too wide. A balloon or stent fits if its nominal diameter is at most `of_reference` times the
  /// healthy artery's beside lesion `lesion` (index in the case, from 0); a guide if its width is at most `of_aorta`
  /// times the ascending aorta's. One of the two factors is 0. Empty: `instrument`, whatever the vessel.
  std::vector<std::string> sizes;
  double of_reference = 0, of_aorta = 0;
  int lesion = 0;
  std::string over;  ///< of several wires that go through it, the tool that it runs over; empty: there is one
};

struct ScriptLandmark {
  std::string name;
  Eigen::Vector3d p_P = Eigen::Vector3d::Zero();
  int line = 0;
};

struct Script {
  std::string file, name, title;
  std::optional<vascular::Access> access;  ///< where it begins; cases with another access are refused. None: any
  std::vector<std::string> lesions_in;     ///< arteries in each of which it treats a lesion
  std::vector<ScriptTool> tools;
  std::vector<ScriptLandmark> landmarks;
  std::vector<ScriptStep> steps;
  bool by_hand = false;  ///< people move the instruments: no step has to be done, and they end the run
  std::string source;    ///< the file's text, with the steps of other scripts written out
  /// The step after `s`, skipping detours unless `s` is one itself; the count of steps: the end.
  std::size_t after(std::size_t s) const;
};

/// A step { "do": "script", "script": "parts/treat" } stands for the steps of that file, whose path is relative to the
/// file that names it; `with`, `label` and `lesion` give the tools, the prefix of the labels and the lesion. Throws
/// LoadError with file, line, key, value found and what was expected.
Script read_script(const std::string& file, const std::string& text);
Script load_script(const std::string& file);

/// data/scripts/NAME.json, or the file of that name; throws LoadError listing the scripts there are.
Script find_script(const std::string& name_or_file);
std::vector<Script> load_scripts();

/// Throws LoadError naming both if the script is for another access than the case; `of_case` none: any will do.
void require_access(const Script& script, std::optional<vascular::Access> of_case, const std::string& case_name);

/// Throws LoadError "FILE:LINE: WHAT".
[[noreturn]] void refuse(const ScriptCondition& condition, const std::string& what);

}  // namespace ostium::data
