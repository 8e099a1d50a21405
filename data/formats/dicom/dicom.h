#pragma once
/// X-ray angiography in DICOM (X-Ray Angiographic Image Storage; PS3.3 A.14), written with DCMTK.
#include <string>

#include "fluoro/console/fluoroscope.h"

namespace ostium::data {

struct DicomPatient {
  std::string name = "Ostium^Simulated";
  std::string id = "OSTIUM";
  std::string series = "Simulated coronary angiography";
};

/// A run of one or more frames of one size: 8 bits as displayed, with positioner angles, SID, pixel spacing at the
/// detector, frame time, tube voltage and dose-area product. Throws WriteError.
void write_dicom(const std::string& file, const fluoro::CineRun& run, const DicomPatient& patient = {});

}  // namespace ostium::data
