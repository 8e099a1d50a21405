#pragma once
/// What is written of all runs of a set of labelled pictures, once they are done.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace ostium::app {

inline constexpr const char* label_set_files[] = {"train.json", "val.json", "test.json", "manifest.json"};

struct LabelSetHead {
  double every_s = 0.5;
  int pixels = 512;
  std::vector<std::string> keys;  ///< what was varied
};

/// Writes train.json, val.json, test.json and manifest.json below `folder`. `runs`: of each what `frames_of_run`
/// returned, with name, person ("dataset" is left out). Returns the number of pictures. Throws WriteError.
std::size_t write_label_set(const std::string& folder, const LabelSetHead& head,
                            const std::vector<nlohmann::ordered_json>& runs);

}  // namespace ostium::app
