/// Whether an unfilled guide is seen: by an observer who knows what it looks like and weighs each pixel by that, in
/// noise that is the same everywhere and in no two pixels alike (the ideal observer of ICRU report 54). What a piece of
/// the shaft takes away, squared and summed over pixels, over the noise's variance, is the square of its detectability.
/// A piece is as long as the guide is wide: if each is seen, the guide is, whatever lies behind it elsewhere.
#include <cmath>

#include "app/gates/gate.h"
#include "app/gates/xray/xray_water.h"
#include "app/session/scene/xray_scene.h"
#include "data/catalogue/catalogue.h"

namespace ostium::app::gates {

namespace {

constexpr double soft_m = 0.2, half_length_m = 0.005;

/// One along its axis from the picture's left to its right.
fluoro::Scene with_guide(const fluoro::Scene& without) {
  fluoro::Scene scene = without;
  Eigen::Matrix3Xd axis(3, 2);
  axis << 0.1, -0.1, 0, 0, 0, 0;
  scene.shafts.push_back(
      {"guide", axis, sections_of(data::find_instrument(data::load_catalogue(), "guide-jr4-6f")), 0, {}});
  return scene;
}

/// Sum of the squares of what the guide takes away, relative to what is there without it.
double squares(const fluoro::ImagerModel& model) {
  const fluoro::Scene without = slab(soft_m, fluoro::tissue::soft), with = with_guide(without);
  fluoro::Programme programme = fluoro::fluoroscopy();
  programme.detector_dose_nGy = 1e8;  // negligible noise
  programme.kerma_limit_Gy_s = 1e9;
  const auto shown = [&](const fluoro::Scene& scene) {
    fluoro::Imager imager(model, fluoro::make_scanline_renderer());
    fluoro::ImagerState state;
    imager.frame({scene, {}, {}, programme, 1}, state);
    return state.lag.shown;
  };
  const fluoro::View view;
  const double magnified = view.arm.source_to_detector_m / view.arm.source_to_isocentre_m;
  const int half = static_cast<int>(std::lround(half_length_m * magnified / view.field_m * view.pixels));
  const fluoro::Plane lost = (1 - shown(with) / shown(without)).block(view.pixels / 2 - 16, 256 - half, 32, 2 * half);
  return double(lost.cast<double>().square().sum());
}

/// The same from the ring's chord in steps of 0.01 mm, blurred by focal spot and pixel.
double squares_by_chord(const fluoro::ImagerModel& model) {
  const fluoro::View view;
  const std::vector<fluoro::OpaqueSection> rings =
      sections_of(data::find_instrument(data::load_catalogue(), "guide-jr4-6f"));
  const fluoro::Programme programme = fluoro::fluoroscopy();
  fluoro::Imager imager(model, fluoro::make_scanline_renderer());
  const fluoro::XrayTube tube = imager.exposure({slab(soft_m, fluoro::tissue::soft), {}, {}, programme, 1}).tube;
  const fluoro::Beam beam = make_beam(tube, model.detector);
  const double magnified = view.arm.source_to_detector_m / view.arm.source_to_isocentre_m,
               pixel_m = view.field_m / view.pixels / magnified, step_m = 1e-5;
  const auto chord = [](double radius, double d) { return d < radius ? 2 * std::sqrt(radius * radius - d * d) : 0.0; };
  constexpr int points = 1000;
  Eigen::ArrayXd lost(points);
  for (int i = 0; i < points; ++i) {
    const double d = std::fabs((i - 0.5 * (points - 1)) * step_m);
    double open = 0, left = 0;
    for (std::size_t b = 0; b < fluoro::energies; ++b) {
      const double arrives = double(beam.photons[b] * beam.energy_keV[b]) *
                             std::exp(-double(beam.mu(fluoro::Material::soft_tissue)[b]) * soft_m);
      double depth = 0;
      for (const fluoro::OpaqueSection& ring : rings)
        if (ring.to_tip_m > 0.1)  // the shaft's, not the tip's
          depth += double(beam.mu(ring.material)[b]) * ring.filling *
                   (chord(ring.outer_radius_m, d) - chord(ring.inner_radius_m, d));
      open += arrives, left += arrives * std::exp(-depth);
    }
    lost[i] = 1 - left / open;
  }
  // A pixel's mean, then a focal spot's and a pixel's width, by Gaussians of their variances.
  const double penumbra_m = model.focal_spot_m * (magnified - 1) / magnified;
  const double sigma_m = std::sqrt((penumbra_m * penumbra_m + 2 * pixel_m * pixel_m) / 12);
  Eigen::ArrayXd blurred = Eigen::ArrayXd::Zero(points);
  for (int i = 0; i < points; ++i)
    for (int k = 0; k < points; ++k)
      blurred[i] += lost[k] * std::exp(-0.5 * std::pow((i - k) * step_m / sigma_m, 2)) * step_m / sigma_m /
                    std::sqrt(2 * 3.14159265358979);
  return blurred.square().sum() * step_m * 2 * half_length_m / (pixel_m * pixel_m);
}

}  // namespace

std::vector<data::GateResult> xray_guide(bool) {
  // Counted by a pixel, in effect (the gate xray-noise-photons); 2 mm of the length that was summed over.
  constexpr double photons = 100, share = 0.002 / (2 * half_length_m);
  fluoro::ImagerModel sharp;
  sharp.detector_blur_m = 0;
  fluoro::ImagerModel bare = sharp;
  bare.scatter.per_m = bare.scatter.per_m2 = 0, bare.glare.share = 0;
  const auto detectability = [&](double sum) { return std::sqrt(photons * share * sum); };
  const double exact = detectability(squares_by_chord(bare));
  return {{"xray-guide-observer", detectability(squares(bare)), exact, 0.03 * exact, "1"},
          // With scatter and glare. Rose's criterion: at least five standard deviations; more than ten is no polymer's.
          {"xray-guide-rose", detectability(squares(sharp)), 7.5, 2.5, "1"}};
}

}  // namespace ostium::app::gates
