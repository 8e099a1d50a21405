#pragma once
/// What an import made of somebody's meshes, and where it goes: the case's files, the report, the picture.
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line/mesh_unit.h"
#include "app/commands/import/file_axes.h"
#include "data/catalogue/case/case.h"
#include "vascular/anatomy/labelling/labelling.h"
#include "vascular/anatomy/labelling/narrowings.h"
#include "vascular/geometry/repair/repair.h"

namespace ostium::app {

struct Imported {
  std::filesystem::path folder;                                      ///< of the case
  std::optional<std::filesystem::file_time_type> folder_written_at;  ///< as the import began
  std::vector<std::string> files;                                    ///< as they were given
  int triangles = 0, skipped = 0;                                    ///< read; points and lines that were left out
  MeshUnit unit;
  FileAxes axes;
  vascular::RepairedMesh repaired;     ///< in the files' frame, m
  vascular::LabelledVessels found;     ///< in the patient frame
  std::vector<vascular::Mesh> frames;  ///< of a beat, in the patient frame; empty: one surface, at rest
  data::Case the_case;
  vascular::Patient patient;
  std::vector<vascular::FoundNarrowing> narrowings;  ///< of coronary arteries
};

/// Whether a tube is a coronary artery, or a branch of one.
bool is_coronary(const vascular::Anatomy& anatomy, int tube);

/// import.json.
nlohmann::ordered_json report_of(const Imported& imported);
/// The same for a person, on stdout; `called`: what `ostium cases` knows the case by.
void tell(const Imported& imported, const std::string& called);

/// Throws LoadError unless the folder is not there, or holds at most what an import of that name writes: the rest would
/// be lost when it is renewed.
void require_new_or_case(const std::filesystem::path& folder, const std::string& name);
/// When a folder was last written into; none where it is not there.
std::optional<std::filesystem::file_time_type> written_at(const std::filesystem::path& folder);
/// Writes the case beside its place and moves it there when it is whole, so that it is there whole or not at all;
/// `picture`: a file, or empty. Throws LoadError, also if somebody else wrote there since the import began; WriteError.
void write_case(const Imported& imported, const nlohmann::ordered_json& report, const std::string& picture);

void draw(const Imported& imported, const std::string& file);

}  // namespace ostium::app
