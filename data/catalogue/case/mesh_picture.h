#pragma once
/// A surface seen from three sides, shaded, with points marked: as PNG, or as SVG with labels beside the marks.
#include <string>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::data {

struct PictureMark {
  Eigen::Vector3d p;  ///< in the mesh's frame
  std::string words;  ///< label, in SVG only; may be empty
  Eigen::Vector3d rgb = Eigen::Vector3d(200, 30, 30);
};

/// Views along the mesh's own axes: against z, against x, against y. Throws LoadError if the name ends neither in .png
/// nor in .svg, or if the file cannot be written; no partial file is left.
void draw_mesh(const std::string& file, const vascular::Mesh& mesh, const std::vector<Eigen::Vector3d>& rgb_of_vertex,
               const std::vector<PictureMark>& marks, const std::string& title);

}  // namespace ostium::data
