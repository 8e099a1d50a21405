#include "app/angiography/xray_body.h"

#include <utility>

#include "fluoro/matter/tissue.h"

namespace ostium::app {

namespace {

fluoro::Tissue tissue_of(vascular::BodyTissue tissue) {
  switch (tissue) {
    case vascular::BodyTissue::air:
      return fluoro::tissue::air;
    case vascular::BodyTissue::soft_tissue:
      return fluoro::tissue::soft;
    case vascular::BodyTissue::lung:
      return fluoro::tissue::lung;
    case vascular::BodyTissue::blood:
      return fluoro::tissue::blood;
    case vascular::BodyTissue::muscle:
      return fluoro::tissue::muscle;
    case vascular::BodyTissue::fat:
      return fluoro::tissue::thin_fat;
    case vascular::BodyTissue::cortical_bone:
      return fluoro::tissue::cortical_bone;
    case vascular::BodyTissue::spongy_bone:
      return fluoro::tissue::spongy_bone;
    case vascular::BodyTissue::loose_bone:
      return fluoro::tissue::loose_bone;
  }
  return fluoro::tissue::soft;
}

}  // namespace

std::shared_ptr<const fluoro::Triangles> triangles_of(const std::vector<std::array<int, 3>>& triangles) {
  auto out = std::make_shared<fluoro::Triangles>(3, triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) (*out)(k, static_cast<Eigen::Index>(t)) = triangles[t][static_cast<std::size_t>(k)];
  return out;
}

Eigen::Matrix3Xf points_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xf out(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) out.col(static_cast<Eigen::Index>(i)) = points[i].cast<float>();
  return out;
}

fluoro::Body body_of(const vascular::XrayBody& body, std::shared_ptr<const fluoro::Triangles> triangles,
                     const std::vector<Eigen::Vector3d>& points) {
  fluoro::Tissue tissue = tissue_of(body.tissue);
  const auto density = static_cast<float>(body.density);
  tissue.soft *= density, tissue.bone *= density;
  return {.name = body.name,
          .triangles = std::move(triangles),
          .p_P = points_of(points),
          .tissue = tissue,
          .within = tissue_of(body.within),
          .contrast = {}};
}

fluoro::Body body_of(const vascular::XrayBody& body) {
  return body_of(body, triangles_of(body.mesh.triangles), body.mesh.vertices);
}

fluoro::Body body_of(const vascular::Twigs& twigs) {
  fluoro::Body body{.name = "twigs",
                    .triangles = triangles_of(twigs.mesh.triangles),
                    .p_P = points_of(twigs.mesh.vertices),
                    .tissue = fluoro::tissue::blood,
                    .within = fluoro::tissue::blood,
                    .contrast = {}};
  body.contrast.iodine_kg_m3 = Eigen::VectorXf::Zero(body.p_P.cols());
  body.contrast.p_PC = body.p_P;
  return body;
}

void place(const vascular::Twigs& twigs, const std::vector<Eigen::Vector3d>& vertices, fluoro::Body& body) {
  body.p_P = points_of(vertices);
  for (std::size_t t = 0; t < twigs.size(); ++t) {
    const Eigen::Index first = twigs.first[t], count = twigs.first[t + 1] - first;
    body.contrast.p_PC.middleCols(first, count).colwise() = Eigen::Vector3f(body.p_P.col(first));
  }
}

}  // namespace ostium::app
