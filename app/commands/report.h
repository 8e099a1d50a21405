#pragma once
#include <memory>
#include <string>

#include "data/assessment/score_list.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::app {

struct Vessel;
/// Reads a recording in the folder and writes report.html, events.csv and key-frames/ beside it. `vessel`: the run's
/// vessel.
void report_folder(const std::string& folder, std::shared_ptr<const Vessel> vessel, const std::string& recording,
                   const data::ScoreList& list, fluoro::Renderer renderer = fluoro::Renderer::scanline);

}  // namespace ostium::app
