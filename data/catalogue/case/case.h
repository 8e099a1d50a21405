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

/// A patient's own vessels, as `ostium import` wrote them.
struct ImportedVessels {
  vascular::Anatomy anatomy;
  vascular::Mesh lumen;  ///< patient frame, end-diastole
  /// The lumen's vertices through one beat as given: beat_frames of them, the first being `lumen`'s; empty if none were
  /// given.
  std::vector<std::vector<Eigen::Vector3d>> frames;
};

/// Sets the lumen and its frames from meshes with the same triangles, evenly spaced over one beat; at least four.
void set_frames(std::vector<vascular::Mesh> frames, ImportedVessels& vessels);

/// How somebody looks at the case's lesions, beside the standard views (`ostium views`).
struct CaseView {
  std::string name;
  double lao_deg = 0, cran_deg = 0;  ///< negative: RAO, caudal
};

struct Case {
  std::string name;  ///< the file's name without .json
  std::string title;
  CaseCard card;
  vascular::AnatomyParameters anatomy;              ///< of a generated anatomy
  std::shared_ptr<const ImportedVessels> imported;  ///< or an imported one; null: the anatomy is generated
  std::uint64_t seed = 0;                           ///< of the person; 0: the population mean
  double rate_1_min = 70;                           ///< heart rate
  std::vector<vascular::Lesion> lesions;
  std::vector<CaseView> views;
};

/// Names as files use them, in the order of Access.
const std::vector<std::string>& access_names();

/// Throws LoadError with file, line, key, value found and what was expected. Generates the anatomy to check the
/// lesions: one that does not fit its branch is refused, and the message lists the branches.
Case read_case(const std::string& file, const std::string& text);
/// The same; an imported case has these vessels instead of those in the files that it names, unless null.
Case read_case(const std::string& file, const std::string& text, std::shared_ptr<const ImportedVessels> vessels);
Case load_case(const std::string& file);

/// All cases of data/cases and those imported under a name (`imported_folder`). Imported ones that cannot be read are
/// left out; `unread` gets why.
std::vector<Case> load_cases(std::vector<std::string>* unread = nullptr);

/// By name, or by path: a case file or an imported case's folder. Throws LoadError; for an unknown name it lists the
/// known ones.
Case find_case(const std::string& name);
/// The path of the case's file; `name` as for `find_case`.
std::string case_file(const std::string& name);

/// Where cases imported without a path go: $OSTIUM_CASES, else $XDG_DATA_HOME/ostium/cases, else
/// ~/.local/share/ostium/cases.
std::string imported_folder();

/// Another person with the same disease, plaque of their own; seed 0: the population mean and the plaque as it is. If
/// that person's artery is too short for a lesion, the lesion is put at its end.
Case with_person(const Case& c, std::uint64_t seed);

/// The beating vessels with the case's lesions, generated or imported. Every command makes its patient with this.
vascular::Patient patient_of(const Case& c);
/// The vessels at rest, without lesions.
vascular::Anatomy anatomy_of(const Case& c);

/// A table's heading and line, and everything as JSON (data/schemas/cases.schema.json).
std::string case_heading();
std::string case_line(const Case& c);
std::string case_details(const Case& c);
std::string to_json(const std::vector<Case>& cases);

}  // namespace ostium::data
