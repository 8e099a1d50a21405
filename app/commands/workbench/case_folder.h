#pragma once
/// Where a case that is edited is written.
#include <filesystem>

#include "data/catalogue/case/case_draft.h"

namespace ostium::app {

/// When a file was last written; none: it is not there.
using WrittenAt = std::optional<std::filesystem::file_time_type>;
WrittenAt time_of(const std::string& file);

/// Writes over the files that the draft is of, which must not have been written since `read_at`. Throws LoadError for a
/// case that ships, and if somebody wrote meanwhile; WriteError.
void save(data::CaseDraft& draft, const WrittenAt& read_at);
/// As a case of its own in a new folder: a path, or a name among the imported ones (`ostium cases`). It is there whole
/// or not at all. The draft is that case from then on. Throws LoadError if the folder is there, WriteError.
void save_as(data::CaseDraft& draft, const std::string& name);
/// A copy to be read by another program: the case's file. `folder` is made.
std::string copy_into(const data::CaseDraft& draft, const std::filesystem::path& folder);

/// What the import of that case mended and noted: a JSON list of {words, places: [[x, y, z], ...]}, mm, patient frame.
/// Empty where it is not known.
std::string mends_beside(const std::string& file);

}  // namespace ostium::app
