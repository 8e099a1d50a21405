#pragma once
/// What commands that make X-ray pictures have in common: options, and pictures put together.
#include <limits>
#include <optional>

#include "app/command_line/options.h"
#include "app/session/scene/xray_scene.h"
#include "data/formats/video.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

/// A standard view, and angles instead of its own.
struct ViewArguments {
  static constexpr double as_view = std::numeric_limits<double>::quiet_NaN();
  std::string view;
  double lao_deg = as_view, cran_deg = as_view;
};

/// --lao and --cran.
void add_angle_options(Options& options, ViewArguments& arguments);
/// Of an artery that has a usual view.
void add_view_option(Options& options, std::string& view);
/// `smallest`: 64 or 256.
void add_pixels_option(Options& options, int& pixels, int smallest);
void add_cine_flag(Options& options, bool& cine);
void add_frame_rate_option(Options& options, const std::string& name, double& frames_per_s);
void add_fill_option(Options& options, std::string& fill);

/// Throws LoadError if there is no such view.
fluoro::StandardView named_view(const std::string& name);
Fill fill_named(const std::string& name);

/// Ends a film, if one is made. Where it could not be written, says why in the command's name; then false.
bool finish_film(std::optional<data::VideoWriter>& writer, const char* command);
/// One picture above the other, of the same width.
fluoro::Picture stacked(fluoro::Picture above, const fluoro::Picture& below);

}  // namespace ostium::app
