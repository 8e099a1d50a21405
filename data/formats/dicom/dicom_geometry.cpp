#include "data/formats/dicom/dicom_geometry.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "data/formats/load_error.h"
#include "data/formats/read_file.h"

namespace ostium::data {

namespace {

class TagReader {
 public:
  explicit TagReader(const std::string& file) : file_(file) {
    require_file(file, "a DICOM file");
    const OFCondition read = format_.loadFile(file.c_str(), EXS_Unknown, EGL_noChange, 64, ERM_fileOnly);
    if (read.bad()) throw LoadError(fmt::format("{} is not a DICOM file: {}", file, read.text()));
  }

  double number(const DcmTagKey& key, const char* name, unsigned long which = 0) const {
    OFString text;
    Float64 value = 0;
    if (dataset().findAndGetFloat64(key, value, which).good() && std::isfinite(value)) return value;
    throw LoadError(fmt::format("{}: {} {} is missing or not a number; write the view's geometry into the set instead",
                                file_, key.toString().c_str(), name));
  }
  double positive(const DcmTagKey& key, const char* name, unsigned long which = 0) const {
    const double value = number(key, name, which);
    if (value > 0) return value;
    throw LoadError(fmt::format("{}: {} {} is {}; expected a number > 0", file_, key.toString().c_str(), name, value));
  }
  int pixels(const DcmTagKey& key, const char* name) const {
    Uint16 value = 0;
    if (dataset().findAndGetUint16(key, value).good() && value > 1) return value;
    throw LoadError(fmt::format("{}: {} {} is missing", file_, key.toString().c_str(), name));
  }
  std::string text(const DcmTagKey& key) const {
    OFString value;
    return dataset().findAndGetOFString(key, value).good() ? value.c_str() : "";
  }

 private:
  // DCMTK finds tags only in what is not const.
  DcmDataset& dataset() const { return *const_cast<DcmFileFormat&>(format_).getDataset(); }
  std::string file_;
  DcmFileFormat format_;
};

}  // namespace

DicomGeometry read_dicom_geometry(const std::string& file) {
  const TagReader tags(file);
  if (tags.text(DCM_PositionerMotion) == "DYNAMIC")
    throw LoadError(file + ": (0018,1500) PositionerMotion is DYNAMIC; expected a run whose C-arm stands still");
  DicomGeometry out;
  out.primary_deg = tags.number(DCM_PositionerPrimaryAngle, "PositionerPrimaryAngle");
  out.secondary_deg = tags.number(DCM_PositionerSecondaryAngle, "PositionerSecondaryAngle");
  out.source_to_detector_mm = tags.positive(DCM_DistanceSourceToDetector, "DistanceSourceToDetector");
  out.source_to_isocentre_mm = tags.positive(DCM_DistanceSourceToPatient, "DistanceSourceToPatient");
  out.pixel_mm = tags.positive(DCM_ImagerPixelSpacing, "ImagerPixelSpacing", 1);
  const double row_mm = tags.positive(DCM_ImagerPixelSpacing, "ImagerPixelSpacing", 0);
  if (std::fabs(row_mm - out.pixel_mm) > 1e-3 * out.pixel_mm)
    throw LoadError(fmt::format("{}: (0018,1164) ImagerPixelSpacing is {} and {}; expected square pixels", file, row_mm,
                                out.pixel_mm));
  if (out.source_to_isocentre_mm >= out.source_to_detector_mm)
    throw LoadError(fmt::format("{}: DistanceSourceToPatient is {}; expected less than DistanceSourceToDetector, {}",
                                file, out.source_to_isocentre_mm, out.source_to_detector_mm));
  out.columns = tags.pixels(DCM_Columns, "Columns"), out.rows = tags.pixels(DCM_Rows, "Rows");
  return out;
}

}  // namespace ostium::data
