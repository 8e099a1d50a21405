#include "app/angiography/xray_body.h"

#include <utility>

#include "fluoro/tissue.h"

namespace ostium {

namespace {

Tissue tissue_of(BodyTissue tissue) {
  switch (tissue) {
    case BodyTissue::air:
      return tissue::air;
    case BodyTissue::soft_tissue:
      return tissue::soft;
    case BodyTissue::lung:
      return tissue::lung;
    case BodyTissue::blood:
      return tissue::blood;
    case BodyTissue::cortical_bone:
      return tissue::cortical_bone;
    case BodyTissue::spongy_bone:
      return tissue::spongy_bone;
    case BodyTissue::loose_bone:
      return tissue::loose_bone;
  }
  return tissue::soft;
}

}  // namespace

std::shared_ptr<const Triangles> triangles_of(const std::vector<std::array<int, 3>>& triangles) {
  auto out = std::make_shared<Triangles>(3, triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) (*out)(k, static_cast<Eigen::Index>(t)) = triangles[t][static_cast<std::size_t>(k)];
  return out;
}

Eigen::Matrix3Xf points_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xf out(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) out.col(static_cast<Eigen::Index>(i)) = points[i].cast<float>();
  return out;
}

Body body_of(const XrayBody& body, std::shared_ptr<const Triangles> triangles,
             const std::vector<Eigen::Vector3d>& points) {
  return {.name = body.name,
          .triangles = std::move(triangles),
          .p_P = points_of(points),
          .tissue = tissue_of(body.tissue),
          .within = tissue_of(body.within),
          .contrast = {}};
}

Body body_of(const XrayBody& body) { return body_of(body, triangles_of(body.mesh.triangles), body.mesh.vertices); }

}  // namespace ostium
