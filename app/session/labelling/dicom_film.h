#pragma once
/// The pictures of a run as DICOM: a film of each view, and beside it a segmentation with all that is labelled.
#include <nlohmann/json_fwd.hpp>

#include "app/session/labelling/labels.h"
#include "data/formats/dicom/dicom_runs.h"
#include "data/formats/dicom/segmentation.h"

namespace ostium::app {

class DicomFilm {
 public:
  /// `exposed`: how `picture` was taken.
  void add(fluoro::CineRun exposed, double frames_per_s, const fluoro::Picture& picture, const Labels& labels,
           const fluoro::View& view);
  /// Writes FOLDER/dicom/RUN.dcm and RUN-seg.dcm, of further views RUN-2.dcm and so on. Returns their names below
  /// `folder`: [{"film": ..., "segmentation": ...}]. Throws WriteError.
  nlohmann::ordered_json write(const std::string& folder, const std::string& run_name) const;

 private:
  struct Segmentation {
    std::vector<data::DicomSegment> segments;
    std::vector<data::SegmentedFrame> frames;
  };
  data::DicomRuns films_;
  std::vector<Segmentation> segmentations_;  ///< of each film
};

}  // namespace ostium::app
