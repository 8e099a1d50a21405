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
  double angle(const DcmTagKey& key, const char* name, double most_deg) const {
    const double value = number(key, name);
    if (std::fabs(value) <= most_deg) return value;
    throw LoadError(fmt::format("{}: {} {} is {:g}; expected degrees, {:g} to {:g}", file_, key.toString().c_str(),
                                name, value, -most_deg, most_deg));
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
  std::string text(const DcmTagKey& key, unsigned long which = 0) const {
    OFString value;
    return dataset().findAndGetOFString(key, value, which).good() ? value.c_str() : "";
  }
  void require_still(const DcmTagKey& key, const char* name, const char* what) const {
    if (text(key) == "DYNAMIC")
      throw LoadError(fmt::format("{}: {} {} is DYNAMIC; expected a run whose {} stands still", file_,
                                  key.toString().c_str(), name, what));
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
  if (const std::string modality = tags.text(DCM_Modality); modality != "XA" && modality != "RF")
    throw LoadError(fmt::format("{}: (0008,0060) Modality is \"{}\"; expected XA or RF", file, modality));
  tags.require_still(DCM_PositionerMotion, "PositionerMotion", "C-arm");
  tags.require_still(DCM_TableMotion, "TableMotion", "table");
  DicomGeometry out;
  out.primary_deg = tags.angle(DCM_PositionerPrimaryAngle, "PositionerPrimaryAngle", 180);
  out.secondary_deg = tags.angle(DCM_PositionerSecondaryAngle, "PositionerSecondaryAngle", 90);
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
  out.right_is_to = tags.text(DCM_PatientOrientation, 0), out.down_is_to = tags.text(DCM_PatientOrientation, 1);
  out.columns = tags.pixels(DCM_Columns, "Columns"), out.rows = tags.pixels(DCM_Rows, "Rows");
  return out;
}

}  // namespace ostium::data
