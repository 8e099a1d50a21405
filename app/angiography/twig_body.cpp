#include "app/angiography/twig_body.h"

#include "fluoro/matter/tissue.h"

namespace ostium::app {

void TwigBody::fill(const std::function<float(int root)>& iodine_at) {
  std::vector<std::size_t> filled;
  std::vector<float> kg_m3;
  for (std::size_t t = 0; t < twigs_->size(); ++t)
    if (const float iodine = iodine_at(twigs_->root[t]); iodine > fluoro::faintest_iodine_kg_m3)
      filled.push_back(t), kg_m3.push_back(iodine);
  if (filled != filled_) join(filled);
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < filled_.size(); ++i) {
    const Eigen::Index count = twigs_->vertices_of(filled_[i]);
    body_.contrast.iodine_kg_m3.segment(first, count).setConstant(kg_m3[i]);
    first += count;
  }
}

/// The surfaces of these, one after the other.
void TwigBody::join(const std::vector<std::size_t>& filled) {
  filled_ = filled;
  Eigen::Index vertices = 0, corners = 0;
  for (std::size_t t : filled) vertices += twigs_->vertices_of(t), corners += twigs_->triangles_of(t);
  fluoro::Triangles triangles(3, corners);
  Eigen::Index vertex = 0, triangle = 0;
  for (std::size_t t : filled) {
    for (int i = twigs_->first_triangle[t]; i < twigs_->first_triangle[t + 1]; ++i, ++triangle)
      for (std::size_t k = 0; k < 3; ++k)
        triangles(static_cast<Eigen::Index>(k), triangle) =
            twigs_->mesh.triangles[static_cast<std::size_t>(i)][k] - twigs_->first[t] + static_cast<int>(vertex);
    vertex += twigs_->vertices_of(t);
  }
  body_ = {.name = "twigs",
           .triangles = std::make_shared<const fluoro::Triangles>(std::move(triangles)),
           .p_P = Eigen::Matrix3Xf(3, vertices),
           .tissue = fluoro::tissue::blood,
           .within = fluoro::tissue::blood,
           .contrast = {}};
  body_.contrast.iodine_kg_m3.resize(vertices);
  body_.contrast.p_PC.resize(3, vertices);
}

fluoro::Body TwigBody::at(const vascular::MovingLumen& lumen, double phase, double breath,
                          const std::function<Eigen::Vector3d(int root)>& aside_at) const {
  fluoro::Body out = body_;
  std::vector<Eigen::Vector3d> vertices;
  Eigen::Index first = 0;
  for (std::size_t t : filled_) {
    vascular::at(*twigs_, t, lumen, phase, breath, vertices);
    const auto count = static_cast<Eigen::Index>(vertices.size());
    const Eigen::Vector3d aside = aside_at ? aside_at(twigs_->root[t]) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    for (Eigen::Index v = 0; v < count; ++v)
      out.p_P.col(first + v) = (vertices[static_cast<std::size_t>(v)] + aside).cast<float>();
    // Evenly filled: depths may be counted from any point of it.
    out.contrast.p_PC.middleCols(first, count).colwise() = Eigen::Vector3f(out.p_P.col(first));
    first += count;
  }
  return out;
}

}  // namespace ostium::app
