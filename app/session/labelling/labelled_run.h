#pragma once
/// A script's run as labelled pictures.
#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "app/session/operator/setup.h"

namespace ostium::app {

struct FrameOptions {
  double every_s = 0.5;  ///< of simulated time, to a frame of 15 a second
  int pixels = 512;
  double seconds = 0;  ///< limit of simulated time; 0: none
  bool dicom = false;  ///< the pictures as a DICOM film, too, with a segmentation
  std::function<bool()> stop = [] { return false; };
};

/// When the first picture is due, simulated time.
double first_picture_s(const FrameOptions& options);

/// Plays a script and writes its pictures, masks and depths below `folder`. Returns what `coco_of` takes; empty if it
/// was stopped. Throws LoadError, WriteError.
nlohmann::ordered_json frames_of_run(const RunSetup& setup, std::shared_ptr<const Vessel> vessel,
                                     const std::string& run_name, const std::string& folder,
                                     const FrameOptions& options);
/// Of the files that a run of `frames_of_run` wrote, the first that is gone or was cut short; "": none.
std::string lost_file(const nlohmann::ordered_json& run, const std::string& folder);

}  // namespace ostium::app
