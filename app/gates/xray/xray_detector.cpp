/// The detector's contributions, measured in pictures as a physicist would: noise, blur, lag, scatter.
#include <Eigen/Geometry>
#include <cmath>

#include "app/gates/gate.h"
#include "app/gates/xray/photon_transport.h"
#include "app/gates/xray/xray_water.h"

namespace ostium::app::gates {

namespace {

struct Statistics {
  double mean = 0, variance = 0;
};

/// Of the difference of two pictures in a central square, so that structure common to both (scatter's slow fall) does
/// not count as noise.
Statistics of_pair(const fluoro::Plane& a, const fluoro::Plane& b) {
  const Eigen::Index side = a.rows() / 2, from = a.rows() / 4;
  const Eigen::ArrayXXd first = a.block(from, from, side, side).cast<double>(),
                        second = b.block(from, from, side, side).cast<double>();
  const Eigen::ArrayXXd difference = first - second;
  const double mean = difference.mean();
  return {0.5 * (first.mean() + second.mean()),
          0.5 * (difference - mean).square().sum() / double(difference.size() - 1)};
}

fluoro::ImagerModel without_blur() {
  fluoro::ImagerModel model;
  model.detector_blur_m = 0;
  model.glare.share = 0;
  return model;
}

/// Least-squares line through the mean of the points.
double slope(const std::vector<Statistics>& points) {
  double mean = 0, variance = 0, up = 0, across = 0;
  for (const Statistics& p : points) {
    mean += p.mean / double(points.size());
    variance += p.variance / double(points.size());
  }
  for (const Statistics& p : points) {
    up += (p.mean - mean) * (p.variance - variance);
    across += (p.mean - mean) * (p.mean - mean);
  }
  return up / across;
}

}  // namespace

std::vector<data::GateResult> xray_noise(bool quick) {
  const double soft_m = 0.2;
  const fluoro::Scene water = slab(soft_m, fluoro::tissue::soft);
  fluoro::ImagerModel model = without_blur();
  model.scatter.per_m = model.scatter.per_m2 = 0;
  fluoro::Imager imager(model, fluoro::make_scanline_renderer());
  std::vector<Statistics> points;
  double effective_photons = 0;
  fluoro::Exposure exposure;
  Statistics at_30_nGy;
  for (double dose_nGy : {10.0, 20.0, 30.0, 60.0, 100.0, 170.0}) {
    fluoro::Programme programme = fluoro::fluoroscopy();
    programme.detector_dose_nGy = dose_nGy;
    programme.lag = 0;
    fluoro::ImagerState state;
    fluoro::Plane first;
    exposure = imager.frame({water, {}, {}, programme, 5}, state).exposure;
    first = state.lag.shown;
    imager.frame({water, {}, {}, programme, 5}, state);
    points.push_back(of_pair(first, state.lag.shown));
    if (dose_nGy == 30) at_30_nGy = points.back();
    if (quick && points.size() == 3) break;
  }
  // Variance over mean of an energy-integrating counter, in steps of 1 keV, in the picture's unit.
  const Absorbed behind = absorbed_by_keV(exposure.tube, model.detector, soft_m, 0, 0);
  const fluoro::Beam beam = make_beam(exposure.tube, model.detector);
  const double unit_keV = beam.open_keV() / beam.photons_absorbed();
  const double expected = behind.keV2 / behind.keV / unit_keV / model.detector.swank;
  effective_photons = at_30_nGy.mean * at_30_nGy.mean / at_30_nGy.variance;
  return {{"xray-noise-slope", slope(points) / expected, 1, 0.03, "1"},
          // 30 nGy per frame on 0.39 mm pixels: about 100 photons, 10 % noise.
          {"xray-noise-photons", effective_photons, 100, 15, "1"}};
}

std::vector<data::GateResult> xray_edge(bool) {
  // A steel foil covering one side of the picture, its edge 3 degrees from the columns, at the isocentre.
  const double tilt = 3 * 3.14159265358979 / 180;
  auto bodies = std::make_shared<std::vector<fluoro::Body>>();
  fluoro::phantom::Surface foil = fluoro::phantom::brick({0, -0.3, -0.0005}, {0.3, 0.3, 0.0005});
  const Eigen::Matrix3f turn = Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitZ()).matrix().cast<float>();
  foil.p_P = turn * foil.p_P;
  bodies->push_back(fluoro::phantom::body("foil", foil, {20, 0}, fluoro::tissue::air));  // as 20 mm of tissue
  const fluoro::Scene scene{bodies, {}, {}};
  fluoro::ImagerModel model;
  model.scatter.per_m = model.scatter.per_m2 = 0;
  model.glare.share = 0;  // its tails are no edge's
  fluoro::Imager imager(model, fluoro::make_scanline_renderer());
  fluoro::View view;
  view.pixels = 1024;
  fluoro::Programme bright = fluoro::cine();
  bright.detector_dose_nGy = 1e6;  // negligible noise
  fluoro::ImagerState state;
  imager.frame({scene, view, {}, bright, 1}, state);

