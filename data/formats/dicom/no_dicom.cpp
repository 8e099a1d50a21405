/// DICOM in a build without DCMTK: nothing is read or written, and it says so.
#include "data/formats/dicom/dicom.h"
#include "data/formats/dicom/dicom_geometry.h"
#include "data/formats/dicom/segmentation.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"

namespace ostium::data {

DicomGeometry read_dicom_geometry(const std::string& file) {
  throw LoadError(file + ": this build reads no DICOM; expected the geometry as numbers, or a build with OSTIUM_DICOM");
}

void require_dicom() { throw LoadError("this build writes no DICOM; expected one with OSTIUM_DICOM"); }

std::string new_study_uid() { return ""; }

bool is_whole_dicom(const std::string&) { return false; }

void write_dicom(const std::string& file, const fluoro::CineRun&, const DicomPatient&, const DicomPlace&) {
  throw WriteError(file + ": this build writes no DICOM; build with OSTIUM_DICOM");
}

void write_dicom(const NewFile& file, const fluoro::CineRun&, const DicomPatient&, const DicomPlace&) {
  throw WriteError(file.path() + ": this build writes no DICOM; build with OSTIUM_DICOM");
}

void write_segmentation(const std::string& file, const std::string&, const std::string&,
                        const std::vector<DicomSegment>&, const std::vector<SegmentedFrame>&) {
  throw WriteError(file + ": this build writes no DICOM; build with OSTIUM_DICOM");
}

}  // namespace ostium::data
