#pragma once
/// Where a case that is edited is written.
#include <filesystem>
#include <optional>

#include "data/catalogue/case/case_draft.h"

namespace ostium::app {

/// Writes over the files that the draft is of, which must not have been written since `read_at`. Throws LoadError for a
/// case that ships, and if somebody wrote meanwhile; WriteError.
void save(data::CaseDraft& draft, const std::optional<std::filesystem::file_time_type>& read_at);
/// As a case of its own of that name among the imported ones (`ostium cases`): there whole or not at all. The draft is
/// that case from then on. Throws LoadError if there is one, or it ships; WriteError.
void save_as(data::CaseDraft& draft, const std::string& name);
/// A copy to be read by another program: the case's file. `folder` is made.
std::string copy_into(const data::CaseDraft& draft, const std::filesystem::path& folder);

/// What the import of that case mended and noted: a JSON list of {words, places: [[x, y, z], ...]}, mm, patient frame.
/// Empty where it is not known.
std::string mends_beside(const std::string& file);

}  // namespace ostium::app
