#include "app/commands/side_by_side.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/command_line/interrupt.h"
#include "app/command_line/pictures.h"
#include "app/command_line/progress.h"
#include "app/session/scene/film.h"
#include "data/assessment/html.h"
#include "fluoro/display/overlay.h"

namespace ostium::app {

namespace {

constexpr double frames_per_s = 15;
constexpr int pixels = 512;

/// One of the two, with its last picture.
class FilmedRun {
 public:
  FilmedRun(Replay& replay, const data::ReportRun& run, fluoro::Renderer renderer)
      : replay_(replay), run_(run), film_(replay.model, options(renderer)) {
    replay.go_to(0);
    take();
  }

  double second() const { return static_cast<double>(replay_.state.rods.step) * replay_.recording.step_s(); }
  /// To a frame's time.
  void go_on_to(double second_s) {
    const auto step = static_cast<std::uint64_t>(std::llround(second_s / replay_.recording.step_s()));
    bool moved = false;
    while (replay_.state.rods.step < step && replay_.tick()) moved = true;
    if (moved) take();
  }
  fluoro::Picture picture(const std::string& stage, bool waits) const {
    fluoro::Picture out = picture_;
    draw_captions({run_.code + (waits ? ", waits" : ""), stage, data::time_text(second())}, out);
    return out;
  }

 private:
  static FilmOptions options(fluoro::Renderer renderer) {
    FilmOptions out;
    out.frames_per_s = frames_per_s, out.pixels = pixels, out.overlay = false, out.always_on = true;
    out.renderer = renderer;
    return out;
  }
  void take() { picture_ = film_.frame(replay_.model, replay_.state, replay_.inputs); }

  Replay& replay_;
  const data::ReportRun& run_;
  Film film_;
  fluoro::Picture picture_;
};

}  // namespace

bool film_side_by_side(std::array<Replay, 2>& replays, const std::vector<data::ReportRun>& runs,
                       const std::string& file, fluoro::Renderer renderer) {
  stop_on_signals();
  const std::vector<data::Stage> stages = common_stages(runs);
  const auto end_s = [&](std::size_t stage, std::size_t run) {
    return stage + 1 < stages.size() ? stages[stage + 1].begin_s[run] : runs[run].simulated_s;
  };
  double all_s = 0, done_s = 0;
  for (std::size_t k = 0; k < stages.size(); ++k)
    all_s += std::max(end_s(k, 0) - stages[k].begin_s[0], end_s(k, 1) - stages[k].begin_s[1]);
  std::optional<data::VideoWriter> writer(std::in_place, file, 2 * pixels, pixels, frames_per_s);
  std::array<FilmedRun, 2> filmed = {FilmedRun(replays[0], runs[0], renderer),
                                     FilmedRun(replays[1], runs[1], renderer)};
  for (std::size_t k = 0; k < stages.size(); ++k) {
    const std::array<double, 2> lasts = {end_s(k, 0) - stages[k].begin_s[0], end_s(k, 1) - stages[k].begin_s[1]};
    const double last = std::max(lasts[0], lasts[1]);
    for (int frame = 1; frame / frames_per_s <= last && !interrupted; ++frame) {
      const double into = frame / frames_per_s;
      std::array<fluoro::Picture, 2> shown;
      for (std::size_t r = 0; r < 2; ++r) {
        filmed[r].go_on_to(stages[k].begin_s[r] + std::min(into, lasts[r]));
        shown[r] = filmed[r].picture(stages[k].name, into > lasts[r]);
      }
      writer->add(beside(shown[0], shown[1]));
      show_progress(fmt::format("film: {:.0f} of {:.0f} s", done_s + into, all_s));
    }
    for (std::size_t r = 0; r < 2 && !interrupted; ++r) filmed[r].go_on_to(end_s(k, r));
    done_s += last;
  }
  show_progress("");
  return finish_film(writer, "report");
}

}  // namespace ostium::app
