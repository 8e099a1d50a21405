#include "vascular/thorax/vertebra.h"

#include <algorithm>
#include <cmath>

#include "vascular/thorax/shapes.h"

namespace ostium::vascular {

double from_vertebra_mm(Eigen::Vector3d p) {
  p.x() = std::fabs(p.x());
  constexpr double wide = 16.2, high = 10.9, deep = 14.8, hollow = 2.2;
  // Waisted, with hollow end plates and a flat back.
  const double waist = 1 - 0.10 * (1 - std::pow(p.y() / high, 2));
  const double z = p.z() > 0 ? p.z() / deep : p.z() / (deep - 2);
  const double out = std::pow(std::pow(p.x() / wide, 2.9) + std::pow(std::fabs(z), 2.7), 1 / 2.7) / waist;
  const double side = (out - 1) * 12.5, end = std::fabs(p.y()) - high + hollow * std::max(0.0, 1 - out * out);
  const double body = -joined(-side, -end, 3.5);
  const auto rod = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius_a, double radius_b,
                       const Eigen::Vector3d& scale) {
    return from_rod(p.cwiseProduct(scale), a.cwiseProduct(scale), b.cwiseProduct(scale), radius_a, radius_b) /
           scale.maxCoeff();
  };
  const Eigen::Vector3d round = Eigen::Vector3d::Ones();
  double arch = rod({9.5, 4, -9}, {10.5, 4.5, -22}, 3.1, 3.3, {1, 0.68, 1});           // pedicle
  arch = joined(arch, rod({11, 11, -23}, {11.5, -9, -25}, 3.6, 3.2, {1, 1, 1.3}), 4);  // articular processes
  arch = joined(arch, rod({11, 3, -25}, {0, -2, -33}, 2.4, 2.8, {1, 0.5, 1}), 3);      // lamina
  arch = joined(arch, rod({13, 4, -25}, {29, 8, -36}, 3.4, 4.0, round), 4);            // transverse process
  arch = joined(arch, rod({0, -2, -33}, {0, -21, -52}, 3.4, 3.8, {1.5, 0.9, 1}), 3);   // spinous process
  return joined(body, arch, 3);
}

}  // namespace ostium::vascular
