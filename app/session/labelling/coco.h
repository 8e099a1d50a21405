#pragma once
/// Labelled pictures as COCO has them (Lin et al., ECCV 2014; cocodataset.org/#format-data): masks as uncompressed run
/// lengths, tips as key points. What COCO has no place for (C-arm, forces, centrelines, depth) stands beside it.
#include <nlohmann/json_fwd.hpp>

#include "app/session/labelling/labels.h"
#include "fluoro/display/display.h"

namespace ostium::app {

/// A picture's place in the set.
struct PictureName {
  std::string run;
  std::uint64_t step = 0;
  std::string picture() const;  ///< "images/RUN-001234.png", from the set's folder
  std::string mask() const;     ///< "masks/RUN-001234.png"
  std::string depth() const;    ///< "depth/RUN-001234.png"
};

/// Angles, distances in mm, and the matrix from mm to pixels.
nlohmann::ordered_json c_arm_of(const fluoro::View& view);
nlohmann::ordered_json points_of(const fluoro::View& view, const Labels& labels);
/// Of one picture; ids count within a run, and categories are names: `coco_of` numbers them.
nlohmann::ordered_json image_of(const PictureName& name, const SessionModel& model, const SessionState& state,
                                const SessionReport& report, const fluoro::View& view, const Labels& labels);
std::vector<nlohmann::ordered_json> annotations_of(const fluoro::View& view, const Labels& labels);

/// Run lengths down the columns, of what is not covered first.
std::vector<long> run_lengths(const fluoro::View& view, const fluoro::Silhouette& covered);

/// The category of each name, from 1.
nlohmann::ordered_json categories_of(const std::vector<std::string>& names);
/// A COCO file of some runs; `runs`: what was written for each. Categories are numbered as in `categories`.
nlohmann::ordered_json coco_of(const std::vector<nlohmann::ordered_json>& runs,
                               const nlohmann::ordered_json& categories);

}  // namespace ostium::app
