#pragma once
/// X-ray angiography in DICOM (X-Ray Angiographic Image Storage; PS3.3 A.14), written with DCMTK.
#include <cstdint>
#include <string>

#include "data/formats/write_file.h"
#include "fluoro/console/fluoroscope.h"

namespace ostium::data {

struct DicomPatient {
  std::string name = "Ostium^Simulated";
  std::string id = "OSTIUM";
  std::string series = "Simulated coronary angiography";
};

/// Where a file stands among those of one film: one study, a series for each file.
struct DicomPlace {
  std::string study_uid;  ///< of `new_study_uid`; empty: a study of its own
  int series = 1;         ///< counted from 1
};

/// Throws LoadError in a build that writes none: before the work, as nothing comes of it.
void require_dicom();

std::string new_study_uid();

/// Whether a DICOM file is there to its end.
bool is_whole_dicom(const std::string& file);

/// Bytes of pixels that one file can hold: its lengths have 32 bits, of which some are for the rest.
inline constexpr std::uint64_t dicom_most_bytes = 0xFFFF0000;

/// A run of one or more frames of one size: 8 bits as displayed, with positioner angles, SID, pixel spacing at the
/// detector, frame time, tube voltage and dose-area product. Throws WriteError, also beyond `dicom_most_bytes`.
void write_dicom(const std::string& file, const fluoro::CineRun& run, const DicomPatient& patient = {},
                 const DicomPlace& place = {});
/// The same without a name yet, which the caller gives it: for several that appear together.
void write_dicom(const NewFile& file, const fluoro::CineRun& run, const DicomPatient& patient, const DicomPlace& place);

}  // namespace ostium::data
