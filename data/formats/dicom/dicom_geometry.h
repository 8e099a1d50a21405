#pragma once
/// The geometry of a frame of X-ray angiography, from the tags of its DICOM file (PS3.3 C.8.7.5, XA Positioner, and
/// C.8.7.3, XA Acquisition), read with DCMTK. Pixels are not looked at.
#include <string>

namespace ostium::data {

struct DicomGeometry {
  double primary_deg = 0, secondary_deg = 0;  ///< positioner angles: positive to the patient's left, to the head
  double source_to_detector_mm = 0, source_to_isocentre_mm = 0;
  double pixel_mm = 0;  ///< at the detector, the same along rows and columns
  int columns = 0, rows = 0;
  std::string right_is_to, down_is_to;  ///< of the picture: "LP", letters of the patient's sides; empty: not told
};

/// Throws LoadError naming the tag that is missing or cannot be, or if positioner or table move.
DicomGeometry read_dicom_geometry(const std::string& file);

}  // namespace ostium::data
