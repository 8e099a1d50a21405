#include "fluoro/detector/imager.h"

#include <cmath>

#include "fluoro/base/resample.h"

namespace ostium::fluoro {

namespace {

/// For automatic brightness vessels are too thin to matter.
bool is_wide(const Body& body) { return body.contrast.iodine_kg_m3.size() == 0; }

}  // namespace

Imager::Imager(const ImagerModel& model, std::unique_ptr<PathLengthRenderer> renderer)
    : model_(model),
      renderer_(std::move(renderer)),
      coarse_renderer_(make_scanline_renderer()),
      beams_(model.detector) {}

Imager::~Imager() = default;

FrameReport Imager::frame(const FrameInput& in, ImagerState& state) {
  FrameReport report;
  report.exposure = exposure(in);
  const Beam& beam = beams_(report.exposure.tube);
  draw(in);
  shafts_.draw(in.view, beam, in.scene.shafts, in.programme.pulse_s);
  attenuate(beam, stretch_, lengths_, shafts_, primary_);
  if (primary_.leaks) report.leak = find_leak(lengths_);
  collimate(in);
  if (shuttered_) {
    primary_.signal_keV *= exposed_;
    primary_.variance_keV2 *= exposed_;
  }

  // Focal spot and pixel width blur before the photons are counted.
  const double pixel_m = in.view.field_m / in.view.pixels;
  const double penumbra_m =
      model_.focal_spot_m * (in.view.arm.source_to_detector_m / in.view.arm.source_to_isocentre_m - 1);
  const double before = std::hypot(penumbra_m, pixel_m) / std::sqrt(12.0) / pixel_m;
  gaussian_blur(primary_.signal_keV, before, Beyond::same, scratch_);
  scatter({primary_.signal_keV, beam.open_keV(), beam.hardened_soft_1_m, in.view.field_m}, model_.scatter, scattered_);
  count_photons({in.seed, state.frame},
                {.signal_keV = primary_.signal_keV,
                 .variance_keV2 = primary_.variance_keV2,
                 .scatter_keV = scattered_,
                 .photons = report.exposure.photons_per_m2 * model_.grid_transmission * pixel_m * pixel_m,
                 .unit_keV = beam.open_keV() / beam.photons_absorbed(),
                 .swank = model_.detector.swank},
                counted_);
  gaussian_blur(counted_, model_.detector_blur_m / pixel_m, Beyond::same, scratch_);
  add_glare(model_.glare, in.view.field_m, counted_, scratch_);
  state.lag.add(counted_, in.programme.lag);
  ++state.frame;
  return report;
}

Exposure Imager::exposure(const FrameInput& in) {
  View coarse_view = in.view;
  coarse_view.pixels = coarse_pixels;
  if (!(coarse_view == coarse_view_) || in.scene.fixed != coarse_fixed_) {
    coarse_fixed_lengths_ = PathLengths(coarse_pixels);
    if (in.scene.fixed) coarse_renderer_->add(coarse_view, *in.scene.fixed, coarse_fixed_lengths_);
    for (const Body& body : in.scene.moving)
      if (is_wide(body)) coarse_renderer_->add(coarse_view, {&body, 1}, coarse_fixed_lengths_, Parts::still);
    coarse_view_ = coarse_view;
    coarse_fixed_ = in.scene.fixed;
  }
  coarse_ = coarse_fixed_lengths_;
  for (const Body& body : in.scene.moving)
    if (is_wide(body)) coarse_renderer_->add(coarse_view, {&body, 1}, coarse_, Parts::moving);
  return automatic_exposure(in.programme, in.view, in.collimator, coarse_, model_.scatter, model_.grid_transmission,
                            beams_);
}

void Imager::draw(const FrameInput& in) {
  if (!(in.view == view_) || in.scene.fixed != fixed_) {
    fixed_lengths_ = PathLengths(in.view.pixels);
    if (in.scene.fixed) renderer_->add(in.view, *in.scene.fixed, fixed_lengths_);
    renderer_->add(in.view, in.scene.moving, fixed_lengths_, Parts::still);
    stretch_ = ray_stretch(in.view);
    exposed_.resize(0, 0);
    view_ = in.view;
    fixed_ = in.scene.fixed;
  }
  lengths_ = fixed_lengths_;
  if (!in.scene.moving.empty()) renderer_->add(in.view, in.scene.moving, lengths_, Parts::moving);
}

void Imager::collimate(const FrameInput& in) {
  if (exposed_.size() && in.collimator == collimator_) return;
  collimator_ = in.collimator;
  const int pixels = in.view.pixels;
  shuttered_ = !(in.collimator == Collimator{});
  exposed_ = Plane::Zero(pixels, pixels);
  const auto edge = [&](double share) { return static_cast<int>(std::round((0.5 + share) * pixels)); };
  const int top = edge(-in.collimator.top), bottom = edge(in.collimator.bottom), left = edge(-in.collimator.left),
            right = edge(in.collimator.right);
  exposed_.block(top, left, bottom - top, right - left).setOnes();
  gaussian_blur(exposed_, model_.shutter_blur_m / in.view.field_m * pixels, Beyond::same, scratch_);
}

std::string Imager::leaking(const FrameInput& in) {
  std::string names;
  const auto look = [&](const Body& body) {
    PathLengths alone(in.view.pixels);
    renderer_->add(in.view, {&body, 1}, alone);
    if ((alone.unmatched() != 0).any()) names += (names.empty() ? "" : ", ") + body.name;
  };
  if (in.scene.fixed)
    for (const Body& body : *in.scene.fixed) look(body);
  for (const Body& body : in.scene.moving) look(body);
  if (names.empty()) names = "none alone: something lies outside what it should be within";
  return names;
}

}  // namespace ostium::fluoro
