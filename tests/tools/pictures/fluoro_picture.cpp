/// The contact sheet of fluoro's README: six views of the chest phantom, fluoroscopy above, cine below.
#include <cstdio>
#include <numbers>

#include "data/formats/png.h"
#include "fluoro/fluoroscope.h"
#include "fluoro/overlay.h"
#include "fluoro/phantom/chest.h"

using namespace ostium;

namespace {

struct Shot {
  double lao_deg, cran_deg;
  phantom::Filling filling;
  bool left_guide, cine;
};

Picture taken(const Shot& shot) {
  constexpr double degree = std::numbers::pi / 180;
  phantom::ChestOptions options;
  options.filling = shot.filling;
  options.left_instruments = shot.left_guide;
  const Scene scene = phantom::chest(options);
  View view;
  view.arm.lao_rad = shot.lao_deg * degree;
  view.arm.cran_rad = shot.cran_deg * degree;
  view.pixels = 384;
  Imager imager({}, make_scanline_renderer());
  FluoroscopeState state;
  DisplayScratch scratch;
  const Pedals pedals{.fluoroscopy = !shot.cine, .cine = shot.cine};
  TickReport report;
  for (int i = 0; i < 8; ++i)
    report = tick(imager, {.scene = scene, .view = view, .collimator = {}, .pedals = pedals}, state, scratch);
  Picture picture = state.live;
  draw_overlay({view, shot.cine ? cine() : fluoroscopy(), report.frame.exposure, state.dose, true, "", "phantom"},
               picture);
  return picture;
}

Picture below(Picture upper, const Picture& lower) {
  upper.height += lower.height;
  upper.grey.insert(upper.grey.end(), lower.grey.begin(), lower.grey.end());
  return upper;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: fluoro_picture FILE.png\n"), 2;
  using phantom::Filling;
  const Shot shots[] = {{-30, 0, Filling::none, true, false}, {-30, -20, Filling::left, true, false},
                        {45, 25, Filling::left, true, false}, {45, -30, Filling::left, true, true},
                        {40, 0, Filling::right, false, true}, {-30, 0, Filling::right, false, true}};
  Picture sheet;
  for (int row = 0; row < 2; ++row) {
    const Picture strip = beside(beside(taken(shots[3 * row]), taken(shots[3 * row + 1])), taken(shots[3 * row + 2]));
    sheet = row ? below(sheet, strip) : strip;
  }
  write_png(argv[1], sheet);
}
