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

/// Sets what of a body rests (Body::still): vertices without beat and, if the patient breathes, without breath.
void set_still(const vascular::XrayBody& from, bool breathes, fluoro::Body& body);
/// Moves its other vertices, by a contraction (heart_cycle.h) and a depth of breath.
void move(const vascular::XrayBody& from, double contraction, double breath_depth, fluoro::Body& body);

}  // namespace ostium::app
