#pragma once
/// A surface seen from three sides, shaded, with places marked: as PNG, or as SVG with words beside the marks.
#include <string>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::data {

struct PictureMark {
  Eigen::Vector3d p;  ///< of the mesh's frame
  std::string words;  ///< in SVG only; may be empty
  Eigen::Vector3d rgb = Eigen::Vector3d(200, 30, 30);
};

/// Along the mesh's own axes: seen against z, against x, against y. Throws LoadError if the name ends neither in .png
/// nor in .svg, or the file cannot be written; nothing half is left.
void draw_mesh(const std::string& file, const vascular::Mesh& mesh, const std::vector<Eigen::Vector3d>& rgb_of_vertex,
               const std::vector<PictureMark>& marks, const std::string& title);

}  // namespace ostium::data
