#include "app/command_line/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/command_line/interrupt.h"
#include "data/formats/load_error.h"

namespace ostium::app {

void add_angle_options(Options& options, ViewArguments& arguments) {
  options.add("--lao", arguments.lao_deg, "Instead of the view's angle, degrees; negative: RAO");
  options.add("--cran", arguments.cran_deg, "Instead of the view's angle, degrees; negative: caudal");
}

void add_view_option(Options& options, std::string& view) {
  options.add("--view", view, "Standard view (`ostium views`), or one of the case's; else the artery's usual one");
}

void add_pixels_option(Options& options, int& pixels, int smallest) {
  std::vector<int> sizes{64, 128, 256, 512, 768, 1024};
  std::erase_if(sizes, [&](int size) { return size < smallest; });
  options.add("--pixels", pixels, "Along a side").one_of(sizes).show_default();
}

void add_cine_flag(Options& options, bool& cine) { options.flag("--cine", cine, "Cine dose instead of fluoroscopy"); }

void add_frame_rate_option(Options& options, const std::string& name, double& frames_per_s) {
  options.add(name, frames_per_s, "Frames a second: 3.75, 7.5, 15, 30").show_default();
}

void add_fill_option(Options& options, std::string& fill) {
  options.add("--fill", fill, "Coronary full of contrast").one_of({"none", "left", "right"}).show_default();
}

void add_renderer_option(Options& options, std::string& renderer) {
  options.add("--renderer", renderer, "What draws path lengths").one_of(fluoro::renderer_names).show_default();
}

fluoro::StandardView named_view(const std::string& name, const std::vector<data::CaseView>& own) {
  if (const auto view = fluoro::find_view(name)) return *view;
  std::string known;
  for (const data::CaseView& view : own) {
    if (view.name == name) return {name, view.lao_deg, view.cran_deg, ""};
    known += (known.empty() ? "; the case has " : ", ") + view.name;
  }
  throw data::LoadError("there is no view \"" + name + "\"; `ostium views` lists them" + known);
}

Fill fill_named(const std::string& name) {
  return name == "left" ? Fill::left : name == "right" ? Fill::right : Fill::none;
}

fluoro::Renderer renderer_named(const std::string& name) {
  const auto wanted =
      static_cast<fluoro::Renderer>(std::ranges::find(fluoro::renderer_names, name) - fluoro::renderer_names.begin());
  if (wanted == fluoro::Renderer::scanline) return wanted;
  static std::map<fluoro::Renderer, fluoro::Renderer> found;  // what was said once is not said again
  const auto [drawn_by, is_new] = found.try_emplace(wanted, fluoro::Renderer::scanline);
  if (!is_new) return drawn_by->second;
  std::string word;
  try {
    word = fmt::format("drawn by {} on {}\n", name, fluoro::make_renderer(wanted)->device());
    drawn_by->second = wanted;
  } catch (const std::runtime_error& missing) {
    word = fmt::format("{}; drawn by scanline instead\n", missing.what());
  }
  fmt::print(stderr, "{}", word);
  return drawn_by->second;
}

bool finish_film(std::optional<data::VideoWriter>& writer, const char* command) {
  if (interrupted && writer)
    fmt::print(stderr, "ostium {}: ended early; the film has what there was until then\n", command);
  if (!writer || writer->finish()) return true;
  fmt::print(stderr, "ostium {}: {}\n", command, writer->problem());
  return false;
}

fluoro::Picture stacked(fluoro::Picture above, const fluoro::Picture& below) {
  above.height += below.height;
  above.grey.insert(above.grey.end(), below.grey.begin(), below.grey.end());
  return above;
}

}  // namespace ostium::app
