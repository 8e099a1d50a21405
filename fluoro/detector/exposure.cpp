#include "fluoro/detector/exposure.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace ostium::fluoro {

namespace {

constexpr double reference_point_m = 0.15;  // from the isocentre towards the source

/// Over the middle of the picture, where brightness is measured.
double geometric_mean_of_middle(const Plane& plane) {
  const Eigen::Index quarter = plane.rows() / 4, half = 2 * quarter;
  return std::exp(double(plane.block(quarter, quarter, half, half).max(1e-30f).log().mean()));
}

/// Air kerma at the detector per photon that left the tube; without a kernel, of the primary radiation only.
double kerma_through(const Beam& beam, const View& view, const PathLengths& coarse, const ScatterKernel* kernel) {
  const Plane stretch = ray_stretch(view);
  Plane kerma = Plane::Zero(stretch.rows(), stretch.cols());
  double open = 0;
  for (std::size_t b = 0; b < energies; ++b) {
    const float weight = beam.photons[b] * beam.kerma_Gy_m2[b];
    open += double(weight);
    kerma += weight * (-(beam.mu(Material::soft_tissue)[b] * coarse.soft_m() +
                         beam.mu(Material::cortical_bone)[b] * coarse.bone_m() +
                         beam.mu(Material::iodine)[b] * coarse.iodine_kg_m2()) *
                       stretch)
                          .exp();
  }
  if (!kernel) return geometric_mean_of_middle(kerma);
  Plane scattered;
  scatter({kerma, open, beam.hardened_soft_1_m, view.field_m}, *kernel, scattered);
  return geometric_mean_of_middle(kerma + scattered);
}

/// Thickness of soft tissue that transmits the same primary kerma.
double equivalent_thickness(const Beam& beam, double kerma) {
  double low = 0, high = 0.6;
  while (high - low > 1e-4) {
    const double middle = 0.5 * (low + high);
    double through = 0;
    for (std::size_t b = 0; b < energies; ++b)
      through +=
          double(beam.photons[b] * beam.kerma_Gy_m2[b]) * std::exp(-double(beam.mu(Material::soft_tissue)[b]) * middle);
    (through > kerma ? low : high) = middle;
  }
  return low;
}

/// Whole kilovolts, as in real systems; also limits the number of cached beams.
double tube_voltage(Mode mode, double patient_m) {
  const double kV = mode == Mode::cine ? 68 + 130 * (patient_m - 0.15) : 70 + 190 * (patient_m - 0.15);
  return std::round(std::clamp(kV, 64.0, 120.0));
}

}  // namespace

Programme fluoroscopy(double frames_per_s) { return {.frames_per_s = frames_per_s}; }

Programme cine(double frames_per_s) {
  return {.mode = Mode::cine,
          .frames_per_s = frames_per_s,
          .detector_dose_nGy = 300,  // estimate: a 21 cm patient then gets 180 mGy/min at 15 frames/s
          .copper_mm = 0.1,
          .lag = 0.05,
          .kerma_limit_Gy_s = 0.02};
}

void require_rate(double frames_per_s) {
  for (double rate : {3.75, 7.5, 15.0, 30.0})
    if (frames_per_s == rate) return;
  std::ostringstream what;
  what << "there is no frame rate of " << frames_per_s << " a second; expected 3.75, 7.5, 15 or 30";
  throw std::invalid_argument(what.str());
}

void check(const Collimator& c) {
  for (double edge : {c.left, c.right, c.top, c.bottom})
    if (!(edge > 0 && edge <= 0.5))
      throw std::invalid_argument(
          "collimator: each shutter stands more than 0 (closed) and at most 0.5 (the picture's edge) from the middle");
}

const Beam& Beams::operator()(const XrayTube& tube) {
  for (const auto& [made, beam] : made_)
    if (made == tube) return beam;
  return made_.emplace_back(tube, make_beam(tube, detector_)).second;
}

Exposure automatic_exposure(const Programme& programme, const View& view, const Collimator& collimator,
                            const PathLengths& coarse, const ScatterKernel& kernel, double grid_transmission,
                            Beams& beams) {
  View coarse_view = view;
  coarse_view.pixels = coarse_pixels;
  Exposure out;
  out.tube.copper_mm = programme.copper_mm;
  {
    const Beam& trial = beams(out.tube);
    out.patient_m = equivalent_thickness(trial, kerma_through(trial, coarse_view, coarse, nullptr));
  }
  out.tube.peak_kV = tube_voltage(programme.mode, out.patient_m);
  const Beam& beam = beams(out.tube);

  // Smaller fields are magnified more on screen and get more dose per pixel: proportional to 1 / field.
  const double wanted_nGy = programme.detector_dose_nGy * 0.2 / view.field_m;
  const double through = kerma_through(beam, coarse_view, coarse, &kernel) * grid_transmission;
  const double to_reference =
      std::pow(view.arm.source_to_detector_m / (view.arm.source_to_isocentre_m - reference_point_m), 2);
  const double limit = programme.kerma_limit_Gy_s / programme.frames_per_s / (to_reference * beam.kerma_out_Gy_m2);
  out.photons_per_m2 = std::min(1e-9 * wanted_nGy / through, limit);
  out.detector_dose_nGy = 1e9 * out.photons_per_m2 * through;
  out.kerma_Gy = out.photons_per_m2 * beam.kerma_out_Gy_m2 * to_reference;
  out.dose_area_Gy_m2 =
      out.photons_per_m2 * beam.kerma_out_Gy_m2 * view.field_m * view.field_m * collimator.open_share();
  return out;
}

void DoseMeter::add(const Programme& programme, const Exposure& exposure) {
  if (programme.mode == Mode::cine)
    ++cine_frames;
  else
    fluoroscopy_s += 1 / programme.frames_per_s;
  kerma_Gy += exposure.kerma_Gy;
  dose_area_Gy_m2 += exposure.dose_area_Gy_m2;
}

}  // namespace ostium::fluoro
