#pragma once
/// Converts a patient's bodies to fluoro's.
#include <memory>
#include <vector>

#include "fluoro/matter/scene.h"
#include "vascular/thorax/thorax.h"
#include "vascular/twigs/twigs.h"

namespace ostium::app {

std::shared_ptr<const fluoro::Triangles> triangles_of(const std::vector<std::array<int, 3>>& triangles);
Eigen::Matrix3Xf points_of(const std::vector<Eigen::Vector3d>& points);

/// With the body's own triangles, or with triangles already converted and other points.
fluoro::Body body_of(const vascular::XrayBody& body);
fluoro::Body body_of(const vascular::XrayBody& body, std::shared_ptr<const fluoro::Triangles> triangles,
                     const std::vector<Eigen::Vector3d>& points);

/// Twigs are contrast alone: without any they are not seen.
fluoro::Body body_of(const vascular::Twigs& twigs);
/// Sets the iodine of each twig by the lumen's vertex from which it comes.
template <class IodineAt>
void fill(const vascular::Twigs& twigs, IodineAt iodine_at, fluoro::Body& body) {
  for (std::size_t t = 0; t < twigs.size(); ++t)
    body.contrast.iodine_kg_m3.segment(twigs.first[t], twigs.first[t + 1] - twigs.first[t])
        .setConstant(static_cast<float>(iodine_at(twigs.root[t])));
}
/// Moves them there. Each is filled evenly, so its depths are counted from any point of it.
void place(const vascular::Twigs& twigs, const std::vector<Eigen::Vector3d>& vertices, fluoro::Body& body);

}  // namespace ostium::app
