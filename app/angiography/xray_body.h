#pragma once
/// Converts a patient's bodies to fluoro's.
#include <memory>
#include <vector>

#include "fluoro/matter/scene.h"
#include "vascular/thorax/thorax.h"

namespace ostium::app {

std::shared_ptr<const fluoro::Triangles> triangles_of(const std::vector<std::array<int, 3>>& triangles);
Eigen::Matrix3Xf points_of(const std::vector<Eigen::Vector3d>& points);

/// With the body's own triangles, or with triangles already converted and other points.
fluoro::Body body_of(const vascular::XrayBody& body);
fluoro::Body body_of(const vascular::XrayBody& body, std::shared_ptr<const fluoro::Triangles> triangles,
                     const std::vector<Eigen::Vector3d>& points);

}  // namespace ostium::app
