#pragma once
/// A polygon as triangles.
#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

namespace ostium::vascular {

/// Indices of corners, three a triangle, in the polygon's sense of rotation: ears are cut off one after another, so
/// that one with dents keeps them. What is no simple polygon, or has a thousand corners, becomes a fan.
std::vector<std::array<std::size_t, 3>> triangulated(std::span<const Eigen::Vector3d> corners);

}  // namespace ostium::vascular
