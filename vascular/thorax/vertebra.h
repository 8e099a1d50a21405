#pragma once
#include <Eigen/Core>

namespace ostium::vascular {

/// Distance in mm, negative inside, to a thoracic vertebra: waisted body with hollow end plates, pedicles, articular,
/// transverse and spinous processes. Millimetres about the middle of its body: x to a side, y to the head, z to the
/// front. Its body is 22 mm high, 32 wide and 28 deep [usual size, from memory].
double from_vertebra_mm(Eigen::Vector3d p);

}  // namespace ostium::vascular
