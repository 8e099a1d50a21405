#pragma once
/// Shared by the commands that make X-ray pictures: options, and joining pictures.
#include <limits>
#include <optional>

#include "app/command_line/options.h"
#include "app/session/scene/xray_scene.h"
#include "data/formats/video.h"
#include "fluoro/projection/views.h"

namespace ostium::app {

inline constexpr double table_reach_mm = 1000;  ///< of a patient under the beam nothing is farther away

/// A standard view, and angles that override its own.
struct ViewArguments {
  static constexpr double as_view = std::numeric_limits<double>::quiet_NaN();
  std::string view;
  double lao_deg = as_view, cran_deg = as_view;
};

/// --lao and --cran.
void add_angle_options(Options& options, ViewArguments& arguments);
/// One of the standard views of an artery.
void add_view_option(Options& options, std::string& view);
/// `smallest`: 64 or 256.
void add_pixels_option(Options& options, int& pixels, int smallest);
void add_cine_flag(Options& options, bool& cine);
void add_frame_rate_option(Options& options, const std::string& name, double& frames_per_s);
void add_fill_option(Options& options, std::string& fill);

/// What draws path lengths: scanline, osmesa or egl.
void add_renderer_option(Options& options, std::string& renderer);

/// A standard view, or one of the case's own. Throws LoadError if there is no such view.
fluoro::StandardView named_view(const std::string& name, const std::vector<data::CaseView>& own = {});
Fill fill_named(const std::string& name);
/// Says on which device OSMesa or EGL draws; where it is missing, says so and takes scanline.
fluoro::Renderer renderer_named(const std::string& name);

/// Finishes a film, if there is one. If it could not be written, prints the reason prefixed by the command's name and
/// returns false.
bool finish_film(std::optional<data::VideoWriter>& writer, const char* command);
/// One picture above the other; they must have the same width.
fluoro::Picture stacked(fluoro::Picture above, const fluoro::Picture& below);

}  // namespace ostium::app
