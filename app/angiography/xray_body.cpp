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

void set_still(const vascular::XrayBody& from, bool breathes, fluoro::Body& body) {
  fluoro::set_still(
      [&](int vertex) {
        const auto v = static_cast<std::size_t>(vertex);
        return (from.beat.empty() || from.beat[v].isZero(0)) &&
               (!breathes || from.breath.empty() || from.breath[v].isZero(0));
      },
      body);
}

void move(const vascular::XrayBody& from, double contraction, double breath_depth, fluoro::Body& body) {
  for (int vertex : *body.corners) {
    const auto v = static_cast<std::size_t>(vertex);
    Eigen::Vector3d p = from.mesh.vertices[v];
    if (!from.beat.empty()) p += contraction * from.beat[v];
    if (!from.breath.empty()) p += breath_depth * from.breath[v];
    body.p_P.col(vertex) = p.cast<float>();
  }
}

}  // namespace ostium::app
