#pragma once
/// A film as DICOM, whose header is one for all frames: each change of view, field or programme begins a new run, and
/// each run is a file of its own, a series of the film's one study. What one file cannot hold goes on in the next.
#include <string>
#include <vector>

#include "data/formats/dicom/dicom.h"

namespace ostium::data {

class DicomRuns {
 public:
  /// `most_bytes`: of a file's pixels.
  explicit DicomRuns(std::uint64_t most_bytes = dicom_most_bytes) : most_bytes_(most_bytes) {}
  /// `exposed`: how `picture` was taken; its frames are not looked at.
  void add(const fluoro::CineRun& exposed, const fluoro::Picture& picture);
  /// Writes FILE.dcm, and FILE-2.dcm, ... for further runs. Returns the names. Throws WriteError: then none of them is
  /// there, or what was.
  std::vector<std::string> write(const std::string& file, const DicomPatient& patient = {}) const;
  const std::vector<fluoro::CineRun>& runs() const { return runs_; }

 private:
  std::uint64_t most_bytes_;
  std::vector<fluoro::CineRun> runs_;
};

}  // namespace ostium::data
