#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Exporter.hpp>
#include <map>
#include <memory>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/geometry/mesh_files/raw_surface.h"
#include "vascular/geometry/mesh_files/unit_mark.h"
#include "vascular/geometry/mesh_files/written_mesh.h"

namespace ostium::vascular {

namespace {

using Corners = std::vector<Eigen::Vector3d>;  // three per triangle

/// Farther out than any file has a patient, in whatever unit; beyond, welding could no longer number its cells.
constexpr double farthest = 1e7;

RawSurface (*surface_reader)(const std::string& path) = read_surface;

Corners read_corners(const std::string& path, LengthUnit unit, int* skipped = nullptr) {
  RawSurface surface = surface_reader(path);
  if (surface.corners.empty())
    throw MeshError(
        surface.skipped
            ? fmt::format("{}: holds no triangle, but {} points or lines, as a centreline does; expected a surface",
                          path, surface.skipped)
            : path + ": holds no triangle; expected a surface");
  if (surface.corners.size() > 3 * most_triangles)
    throw MeshError(fmt::format("{}: has {} triangles; expected at most {}: simplify it", path,
                                surface.corners.size() / 3, most_triangles));
  for (Eigen::Vector3d& p : surface.corners) {
    if (!(p.array().abs() <= farthest).all())
      throw MeshError(
          fmt::format("{}: has a corner at {:g} {:g} {:g}; expected finite numbers up to {:g}: is the file damaged?",
                      path, p.x(), p.y(), p.z(), farthest));
    p *= metres(unit);
  }
  if (skipped) *skipped = surface.skipped;
  return std::move(surface.corners);
}

/// Vertices for the corner indices in `vertex_of`: the first corner merged into each.
std::vector<Eigen::Vector3d> welded(const Corners& corners, const std::vector<int>& vertex_of) {
  std::vector<Eigen::Vector3d> vertices;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (vertex_of[i] == static_cast<int>(vertices.size())) vertices.push_back(corners[i]);
  return vertices;
}

MeshFile from_corners(const Corners& corners, double weld_m) {
  const std::vector<int> vertex_of = weld(corners, weld_m), exact = weld(corners, 0);
  MeshFile file;
  file.mesh.vertices = welded(corners, vertex_of);
  file.welded_vertices = static_cast<int>(welded(corners, exact).size() - file.mesh.vertices.size());
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const std::array<int, 3> t = {vertex_of[i], vertex_of[i + 1], vertex_of[i + 2]};
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0])
      ++file.dropped_triangles;
    else
      file.mesh.triangles.push_back(t);
  }
  return file;
}

Eigen::Vector3f in_file(const Eigen::Vector3d& p, LengthUnit unit) { return (p / metres(unit)).cast<float>(); }

std::string format_id(const std::string& path) {
  const std::string ending = ending_of(path);
  const std::map<std::string, std::string> ids = {{".obj", "objnomtl"}, {".stl", "stlb"}, {".ply", "plyb"}};
  const auto found = ids.find(ending);
  if (found == ids.end())
    throw MeshError(fmt::format("{}: the ending \"{}\" names no format; expected .obj, .stl or .ply", path, ending));
  return found->second;
}

}  // namespace

void read_meshes_with(RawSurface (*reader)(const std::string& path)) { surface_reader = reader; }

MeshFile read_mesh(const std::string& path, LengthUnit unit, double weld_m) {
  int skipped = 0;
  MeshFile file = from_corners(read_corners(path, unit, &skipped), weld_m);
  file.skipped_faces = skipped;
  return file;
}

std::vector<Mesh> read_mesh_sequence(const std::vector<std::string>& paths, LengthUnit unit, double weld_m) {
  std::vector<Mesh> frames;
  std::vector<int> vertex_of;
  for (const std::string& path : paths) {
    const Corners corners = read_corners(path, unit);
    if (frames.empty()) {
      vertex_of = weld(corners, weld_m);
      frames.push_back(from_corners(corners, weld_m).mesh);
      continue;
    }
    if (corners.size() != vertex_of.size())
      throw MeshError(fmt::format("{}: has {} triangles; expected {}, as in {}: the same surface in every frame", path,
                                  corners.size() / 3, vertex_of.size() / 3, paths.front()));
    // The same number of triangles may still be different ones, or in another order: then corners of one vertex are
    // apart.
    std::vector<Eigen::Vector3d> vertices = welded(corners, vertex_of);
    const double apart_m = std::max(1e-9, 10 * weld_m);
    std::size_t torn = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) torn += (corners[i] - vertices[vertex_of[i]]).norm() > apart_m;
    if (torn > 0)
      throw MeshError(
          fmt::format("{}: {} of {} corners lie apart from the vertex that they share in {}; expected the same "
                      "triangles in the same order in every frame",
                      path, torn, corners.size(), paths.front()));
    frames.push_back({std::move(vertices), frames.front().triangles});
  }
  return frames;
}

Mesh as_written(Mesh mesh, LengthUnit unit) {
  // Two loops, because GCC 12.2 at -O3 omits the rounding of a vertex that goes to float and back in one.
  std::vector<Eigen::Vector3f> kept;
  for (const Eigen::Vector3d& p : mesh.vertices) kept.push_back(in_file(p, unit));
  for (std::size_t v = 0; v < kept.size(); ++v) mesh.vertices[v] = metres(unit) * kept[v].cast<double>();
  return mesh;
}

std::string mesh_bytes(const std::string& path, const Mesh& mesh, LengthUnit unit) {
  const std::string id = format_id(path);
  aiScene scene;  // owns and deletes all of the following
  scene.mRootNode = new aiNode();
  scene.mRootNode->mNumMeshes = 1;
  scene.mRootNode->mMeshes = new unsigned[1]{0};
  scene.mNumMaterials = 1;
  scene.mMaterials = new aiMaterial* [1] { new aiMaterial() };
  scene.mNumMeshes = 1;
  scene.mMeshes = new aiMesh* [1] { new aiMesh() };
  aiMesh& out = *scene.mMeshes[0];
  out.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  out.mNumVertices = static_cast<unsigned>(mesh.vertices.size());
  out.mVertices = new aiVector3D[mesh.vertices.size()];
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const Eigen::Vector3f p = in_file(mesh.vertices[i], unit);
    out.mVertices[i] = {p.x(), p.y(), p.z()};
  }
  out.mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  out.mFaces = new aiFace[mesh.triangles.size()];
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    out.mFaces[i].mNumIndices = 3;
    out.mFaces[i].mIndices = new unsigned[3];
    for (int k = 0; k < 3; ++k) out.mFaces[i].mIndices[k] = static_cast<unsigned>(mesh.triangles[i][k]);
  }
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, id);
  if (!blob) throw MeshError(fmt::format("{}: cannot be written: {}", path, exporter.GetErrorString()));
  return with_unit_mark({static_cast<const char*>(blob->data), blob->size}, ending_of(path), unit);
}

}  // namespace ostium::vascular
