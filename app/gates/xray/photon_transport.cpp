#include "app/gates/xray/photon_transport.h"

#include <xraylib.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>

#include "core/base/units.h"

namespace ostium::app::gates {

using Eigen::Vector3d;

namespace {

constexpr const char* tissue = "Tissue, Soft (ICRP)";
using units::pi;

/// Cross-sections and angles in steps of 1 keV.
class Interactions {
 public:
  Interactions() {
    for (int keV = lowest_keV; keV <= highest_keV; ++keV) {
      Row row;
      const double photo = CS_Photo_CP(tissue, keV, nullptr), compton = CS_Compt_CP(tissue, keV, nullptr),
                   rayleigh = CS_Rayl_CP(tissue, keV, nullptr);
      row.per_m = 100 * (photo + compton + rayleigh);  // 1 g/cm3
      row.photo = photo / (photo + compton + rayleigh);
      row.compton = row.photo + compton / (photo + compton + rayleigh);
      row.compton_angle = cumulative([&](double angle) { return DCS_Compt_CP(tissue, keV, angle, nullptr); });
      row.rayleigh_angle = cumulative([&](double angle) { return DCS_Rayl_CP(tissue, keV, angle, nullptr); });
      rows_.push_back(row);
    }
  }

  static constexpr int lowest_keV = 10, highest_keV = 125, angles = 360;
  using Cumulative = std::array<double, angles + 1>;
  struct Row {
    double per_m, photo, compton;  // the latter two cumulative probabilities
    Cumulative compton_angle, rayleigh_angle;
  };
  const Row& at(double keV) const {
    return rows_[static_cast<std::size_t>(std::clamp(std::lround(keV), long(lowest_keV), long(highest_keV)) -
                                          lowest_keV)];
  }

  static double draw(const Cumulative& cumulative, double u) {
    const auto above = std::upper_bound(cumulative.begin(), cumulative.end(), u) - cumulative.begin();
    const auto i = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 1, angles));
    const double share = (u - cumulative[i - 1]) / std::max(cumulative[i] - cumulative[i - 1], 1e-300);
    return (double(i - 1) + share) * pi / angles;
  }

 private:
  template <typename PerSteradian>
  static Cumulative cumulative(PerSteradian&& per_steradian) {
    Cumulative out{};
    for (std::size_t i = 0; i < angles; ++i) {
      const double angle = (double(i) + 0.5) * pi / angles;
      out[i + 1] = out[i] + per_steradian(angle) * std::sin(angle);
    }
    for (double& c : out) c /= out.back();
    return out;
  }
  std::vector<Row> rows_;
};

Vector3d turned(const Vector3d& direction, double polar, double azimuth) {
  const Vector3d across = direction.unitOrthogonal(), other = direction.cross(across);
  return std::cos(polar) * direction + std::sin(polar) * (std::cos(azimuth) * across + std::sin(azimuth) * other);
}

/// Lead strips run along y and point at the source: the shadow on a photon is proportional to its angle from their
/// plane.
double through_grid(const SlabExperiment& e, const Vector3d& at_detector, const Vector3d& direction) {
  const double along_strips = at_detector.x() / e.source_to_detector_m;
  const double off = std::fabs(direction.x() / direction.z() - along_strips);
  return e.grid_transmission * std::max(0.0, 1 - e.grid_ratio * off);
}

}  // namespace

SlabResult through_slab(const SlabExperiment& e, long photons, std::uint64_t seed) {
  static const Interactions interactions;
  const fluoro::Spectrum s = spectrum(e.tube);
  std::vector<double> cumulative{0};
  for (double n : s.photons) cumulative.push_back(cumulative.back() + n);
  SlabResult out;
  for (double half = 0.01; half <= 0.301; half += 0.01) out.half_side_m.push_back(half);
  out.share_within.assign(out.half_side_m.size(), 0);
  for (Eigen::Index i = 0; i < s.photons.size(); ++i)
    out.primary_keV += s.photons[i] / cumulative.back() * absorbed_share(e.detector, s.energy_keV[i]) *
                       s.energy_keV[i] * e.grid_transmission *
                       std::exp(-interactions.at(s.energy_keV[i]).per_m * e.slab_m);

  std::mt19937_64 random(seed);
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  const double front = e.source_to_isocentre_m - 0.5 * e.slab_m, back = front + e.slab_m;
  double energies_sum = 0, weights_sum = 0;
  for (long n = 0; n < photons; ++n) {
    const double pick = uniform() * cumulative.back();
    const auto bin = std::upper_bound(cumulative.begin(), cumulative.end(), pick) - cumulative.begin() - 1;
    double keV = s.energy_keV[std::min<Eigen::Index>(bin, s.photons.size() - 1)];
    Vector3d at(0, 0, front), direction(0, 0, 1);
    for (bool scattered = false;; scattered = true) {
      const Interactions::Row& row = interactions.at(keV);
      at -= std::log(1 - uniform()) / row.per_m * direction;
      if (at.z() < front) break;
      if (at.z() > back) {
        if (!scattered || direction.z() <= 0) break;
        at += (e.source_to_detector_m - at.z()) / direction.z() * direction;
        const double arrives = keV * absorbed_share(e.detector, keV) * through_grid(e, at, direction);
        out.scatter_keV += arrives / double(photons);
        energies_sum += arrives * keV;
        weights_sum += arrives;
        const double far = std::max(std::fabs(at.x()), std::fabs(at.y()));
        for (std::size_t k = 0; k < out.half_side_m.size(); ++k)
          if (far < out.half_side_m[k]) out.share_within[k] += arrives / double(photons);
        break;
      }
      const double kind = uniform();
      if (kind < row.photo) break;
      if (kind < row.compton) {
        const double angle = Interactions::draw(row.compton_angle, uniform());
        direction = turned(direction, angle, 2 * pi * uniform()).normalized();
        keV /= 1 + keV / 510.999 * (1 - std::cos(angle));
        if (keV < Interactions::lowest_keV) break;
      } else {
        direction =
            turned(direction, Interactions::draw(row.rayleigh_angle, uniform()), 2 * pi * uniform()).normalized();
      }
    }
  }
  for (double& share : out.share_within) share /= std::max(out.scatter_keV, 1e-300);
  out.mean_energy_keV = energies_sum / std::max(weights_sum, 1e-300);
  return out;
}

}  // namespace ostium::app::gates
