#include "data/formats/dicom/dicom.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "core/base/units.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"

// Where DCMTK is built without the standard library's, OFString is a string of its own.
// NOLINTBEGIN(readability-redundant-string-cstr)

namespace ostium::data {

namespace {

/// DICOM patient orientation letters for a direction in frame P, strongest first: L left, H head, A front.
std::string orientation(const Eigen::Vector3d& direction) {
  std::vector<std::pair<double, char>> parts;
  for (int i = 0; i < 3; ++i) {
    const double part = direction[i];
    if (std::fabs(part) > 0.2) parts.emplace_back(std::fabs(part), part > 0 ? "LHA"[i] : "RFP"[i]);
  }
  std::sort(parts.rbegin(), parts.rend());
  std::string letters;
  for (const auto& [size, letter] : parts) letters += letter;
  return letters;
}

std::string unique(const char* root) {
  char uid[100];
  return dcmGenerateUniqueIdentifier(uid, root);
}

class Writer {
 public:
  void text(const DcmTagKey& tag, const std::string& value) {
    require(dataset().putAndInsertString(tag, value.c_str()), tag);
  }
  void number(const DcmTagKey& tag, double value) { text(tag, fmt::format("{:.6g}", value)); }
  void word(const DcmTagKey& tag, unsigned value) {
    require(dataset().putAndInsertUint16(tag, static_cast<Uint16>(value)), tag);
  }
  void bytes(const DcmTagKey& tag, const std::vector<Uint8>& value) {
    require(dataset().putAndInsertUint8Array(tag, value.data(), value.size()), tag);
  }
  void pointer(const DcmTagKey& tag, const DcmTagKey& to) { require(dataset().putAndInsertTagKey(tag, to), tag); }
  void unique_id(const DcmTagKey& tag, const char* root) { text(tag, unique(root)); }
  void save(const NewFile& out) {
    const OFCondition saved = format_.saveFile(out.beside().c_str(), EXS_LittleEndianExplicit);
    if (saved.bad() || !whole(out.beside()))
      throw write_error(out.path(), saved.bad() ? saved.text() : "it was cut short");
  }

