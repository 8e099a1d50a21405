#include "app/session/labelling/dicom_film.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/session/labelling/coco.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;

/// The larger arteries by name (PS3.16, CID 3016).
const std::pair<const char*, data::DicomCode> arteries[] = {
    {"LM", {"3227004", "SCT", "Left Main Coronary Artery"}},
    {"LAD", {"59438005", "SCT", "Left Anterior Descending Coronary Artery"}},
    {"LCx", {"57396003", "SCT", "Circumflex Coronary Artery"}},
    {"RCA", {"13647002", "SCT", "Right Coronary Artery"}},
    {"aorta", {"15825003", "SCT", "Aorta"}},
};

/// What is no artery by name. The devices are of CID 8; that has no wire.
data::DicomCode type_of(const LabelledThing& thing) {
  for (const auto& [name, code] : arteries)
    if (thing.name == name && thing.tool < 0) return code;
  switch (thing.of_class) {
    case LabelClass::coronary:
      return {"41801008", "SCT", "Coronary Artery"};
    case LabelClass::wire:
      return {"WIRE", "99OSTIUM", "Guide wire"};
    case LabelClass::balloon:
      return {"102319006", "SCT", "Percutaneous transluminal angioplasty balloon"};
    case LabelClass::stent:
      return {"65818007", "SCT", "Stent"};
    case LabelClass::catheter:
    case LabelClass::device_shaft:
      return {"19923001", "SCT", "Catheter"};
    default:
      return {"51114001", "SCT", "Artery"};
  }
}

data::DicomSegment segment_of(const LabelledThing& thing) {
  const bool vessel = thing.of_class == LabelClass::vessel || thing.of_class == LabelClass::coronary;
  const data::DicomCode category = vessel ? data::DicomCode{"91723000", "SCT", "Anatomical Structure"}
                                          : data::DicomCode{"260787004", "SCT", "Physical object"};
  return {thing.name, category, type_of(thing), thing.name};
}

}  // namespace

void DicomFilm::add(fluoro::CineRun exposed, double frames_per_s, const fluoro::Picture& picture, const Labels& labels,
                    const fluoro::View& view) {
  exposed.programme.frames_per_s = frames_per_s;
  films_.add(exposed, picture);
  segmentations_.resize(films_.runs().size());
  Segmentation& own = segmentations_.back();
  const int frame = static_cast<int>(films_.runs().back().frames.size());
  for (const LabelledThing& thing : labels.things) {
    const data::DicomSegment segment = segment_of(thing);
    const auto same = std::find_if(own.segments.begin(), own.segments.end(), [&](const data::DicomSegment& s) {
      return s.label == segment.label && s.type.value == segment.type.value;
    });
    own.frames.push_back({frame, 1 + static_cast<int>(same - own.segments.begin()), run_lengths(view, thing.covered)});
    if (same == own.segments.end()) own.segments.push_back(segment);
  }
}

nlohmann::ordered_json DicomFilm::write(const std::string& folder, const std::string& run_name) const {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  if (films_.runs().empty()) return out;
  const fs::path below = "dicom";
  const std::vector<std::string> films = films_.write((fs::path(folder) / below / (run_name + ".dcm")).string());
  for (std::size_t i = 0; i < films.size(); ++i) {
    const fs::path name = below / fs::path(films[i]).filename();
    nlohmann::ordered_json one = {{"film", name.string()}};
    if (!segmentations_[i].frames.empty()) {
      const fs::path segmentation = below / (name.stem().string() + "-seg.dcm");
      write_segmentation((fs::path(folder) / segmentation).string(), films[i], OSTIUM_VERSION,
                         segmentations_[i].segments, segmentations_[i].frames);
      one["segmentation"] = segmentation.string();
    }
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace ostium::app
