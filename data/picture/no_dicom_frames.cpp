/// In a build without DCMTK.
#include "data/formats/load_error.h"
#include "data/picture/frames_file.h"

namespace ostium::data {

FramesFile read_dicom_frames(const std::string& file) {
  throw LoadError(file + ": this build reads no DICOM; expected PNG, or a build with OSTIUM_DICOM");
}

}  // namespace ostium::data
