#include "app/session/labelling/labelled_run.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/session/labelling/coco.h"
#include "app/session/labelling/dicom_film.h"
#include "app/session/run/run.h"
#include "app/session/scene/film.h"
#include "data/formats/dicom/dicom.h"
#include "data/formats/png.h"

namespace ostium::app {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr double frames_per_s = 15;
/// Frames drawn before one that is kept, in which exposure, noise filter and lag settle.
constexpr long settling = 5;

bool any_in_body(const SessionReport& report) {
  return std::any_of(report.tools.begin(), report.tools.end(), [](const ToolReport& tool) { return tool.in_body; });
}

/// Frames from one that is kept to the next.
long frames_apart(const FrameOptions& options) { return std::max(1L, std::lround(options.every_s * frames_per_s)); }

}  // namespace

double first_picture_s(const FrameOptions& options) {
  return static_cast<double>(frames_apart(options)) / frames_per_s;
}

Json frames_of_run(const RunSetup& setup, std::shared_ptr<const Vessel> vessel, const std::string& run_name,
                   const std::string& folder, const FrameOptions& options) {
  ScriptedRun run(setup, std::move(vessel));
  const Labeller labeller(run.model);
  FilmOptions film_options;
  film_options.pixels = options.pixels, film_options.overlay = false, film_options.seed = setup.seed + 1;
  Film film(run.model, film_options);
  const long apart = frames_apart(options);
  Json pictures = Json::array();
  DicomFilm dicom;
  std::string reason;
  for (long frame = 0; !options.stop() && run.tick();) {
    if (options.seconds > 0 && seconds(run.model, run.state) >= options.seconds - 1e-9) {
      reason = "time limit";
      break;
    }
    if (!is_frame(run.state.rods.step, frames_per_s, run.model.step_s())) continue;
    const long ahead = (apart - ++frame % apart) % apart;  // frames until the next that is kept
    if (ahead > settling) continue;
    const fluoro::Picture& picture = film.frame(run.model, run.state, run.inputs);
    if (ahead > 0 || !any_in_body(run.report)) continue;
    const fluoro::View view = film.view(run.inputs);
    const Labels labels = labeller.at(run.state, view);
    const PictureName name{run_name, run.state.rods.step};
    data::write_png((fs::path(folder) / name.picture()).string(), picture);
    const LabelledPixels pixels = pixels_of(view, labels);
    data::write_png((fs::path(folder) / name.mask()).string(), pixels.mask);
    data::write_grey16_png((fs::path(folder) / name.depth()).string(), options.pixels, options.pixels, pixels.depth);
    if (options.dicom) dicom.add(film.run(), frames_per_s / static_cast<double>(apart), picture, labels, view);
    pictures.push_back({{"image", image_of(name, run.model, run.state, run.report, view, labels)},
                        {"annotations", annotations_of(view, labels)}});
  }
  if (options.stop()) return {};
  Json files = Json::array();
  if (options.dicom) files = dicom.write(folder, run_name);
  Json out = {{"outcome", reason.empty() ? words_for(run.outcome) : "aborted"},
              {"reason", reason.empty() ? app::reason(run) : reason},
              {"simulated_s", seconds(run.model, run.state)},
              {"pictures", pictures}};
  if (options.dicom) out["dicom"] = files;
  return out;
}

std::string lost_file(const Json& run, const std::string& folder) {
  const auto at = [&](const std::string& file) { return (fs::path(folder) / file).string(); };
  for (const Json& picture : run.at("pictures"))
    for (const char* of : {"file_name", "mask", "depth"})
      if (const std::string file = picture.at("image").at(of); !data::is_whole_png(at(file))) return file;
  for (const Json& film : run.value("dicom", Json::array()))
    for (const auto& [of, file] : film.items())
      if (!data::is_whole_dicom(at(file))) return file;
  return "";
}

}  // namespace ostium::app
