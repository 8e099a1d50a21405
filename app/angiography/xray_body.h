#pragma once
/// A patient's bodies as fluoro's.
#include <memory>
#include <vector>

#include "fluoro/scene.h"
#include "vascular/thorax/thorax.h"

namespace ostium {

std::shared_ptr<const Triangles> triangles_of(const std::vector<std::array<int, 3>>& triangles);
Eigen::Matrix3Xf points_of(const std::vector<Eigen::Vector3d>& points);

/// With its own triangles, or with those that were made of them, and other points.
Body body_of(const XrayBody& body);
Body body_of(const XrayBody& body, std::shared_ptr<const Triangles> triangles,
             const std::vector<Eigen::Vector3d>& points);

}  // namespace ostium
