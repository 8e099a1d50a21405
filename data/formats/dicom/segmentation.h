#pragma once
/// What is where in an X-ray film: DICOM Segmentation (PS3.3 A.51), written with DCMTK. One bit a pixel, in a frame for
/// each segment of each frame of the film in which it is. As all programs that show one want a plane, that through the
/// isocentre stands for the projection, in a frame of reference whose origin is there.
#include <string>
#include <vector>

#include "data/formats/write_file.h"

namespace ostium::data {

/// A concept of a coding scheme: SCT (SNOMED CT), DCM, or our own, 99OSTIUM.
struct DicomCode {
  std::string value, scheme, meaning;
};

struct DicomSegment {
  std::string label;         ///< UTF-8; beyond 64 bytes it is cut
  DicomCode category, type;  ///< PS3.16, CID 7150 and those that it leads to
  std::string tracking;      ///< the same for the same thing in all files of a study; as `label`
};

/// Where a segment is in a frame.
struct SegmentedFrame {
  int frame = 1;    ///< of the film, counted from 1
  int segment = 1;  ///< counted from 1
  /// Pixels down the columns, one column after the other: so many outside, so many inside, and so on.
  std::vector<long> run_lengths;
};

/// `film`: the file whose frames are segmented, as `write_dicom` wrote it; patient, study and size are its. `software`:
/// the version of what says so. Frames come in the order in which they are given. Throws WriteError;
/// std::invalid_argument for a segment or a frame that is not there, or run lengths of another size.
void write_segmentation(const std::string& file, const std::string& film, const std::string& software,
                        const std::vector<DicomSegment>& segments, const std::vector<SegmentedFrame>& frames);

}  // namespace ostium::data
