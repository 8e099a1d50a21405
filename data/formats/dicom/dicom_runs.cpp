#include "data/formats/dicom/dicom_runs.h"

#include <fmt/format.h>

#include <filesystem>
#include <list>

namespace ostium::data {

namespace {

/// Whether both can stand under one header.
bool same_header(const fluoro::CineRun& a, const fluoro::CineRun& b) {
  const fluoro::CArm &p = a.view.arm, &q = b.view.arm;
  return p.lao_rad == q.lao_rad && p.cran_rad == q.cran_rad && p.p_PI == q.p_PI &&
         p.source_to_detector_m == q.source_to_detector_m && p.source_to_isocentre_m == q.source_to_isocentre_m &&
         a.view.field_m == b.view.field_m && a.view.pixels == b.view.pixels && a.programme.mode == b.programme.mode &&
         a.programme.frames_per_s == b.programme.frames_per_s;
}

}  // namespace

void DicomRuns::add(const fluoro::CineRun& exposed, const fluoro::Picture& picture) {
  const bool full = !runs_.empty() && (runs_.back().frames.size() + 1) * picture.grey.size() > most_bytes_;
  if (runs_.empty() || full || !same_header(runs_.back(), exposed))
    runs_.push_back({exposed.view, exposed.programme, exposed.exposure, {}});
  runs_.back().exposure = exposed.exposure;
  runs_.back().frames.push_back(picture);
}

std::vector<std::string> DicomRuns::write(const std::string& file, const DicomPatient& patient) const {
  std::vector<std::string> names;
  const std::filesystem::path path = file;
  DicomPlace place{new_study_uid(), 0};
  std::list<NewFile> files;  // all or none of them
  for (const fluoro::CineRun& run : runs_) {
    std::filesystem::path name = path;
    if (!names.empty())
      name.replace_filename(fmt::format("{}-{}{}", path.stem().string(), names.size() + 1, path.extension().string()));
    ++place.series;
    write_dicom(files.emplace_back(name.string()), run, patient, place);
    names.push_back(name.string());
  }
  for (NewFile& one : files) one.finish();
  return names;
}

}  // namespace ostium::data