  // Edge spread function, oversampled because of the tilt; the second moment of its derivative is the blur.
  const double pixel_m = view.field_m / view.pixels;
  constexpr int bins = 200;
  constexpr double bin_m = 0.02e-3;
  std::vector<double> sum(bins), count(bins);
  for (int row = 256; row < 768; ++row)
    for (int column = 256; column < 768; ++column) {
      const double x = (column + 0.5 - 512) * pixel_m, y = (512 - row - 0.5) * pixel_m;
      const int bin = static_cast<int>(std::floor((x * std::cos(tilt) + y * std::sin(tilt)) / bin_m + bins / 2.0));
      if (bin < 0 || bin >= bins) continue;
      sum[std::size_t(bin)] += double(state.lag.shown(row, column));
      count[std::size_t(bin)] += 1;
    }
  double weight = 0, first = 0, second = 0;
  for (std::size_t i = 0; i + 1 < bins; ++i) {
    const double step = sum[i] / count[i] - sum[i + 1] / count[i + 1], at = (double(i) + 1 - bins / 2.0) * bin_m;
    weight += step;
    first += step * at;
    second += step * at * at;
  }
  const double measured_m = std::sqrt(second / weight - std::pow(first / weight, 2));
  // Light in the scintillator, the uniform focal spot, the pixel's width.
  const double penumbra_m = model.focal_spot_m * (view.arm.source_to_detector_m / view.arm.source_to_isocentre_m - 1);
  const double set_m =
      std::sqrt(std::pow(model.detector_blur_m, 2) + (penumbra_m * penumbra_m + pixel_m * pixel_m) / 12);
  return {{"xray-edge", 1e3 * measured_m, 1e3 * set_m, 0.05 * 1e3 * set_m, "mm"}};
}

std::vector<data::GateResult> xray_glare(bool) {
  // An opaque plate covers one side of the picture. In its shadow, 10 mm from the edge, there is glare alone: the
  // share, times the part of a Gaussian beyond the edge. In the open, far away, nothing is missing.
  auto bodies = std::make_shared<std::vector<fluoro::Body>>();
  bodies->push_back(fluoro::phantom::body("plate", fluoro::phantom::brick({0, -0.3, -0.0005}, {0.3, 0.3, 0.0005}),
                                          {1e4, 0}, fluoro::tissue::air));
  const fluoro::Scene scene{bodies, {}, {}};
  const fluoro::View view;
  const auto pixels = [&](double m) { return static_cast<Eigen::Index>(std::lround(m / view.field_m * view.pixels)); };
  const auto at = [&](const fluoro::Plane& picture, double right_m) {
    return double(picture.block(view.pixels / 2 - 40, view.pixels / 2 + pixels(right_m) - 1, 80, 2).mean());
  };
  const auto picture_with = [&](double share) {
    fluoro::ImagerModel model;
    model.scatter.per_m = model.scatter.per_m2 = 0;
    model.glare.share = share;
    fluoro::Imager imager(model, fluoro::make_scanline_renderer());
    fluoro::ImagerState state;
    imager.frame({scene, view, {}, fluoro::cine(), 1}, state);
    return state.lag.shown;
  };
  const fluoro::GlareKernel kernel;
  const fluoro::Plane with = picture_with(kernel.share), without = picture_with(0);
  const double into_m = 0.01, open = at(without, -0.05);
  const double beyond = 0.5 * std::erfc(into_m / kernel.spread_m / std::sqrt(2.0));
  return {{"xray-glare-shadow", at(with, into_m) / open, kernel.share * beyond, 0.04 * kernel.share, "1"},
          {"xray-glare-open", at(with, -0.05) / open,
           1 - kernel.share * 0.5 * std::erfc(0.05 / kernel.spread_m / std::sqrt(2.0)), 0.005, "1"}};
}

