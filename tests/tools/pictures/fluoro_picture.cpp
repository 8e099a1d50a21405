/// The contact sheet of fluoro's README: six views of the chest phantom, fluoroscopy above, cine below.
#include <cstdio>

#include "core/base/units.h"
#include "data/formats/png.h"
#include "fluoro/console/fluoroscope.h"
#include "fluoro/display/overlay.h"
#include "fluoro/phantom/chest.h"

using namespace ostium;

namespace {

struct Shot {
  double lao_deg, cran_deg;
  fluoro::phantom::Filling filling;
  bool left_guide, cine;
};

fluoro::Picture taken(const Shot& shot) {
  using units::degree;
  fluoro::phantom::ChestOptions options;
  options.filling = shot.filling;
  options.left_instruments = shot.left_guide;
  const fluoro::Scene scene = fluoro::phantom::chest(options);
  fluoro::View view;
  view.arm.lao_rad = shot.lao_deg * degree;
  view.arm.cran_rad = shot.cran_deg * degree;
  view.pixels = 384;
  fluoro::Imager imager({}, fluoro::make_scanline_renderer());
  fluoro::FluoroscopeState state;
  fluoro::DisplayScratch scratch;
  const fluoro::Pedals pedals{.fluoroscopy = !shot.cine, .cine = shot.cine};
  fluoro::TickReport report;
  for (int i = 0; i < 8; ++i)
    report = tick(imager, {.scene = scene, .view = view, .collimator = {}, .pedals = pedals}, state, scratch);
  fluoro::Picture picture = state.live;
  draw_overlay({view, shot.cine ? fluoro::cine() : fluoro::fluoroscopy(), report.frame.exposure, state.dose, true, "",
                "phantom"},
               picture);
  return picture;
}

fluoro::Picture below(fluoro::Picture upper, const fluoro::Picture& lower) {
  upper.height += lower.height;
  upper.grey.insert(upper.grey.end(), lower.grey.begin(), lower.grey.end());
  return upper;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: fluoro_picture FILE.png\n"), 2;
  using fluoro::phantom::Filling;
  const Shot shots[] = {{-30, 0, Filling::none, true, false}, {-30, -20, Filling::left, true, false},
                        {45, 25, Filling::left, true, false}, {45, -30, Filling::left, true, true},
                        {40, 0, Filling::right, false, true}, {-30, 0, Filling::right, false, true}};
  fluoro::Picture sheet;
  for (int row = 0; row < 2; ++row) {
    const fluoro::Picture strip =
        beside(beside(taken(shots[3 * row]), taken(shots[3 * row + 1])), taken(shots[3 * row + 2]));
    sheet = row ? below(sheet, strip) : strip;
  }
  data::write_png(argv[1], sheet);
}
