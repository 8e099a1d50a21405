#pragma once
/// What a run is of, in texts: enough to make it again, on another machine and with other data at hand.
#include <optional>
#include <string>
#include <vector>

#include "app/session/operator/operator.h"

namespace ostium::app {

struct RunSetup {
  std::string vessel;                      ///< a case's name, or a mesh's file
  std::string case_text;                   ///< of a case: its file
  std::optional<std::uint64_t> person;     ///< instead of the case's own
  std::optional<double> rate_1_min;        ///< instead of the case's own
  std::optional<vascular::Access> access;  ///< of a case that is built
  vascular::Mesh mesh;                     ///< of a mesh, m
  MeshEntry entry;
  data::Script script;
  std::vector<std::string> tool_texts;  ///< of each of the script's tools: the instrument's file
  std::vector<std::string> tool_files;  ///< and its name
  std::uint64_t seed = 0;
  double hand_speed = 1;           ///< times what the script says; (0, 10]
  double breaths_1_min = 0;        ///< of a case's patient; 0: the breath is held
  std::optional<double> friction;  ///< of the vessel's wall, instead of vessel_friction; [0, 1]

  std::string stuck;  ///< a tool whose drive is out: the hand moves, the tool stays; empty: none
  std::string begin;  ///< an artery: the introducer is ahead of its ostium (entry_ahead_of); empty: the access

  bool is_mesh() const { return case_text.empty(); }
};

/// A file ending in .obj, .stl or .ply is a mesh; else a case by name, or a file NAME.json. Throws LoadError,
/// MeshError.
void set_vessel(const std::string& case_or_mesh, vascular::LengthUnit unit, RunSetup& setup);
/// Takes the script and finds its instruments. After set_vessel. Throws LoadError if the case has another access.
void set_script(const data::Script& script, RunSetup& setup);
/// For tools of the script that come in sizes, takes what fits the artery at its lesion, or the aorta; where there is
/// no lesion, or no aorta, it stays as it is. Before the session is made. Returns what was chosen: "stent: Stent 3.0 x
/// 18 mm, ...". Throws LoadError for a size that cannot be measured so, and for a lesion that there is not.
std::vector<std::string> choose_sizes(const Vessel& vessel, RunSetup& setup);
/// One thing otherwise: a tool's instrument (of the catalogue, or a file), or one of `person`, `heart_rate`,
/// `breathing`, `hand_speed`, `friction`, `begin`, `stuck`. After set_script. A tool's is no longer chosen by size.
/// Throws LoadError with what there is.
void set_value(const std::string& key, const std::string& value, RunSetup& setup);

std::shared_ptr<const Vessel> make_vessel(const RunSetup& setup, std::string& warnings);
/// From a vessel that was made of this setup.
SessionModel make_session(const RunSetup& setup, std::shared_ptr<const Vessel> vessel);

/// As JSON, without the mesh; and back.
std::string to_json(const RunSetup& setup);
RunSetup setup_from_json(const std::string& file, const std::string& text);

}  // namespace ostium::app