std::vector<data::GateResult> xray_lag(bool) {
  // A wire appears that is too thin to affect automatic brightness: after n pictures its shadow is 1 - lag^n of the
  // final one.
  const fluoro::Scene without = slab(0.1, fluoro::tissue::soft);
  fluoro::Scene with = without;
  Eigen::Matrix3Xd axis(3, 2);
  axis << -0.05, 0.05, 0, 0, 0, 0;
  with.shafts.push_back({"wire", axis, {{0, 0.1, fluoro::Material::steel, 0.001, 0, 1}}, 0, {}});
  fluoro::Imager imager(without_blur(), fluoro::make_scanline_renderer());
  fluoro::Programme programme = fluoro::fluoroscopy();
  programme.detector_dose_nGy = 1e8;  // negligible noise
  programme.kerma_limit_Gy_s = 1e9;
  fluoro::View view;
  view.pixels = 128;
  const auto middle = [](const fluoro::Plane& picture) { return double(picture.block(63, 40, 2, 48).mean()); };
  fluoro::ImagerState state;
  imager.frame({without, view, {}, programme, 1}, state);
  const double before = middle(state.lag.shown);
  std::vector<double> shown;
  for (int n = 1; n <= 40; ++n) {
    imager.frame({with, view, {}, programme, 1}, state);
    shown.push_back(middle(state.lag.shown));
  }
  double worst = 0;
  for (int n = 1; n <= 6; ++n) {
    const double reached = (shown[std::size_t(n - 1)] - before) / (shown.back() - before);
    worst = std::max(worst, std::fabs(reached - (1 - std::pow(programme.lag, n))));
  }
  return {{"xray-lag", worst, 0, 0.002, "1"}};
}

std::vector<data::GateResult> xray_scatter(bool quick) {
  std::vector<data::GateResult> out;
  for (double soft_m : {0.1, 0.2, 0.3}) {
    if (quick && soft_m != 0.2) continue;
    SlabExperiment experiment;
    experiment.slab_m = soft_m;
    const SlabResult transport = through_slab(experiment, quick ? 300'000 : 1'000'000, 3);
    constexpr std::size_t half_field = 9;  // 10 cm
    const double reference = transport.scatter_keV * transport.share_within[half_field] / transport.primary_keV;
    const fluoro::Beam beam = make_beam(experiment.tube, experiment.detector);
    const Absorbed behind = absorbed_by_keV(experiment.tube, experiment.detector, soft_m, 0, 0);
    fluoro::Plane scattered;
    fluoro::scatter(
        {fluoro::Plane::Constant(64, 64, static_cast<float>(behind.keV)), beam.open_keV(), beam.hardened_soft_1_m, 0.2},
        {}, scattered);
    const double middle = double(scattered.block(30, 30, 4, 4).mean()) / behind.keV;
    out.push_back({"xray-scatter-" + std::to_string(int(std::lround(100 * soft_m))) + "cm", middle, reference,
                   0.12 * reference, "1"});
  }
  return out;
}

}  // namespace ostium::app::gates
