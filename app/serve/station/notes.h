#pragma once
/// What a trainer notes of a run, in a folder's notes.json.
#include <string>
#include <vector>

namespace ostium::app {

struct Note {
  std::string recording;  ///< in which it was made: "run.h5", "branch-2.h5"
  double second = 0;
  std::string text;
};

/// Those of the folder; none, if there is no such file. Throws LoadError if it is not as it was written.
std::vector<Note> read_notes(const std::string& folder);
/// All of them; without any there is no file. Throws WriteError.
void write_notes(const std::string& folder, const std::vector<Note>& notes);

}  // namespace ostium::app
