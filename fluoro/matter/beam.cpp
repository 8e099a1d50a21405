#include "fluoro/matter/beam.h"

#include <Eigen/Core>
#include <cmath>

#include "core/math/dense.h"

namespace ostium::fluoro {

namespace {

struct Quadrature {
  Eigen::VectorXd nodes, weights;
};

/// Golub and Welsch: the nodes are the eigenvalues of the Jacobi matrix of the polynomials orthogonal under `weights`
/// at `points`, the weights come from the first components of its eigenvectors.
Quadrature gauss(const Eigen::ArrayXd& points, const Eigen::ArrayXd& weights, int count) {
  const double total = weights.sum();
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(count, count);
  Eigen::ArrayXd before = Eigen::ArrayXd::Zero(points.size());
  Eigen::ArrayXd polynomial = Eigen::ArrayXd::Constant(points.size(), 1 / std::sqrt(total));
  double off_diagonal = 0;
  for (int k = 0; k < count; ++k) {
    jacobi(k, k) = (weights * points * polynomial.square()).sum();
    const Eigen::ArrayXd next = (points - jacobi(k, k)) * polynomial - off_diagonal * before;
    off_diagonal = std::sqrt((weights * next.square()).sum());
    if (k + 1 < count) jacobi(k, k + 1) = jacobi(k + 1, k) = off_diagonal;
    before = polynomial;
    polynomial = next / off_diagonal;
  }
  const core::SymmetricEigen eigen = core::eigen_of_symmetric(jacobi);
  return {eigen.values, total * eigen.vectors.row(0).transpose().array().square()};
}

/// The energy at which soft tissue has that attenuation, which decreases with energy.
double energy_where(const Spectrum& s, const Eigen::ArrayXd& soft, double soft_1_m) {
  Eigen::Index i = 0;
  while (i + 2 < soft.size() && soft[i + 1] > soft_1_m) ++i;
  return s.energy_keV[i] + (soft_1_m - soft[i]) / (soft[i + 1] - soft[i]) * (s.energy_keV[i + 1] - s.energy_keV[i]);
}

}  // namespace

double absorbed_share(const Detector& detector, double energy_keV) {
  return 1 - std::exp(-attenuation_1_m(Material::caesium_iodide, energy_keV) * detector.packing * 1e-3 *
                      detector.caesium_iodide_mm);
}

double Beam::open_keV() const {
  double sum = 0;
  for (std::size_t b = 0; b < energies; ++b) sum += double(photons[b]) * energy_keV[b];
  return sum;
}

double Beam::photons_absorbed() const {
  double sum = 0;
  for (float n : photons) sum += double(n);
  return sum;
}

Beam make_beam(const XrayTube& tube, const Detector& detector, double hardening_m) {
  const Spectrum s = spectrum(tube);
  Eigen::ArrayXd soft(s.photons.size()), arriving_keV(s.photons.size());
  Beam beam;
  for (Eigen::Index i = 0; i < s.photons.size(); ++i) {
    const double energy = s.energy_keV[i];
    soft[i] = attenuation_1_m(Material::soft_tissue, energy);
    arriving_keV[i] = s.photons[i] * absorbed_share(detector, energy) * energy * std::exp(-soft[i] * hardening_m);
    beam.kerma_out_Gy_m2 += s.photons[i] / s.photons.sum() * air_kerma_Gy_m2(energy);
  }
  const Quadrature q = gauss(soft, arriving_keV / s.photons.sum(), energies);
  for (std::size_t b = 0; b < energies; ++b) {
    const double energy = energy_where(s, soft, q.nodes[Eigen::Index(b)]);
    beam.energy_keV[b] = static_cast<float>(energy);
    beam.photons[b] =
        static_cast<float>(q.weights[Eigen::Index(b)] * std::exp(q.nodes[Eigen::Index(b)] * hardening_m) / energy);
    for (std::size_t m = 0; m < materials; ++m)
      beam.mu_1_m[m][b] = static_cast<float>(attenuation_1_m(static_cast<Material>(m), energy));
    beam.kerma_Gy_m2[b] = static_cast<float>(air_kerma_Gy_m2(energy) / absorbed_share(detector, energy));
  }
  beam.hardened_soft_1_m = std::log(beam.open_keV() / q.weights.sum()) / hardening_m;
  return beam;
}

}  // namespace ostium::fluoro
