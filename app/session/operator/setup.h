#pragma once
/// The complete description of a run as texts: enough to repeat it on another machine and with other data.
#include <optional>
#include <string>
#include <vector>

#include "app/session/operator/operator.h"

namespace ostium::app {

struct RunSetup {
  std::string vessel;                      ///< a case's name, or a mesh file
  std::string case_text;                   ///< the case's file
  std::string shape;                       ///< a number made of a mesh, or of an imported case's vessels; else empty
  std::optional<std::uint64_t> person;     ///< overrides the case's own
  std::optional<double> rate_1_min;        ///< overrides the case's own
  std::optional<vascular::Access> access;  ///< of a generated case
  vascular::Mesh mesh;                     ///< the mesh, m
  MeshEntry entry;
  data::Script script;
  std::vector<std::string> tool_texts;  ///< the instrument's file, for each of the script's tools
  std::vector<std::string> tool_files;  ///< and its name
  std::vector<std::string> drug_texts;  ///< the catalogue's drugs
  std::vector<std::string> drug_files;  ///< and their names
  std::uint64_t seed = 0;
  double hand_speed = 1;           ///< factor on the script's speeds; (0, 10]
  double breaths_1_min = 0;        ///< for a case's patient; 0: the breath is held
  bool arteries_yield = false;     ///< a case's coronary arteries give way to what presses on them
  std::optional<double> friction;  ///< of the vessel's wall, overrides vessel_friction; [0, 1]

  std::string stuck;  ///< name of a tool with a failed drive: the hand moves but the tool does not; empty: none
  std::string begin;  ///< an artery: the introducer is placed before its ostium (entry_ahead_of); empty: at the access

  bool is_mesh() const { return case_text.empty(); }
};

/// A file with the ending of a mesh (mesh_endings) is one; otherwise a case name or a file NAME.json. Throws LoadError
/// or MeshError.
void set_vessel(const std::string& case_or_mesh, vascular::LengthUnit unit, RunSetup& setup);
/// Sets the script and finds its instruments. Call after set_vessel. Throws LoadError if the case has another access.
void set_script(const data::Script& script, RunSetup& setup);
/// For tools given in several sizes, chooses the one that fits the artery at its lesion, or the aorta; without lesion
/// or aorta the default stays. Call before the session is made. Returns the choices: "stent: Stent 3.0 x 18 mm, ...".
/// Throws LoadError for a size that cannot be measured this way, and for a missing lesion.
std::vector<std::string> choose_sizes(const Vessel& vessel, RunSetup& setup);
/// Overrides one value: a tool's instrument (of the catalogue, or a file), or one of `person`, `heart_rate`,
/// `breathing`, `arteries`, `hand_speed`, `friction`, `begin`, `stuck`. Call after set_script. The tool is then no
/// longer chosen by size. Throws LoadError listing the valid keys or values.
void set_value(const std::string& key, const std::string& value, RunSetup& setup);

/// Throws LoadError where an imported case has other vessels by now than `setup` was made with.
std::shared_ptr<const Vessel> make_vessel(const RunSetup& setup, std::string& warnings);
/// The vessel must have been made from this setup.
SessionModel make_session(const RunSetup& setup, std::shared_ptr<const Vessel> vessel);

/// To JSON, without the mesh, and back.
std::string to_json(const RunSetup& setup);
RunSetup setup_from_json(const std::string& file, const std::string& text);

}  // namespace ostium::app
