#pragma once
/// What the workbench tells its page.
#include <nlohmann/json.hpp>

#include "data/catalogue/case/case_draft.h"
#include "fluoro/display/display.h"
#include "vascular/anatomy/editing/course_check.h"

namespace ostium::app {

/// The case's file, its vessels (spheres in mm: x, y, z, radius, along), names, entry, and what is wrong with the
/// courses. `mends`: of the import, a JSON list.
std::string draft_message(const data::CaseDraft& draft, const std::vector<vascular::CourseFault>& faults,
                          const std::string& mends);
/// Kind 4; at byte 8 the number of vertices and of triangles, 32-bit, at 16 the vertices in mm, 32-bit floats, then
/// the triangles' vertices, 32-bit. With more triangles than a page turns at ease it is decimated.
std::string wall_bytes(const vascular::Mesh& wall);
/// Kind 5, at byte 8 LAO, at 12 cranial in degrees, 32-bit floats, at 16 a JPEG.
std::string xray_bytes(double lao_deg, double cran_deg, const fluoro::Picture& picture);

}  // namespace ostium::app
