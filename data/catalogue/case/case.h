#pragma once
/// A case: a patient to rehearse on.
#include <memory>
#include <string>
#include <vector>

#include "vascular/patient/patient.h"

namespace ostium::data {

/// What the operator is told before the procedure.
struct CaseCard {
  std::string history, ecg, planned_access;
};

/// Someone's own vessels, as `ostium import` wrote them.
struct ImportedVessels {
  vascular::Anatomy anatomy;
  vascular::Mesh lumen;  ///< patient frame, end-diastole
  /// Its vertices through one beat as they were given, beat_frames of them, the first `lumen`'s; empty: they were not.
  std::vector<std::vector<Eigen::Vector3d>> frames;
};

/// The lumen of someone's vessels, and its frames, from meshes of the same triangles at even spaces of one beat, at
/// least four.
void set_frames(std::vector<vascular::Mesh> frames, ImportedVessels& vessels);

struct Case {
  std::string name;  ///< the file's name without .json
  std::string title;
  CaseCard card;
  vascular::AnatomyParameters anatomy;              ///< of a built anatomy
  std::shared_ptr<const ImportedVessels> imported;  ///< or these; null: the anatomy is built
  std::uint64_t seed = 0;                           ///< of the person; 0: the mean
  double rate_1_min = 70;                           ///< heart beats
  std::vector<vascular::Lesion> lesions;
};

/// As files say them, in Access' order.
const std::vector<std::string>& access_names();

/// Throws LoadError with file, line, key, value found and what was expected. The anatomy is built for that: a lesion
/// that does not fit its branch is refused with what exists.
Case read_case(const std::string& file, const std::string& text);
Case load_case(const std::string& file);

/// All of data/cases; with those that were imported under a name (`imported_folder`).
std::vector<Case> load_cases();

/// By name; or by a path: a case file, or an imported case's folder. Throws LoadError, for a name that is none with
/// those that are.
Case find_case(const std::string& name);
/// Its file, found in the same way.
std::string case_file(const std::string& name);

/// Where imported cases without a path go: $OSTIUM_CASES, else $XDG_DATA_HOME/ostium/cases, else
/// ~/.local/share/ostium/cases.
std::string imported_folder();

/// Another person with the same disease; 0: the mean. A lesion that would reach beyond an artery that is shorter in
/// them lies at its end.
Case with_person(const Case& c, std::uint64_t seed);

/// The vessels, beating, with the case's lesions: built, or as they were imported. Every command makes its patient
/// here.
vascular::Patient patient_of(const Case& c);
/// The vessels at rest, without lesions.
vascular::Anatomy anatomy_of(const Case& c);

/// A table's line, and everything as JSON (data/schemas/cases.schema.json).
std::string case_heading();
std::string case_line(const Case& c);
std::string case_details(const Case& c);
std::string to_json(const std::vector<Case>& cases);

}  // namespace ostium::data
