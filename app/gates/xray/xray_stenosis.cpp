/// A stenosis of 60 % by diameter in a vessel full of contrast, measured back from one picture as quantitative
/// angiography does: the width of the throat over that of the healthy vessel on either side.
#include <algorithm>
#include <cmath>

#include "app/gates/gate.h"
#include "app/gates/xray/xray_water.h"

namespace ostium::app::gates {

namespace {

constexpr double healthy_m = 3e-3, narrowing = 0.6;

/// Along x at the isocentre: healthy, 4 mm of slope, 4 mm of throat, and back.
fluoro::Scene vessel_in_water() {
  fluoro::Scene scene = slab(0.2, fluoro::tissue::soft);
  const Eigen::Matrix3Xd line = fluoro::phantom::smooth_line({{-0.05, 0, 0}, {0.05, 0, 0}}, 0.25e-3);
  Eigen::VectorXd radius(line.cols());
  for (Eigen::Index i = 0; i < line.cols(); ++i) {
    const double into = std::clamp((0.006 - std::fabs(line(0, i))) / 0.004, 0.0, 1.0);
    radius[i] = 0.5 * healthy_m * (1 - narrowing * into);
  }
  constexpr int sides = 32;
  fluoro::Body vessel = fluoro::phantom::body("vessel", fluoro::phantom::tube(line, radius, sides, true),
                                              fluoro::tissue::soft, fluoro::tissue::soft);
  vessel.contrast = {Eigen::VectorXf::Constant(vessel.p_P.cols(), 300), fluoro::phantom::tube_centres(line, sides)};
  scene.moving.push_back(std::move(vessel));
  return scene;
}

/// Full width at half maximum of the logarithmic profile across the vessel, averaged over some columns, against a
/// linear background on either side.
double width_m(const fluoro::Plane& signal, int from, int to, double pixel_m) {
  const int middle = static_cast<int>(signal.rows()) / 2, half = static_cast<int>(4e-3 / pixel_m),
            far = static_cast<int>(9e-3 / pixel_m);
  const Eigen::ArrayXd profile = signal.middleCols(from, to - from).cast<double>().rowwise().mean();
  const double above = profile.segment(middle - far, far - half).mean(),
               below = profile.segment(middle + half, far - half).mean();
  std::vector<double> depth;
  for (int row = middle - half; row < middle + half; ++row) {
    const double t = (row + 0.5 - (middle - 0.5 * (far + half))) / (far + half);
    depth.push_back(-std::log(profile[row] / (above + t * (below - above))));
  }
  // The maximum is the mean of the middle four pixels, as the vessel's axis is known here.
  const auto top = static_cast<std::size_t>(half);
  const double level = 0.5 * (depth[top - 2] + depth[top - 1] + depth[top] + depth[top + 1]) / 4;
  const auto crossing = [&](int step) {
    auto i = static_cast<std::ptrdiff_t>(step > 0 ? top : top - 1);
    while (depth[std::size_t(i + step)] > level) i += step;
    const double here = depth[std::size_t(i)], beyond = depth[std::size_t(i + step)];
    return double(i) + step * (here - level) / (here - beyond);
  };
  return (crossing(1) - crossing(-1)) * pixel_m;
}

}  // namespace

std::vector<data::GateResult> xray_stenosis(bool) {
  const fluoro::Scene scene = vessel_in_water();
  std::vector<data::GateResult> out;
  for (const fluoro::Programme& programme : {fluoro::cine(), fluoro::fluoroscopy()}) {
    fluoro::Imager imager({}, fluoro::make_scanline_renderer());
    fluoro::View view;
    fluoro::ImagerState state;
    fluoro::FrameReport report;
    for (int i = 0; i < 4; ++i) report = imager.frame({scene, view, {}, programme, 2}, state);
    const double pixel_m = view.field_m / view.pixels;
    const double magnified = view.arm.source_to_detector_m / view.arm.source_to_isocentre_m;
    const auto column = [&](double x_m) {
      return static_cast<int>(std::lround(0.5 * view.pixels + x_m * magnified / pixel_m));
    };
    const double throat = width_m(state.lag.shown, column(-0.0015), column(0.0015), pixel_m);
    const double healthy = 0.5 * (width_m(state.lag.shown, column(-0.03), column(-0.015), pixel_m) +
                                  width_m(state.lag.shown, column(0.015), column(0.03), pixel_m));
    out.push_back({std::string("xray-stenosis-") + (programme.mode == fluoro::Mode::cine ? "cine" : "fluoroscopy"),
                   100 * (1 - throat / healthy), 100 * narrowing, 5, "%"});
  }
  return out;
}

}  // namespace ostium::app::gates