 private:
  DcmDataset& dataset() { return *format_.getDataset(); }
  static void require(const OFCondition& done, const DcmTagKey& tag) {
    if (done.bad()) throw std::logic_error(std::string("DICOM: ") + tag.toString().c_str() + ": " + done.text());
  }
  /// DCMTK does not report a file cut short by a full disk.
  bool whole(const std::string& file) {
    const auto length = [](DcmItem& item) { return item.getLength(EXS_LittleEndianExplicit, EET_UndefinedLength); };
    constexpr unsigned preamble = 132;
    std::error_code none;
    const auto size = std::filesystem::file_size(file, none);
    return !none && size >= preamble + length(*format_.getMetaInfo()) + length(dataset());
  }
  DcmFileFormat format_;
};

void write_patient_and_study(Writer& out, const DicomPatient& patient, const DicomPlace& place) {
  OFString date, time;
  DcmDate::getCurrentDate(date);
  DcmTime::getCurrentTime(time, /*seconds=*/OFTrue, /*fraction=*/OFFalse);
  out.text(DCM_PatientName, patient.name);
  out.text(DCM_PatientID, patient.id);
  out.text(DCM_PatientBirthDate, "");
  out.text(DCM_PatientSex, "");
  out.text(DCM_StudyInstanceUID, place.study_uid.empty() ? new_study_uid() : place.study_uid);
  out.text(DCM_StudyDate, date.c_str());
  out.text(DCM_StudyTime, time.c_str());
  out.text(DCM_ReferringPhysicianName, "");
  out.text(DCM_StudyID, "1");
  out.text(DCM_AccessionNumber, "");
  out.text(DCM_Modality, "XA");
  out.unique_id(DCM_SeriesInstanceUID, SITE_SERIES_UID_ROOT);
  out.text(DCM_SeriesNumber, std::to_string(place.series));
  out.text(DCM_SeriesDescription, patient.series);
  out.text(DCM_PatientPosition, "HFS");
  out.text(DCM_BodyPartExamined, "HEART");
  out.text(DCM_Manufacturer, "Ostium");
  out.text(DCM_ManufacturerModelName, "Ostium simulator: training and research");
  out.text(DCM_InstanceNumber, "1");
  out.text(DCM_ContentDate, date.c_str());
  out.text(DCM_ContentTime, time.c_str());
}

void write_acquisition(Writer& out, const fluoro::CineRun& run) {
  using units::degree;
  const fluoro::CArm& arm = run.view.arm;
  const fluoro::ImageAxes axes(arm);
  out.text(DCM_PatientOrientation, orientation(axes.right) + "\\" + orientation(-axes.up));
  out.text(DCM_PixelIntensityRelationship, "DISP");
  out.number(DCM_KVP, run.exposure.tube.peak_kV);
  out.text(DCM_RadiationSetting, run.programme.mode == fluoro::Mode::cine ? "GR" : "SC");
  out.text(DCM_XRayTubeCurrent, "");
  out.text(DCM_ExposureTime, "");
  out.text(DCM_Exposure, "");
  out.text(DCM_RadiationMode, "PULSED");
  out.number(DCM_ImageAndFluoroscopyAreaDoseProduct,
             1e5 * run.exposure.dose_area_Gy_m2 * double(run.frames.size()));  // dGy cm2
  const double pixel_mm = 1e3 * run.view.field_m / run.view.pixels;
  out.text(DCM_ImagerPixelSpacing, fmt::format("{0:.6g}\\{0:.6g}", pixel_mm));
  out.number(DCM_PositionerPrimaryAngle, arm.lao_rad / degree);
  out.number(DCM_PositionerSecondaryAngle, arm.cran_rad / degree);
  out.number(DCM_DistanceSourceToDetector, 1e3 * arm.source_to_detector_m);
  out.number(DCM_DistanceSourceToPatient, 1e3 * arm.source_to_isocentre_m);
  out.number(DCM_EstimatedRadiographicMagnificationFactor, arm.source_to_detector_m / arm.source_to_isocentre_m);
}

void write_pixels(Writer& out, const fluoro::CineRun& run) {
  const fluoro::Picture& first = run.frames.front();
  out.word(DCM_SamplesPerPixel, 1);
  out.text(DCM_PhotometricInterpretation, "MONOCHROME2");
  out.word(DCM_Rows, unsigned(first.height));
  out.word(DCM_Columns, unsigned(first.width));
  out.word(DCM_BitsAllocated, 8);
  out.word(DCM_BitsStored, 8);
  out.word(DCM_HighBit, 7);
  out.word(DCM_PixelRepresentation, 0);
  if (run.frames.size() > 1) {
    out.text(DCM_NumberOfFrames, std::to_string(run.frames.size()));
    out.pointer(DCM_FrameIncrementPointer, DCM_FrameTime);
    out.number(DCM_FrameTime, 1000 / run.programme.frames_per_s);
    // A whole number by the standard; the frame time above is exact.
    out.text(DCM_CineRate, std::to_string(std::max(1L, std::lround(run.programme.frames_per_s))));
    out.text(DCM_PositionerMotion, "STATIC");
  }
  std::vector<Uint8> pixels;
  pixels.reserve(run.frames.size() * first.grey.size() + 1);
  for (const fluoro::Picture& frame : run.frames) {
    if (frame.width != first.width || frame.height != first.height)
      throw std::invalid_argument("DICOM: the frames of a run are of one size");
    pixels.insert(pixels.end(), frame.grey.begin(), frame.grey.end());
  }
  if (pixels.size() % 2) pixels.push_back(0);
  out.bytes(DCM_PixelData, pixels);
}

}  // namespace

void require_dicom() {}

bool is_whole_dicom(const std::string& file) {
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  DcmFileFormat format;
  return format.loadFile(file.c_str(), EXS_Unknown, EGL_noChange, 64, ERM_fileOnly).good();
}

std::string new_study_uid() { return unique(SITE_STUDY_UID_ROOT); }

void write_dicom(const std::string& file, const fluoro::CineRun& run, const DicomPatient& patient,
                 const DicomPlace& place) {
  NewFile out(file);
  write_dicom(out, run, patient, place);
  out.finish();
}

void write_dicom(const NewFile& file, const fluoro::CineRun& run, const DicomPatient& patient,
                 const DicomPlace& place) {
  if (run.frames.empty()) throw std::invalid_argument("DICOM: a run without frames");
  if (run.frames.size() * run.frames.front().grey.size() > dicom_most_bytes)
    throw write_error(file.path(), "a DICOM file holds no more than 4 GB; expected fewer frames, or fewer pixels");
  Writer out;
  out.text(DCM_SOPClassUID, UID_XRayAngiographicImageStorage);
  out.unique_id(DCM_SOPInstanceUID, SITE_INSTANCE_UID_ROOT);
  out.text(DCM_ImageType, "ORIGINAL\\PRIMARY\\SINGLE PLANE");
  write_patient_and_study(out, patient, place);
  write_acquisition(out, run);
  write_pixels(out, run);
  out.save(file);
}

}  // namespace ostium::data

// NOLINTEND(readability-redundant-string-cstr)
