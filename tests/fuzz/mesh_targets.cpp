#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Exporter.hpp>
#include <cstring>

#include "tests/fuzz/target.h"
#include "tests/vascular/geometry/shapes.h"
#include "tests/vascular/geometry/vtk_files.h"
#include "vascular/geometry/mesh/mesh.h"

namespace ostium::fuzz {

namespace {

using vascular::Mesh;

Mesh small_mesh() { return test::sphere(10, 5); }  // 80 triangles; written in its own unit

Seed written(const std::string& name) { return {name, mesh_bytes(name, small_mesh(), vascular::LengthUnit::metre)}; }

/// By assimp, whose formats these are.
Seed exported(const std::string& name, const char* id) {
  const Mesh mesh = small_mesh();
  aiScene scene;  // owns and deletes all of the following
  scene.mRootNode = new aiNode();
  scene.mRootNode->mNumMeshes = 1, scene.mRootNode->mMeshes = new unsigned[1]{0};
  scene.mNumMaterials = 1, scene.mMaterials = new aiMaterial* [1] { new aiMaterial() };
  scene.mNumMeshes = 1, scene.mMeshes = new aiMesh* [1] { new aiMesh() };
  aiMesh& out = *scene.mMeshes[0];
  out.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  out.mNumVertices = static_cast<unsigned>(mesh.vertices.size()), out.mVertices = new aiVector3D[out.mNumVertices];
  for (unsigned v = 0; v < out.mNumVertices; ++v) {
    const Eigen::Vector3f p = mesh.vertices[v].cast<float>();
    out.mVertices[v] = {p.x(), p.y(), p.z()};
  }
  out.mNumFaces = static_cast<unsigned>(mesh.triangles.size()), out.mFaces = new aiFace[out.mNumFaces];
  for (unsigned f = 0; f < out.mNumFaces; ++f) {
    out.mFaces[f].mNumIndices = 3, out.mFaces[f].mIndices = new unsigned[3];
    for (unsigned k = 0; k < 3; ++k) out.mFaces[f].mIndices[k] = static_cast<unsigned>(mesh.triangles[f][k]);
  }
  Assimp::Exporter exporter;
  const aiExportDataBlob* blob = exporter.ExportToBlob(&scene, id);
  require(blob, std::string("assimp writes ") + id);
  return {name, {static_cast<const char*>(blob->data), blob->size}};
}

std::string off() {
  const Mesh mesh = small_mesh();
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const Eigen::Vector3d& p : mesh.vertices) text += fmt::format("{:.4f} {:.4f} {:.4f}\n", p.x(), p.y(), p.z());
  for (const auto& [a, b, c] : mesh.triangles) text += fmt::format("3 {} {} {}\n", a, b, c);
  return text;
}

/// With its numbers in the text, in base64.
std::string gltf() {
  const Mesh mesh = small_mesh();
  std::string bytes;
  for (const Eigen::Vector3d& p : mesh.vertices)
    for (int k = 0; k < 3; ++k) bytes += test::bytes_of(p[k], false, false);
  const std::size_t points = bytes.size(), corners = 3 * mesh.triangles.size();
  for (const auto& t : mesh.triangles)
    for (int v : t) bytes += test::bytes_of(static_cast<std::uint64_t>(v), 2, false);
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],"meshes":[{{"primitives":
[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],"accessors":[{{"bufferView":0,"componentType":5126,"count":{},"type":
"VEC3"}},{{"bufferView":1,"componentType":5123,"count":{},"type":"SCALAR"}}],"bufferViews":[{{"buffer":0,"byteLength":{}
}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],"buffers":[{{"byteLength":{},"uri":
"data:application/octet-stream;base64,{}"}}]}})",
      mesh.vertices.size(), corners, points, points, 2 * corners, bytes.size(), test::base64_of(bytes));
}

std::vector<Seed> vtk_xml(bool grid) {
  std::vector<Seed> seeds;
  for (const char* format : {"ascii", "binary", "appended"})
    for (const bool zlib : {false, true}) {
      const test::VtkEncoding encoding{
          .format = format, .base64 = zlib, .zlib = zlib, .big_endian = zlib, .wide = zlib};
      seeds.push_back(grid ? Seed{"mesh.vtu", test::vtu(encoding)} : Seed{"mesh.vtp", test::vtp(encoding)});
    }
  return seeds;
}

std::vector<Seed> vtk_legacy() {
  std::vector<Seed> seeds;
  for (const char* version : {"3.0", "5.1"})
    for (const bool binary : {false, true})
      for (const bool grid : {false, true})
        seeds.push_back({"mesh.vtk", test::VtkLegacyWriter(binary, version).file(grid)});
  return seeds;
}

Answer read_mesh(const Seed& input) {
  const InputFile file(input);
  return answer_of<vascular::MeshError>([&] {
    const Mesh mesh = read_mesh(file.path(), vascular::LengthUnit::millimetre).mesh;
    for (const auto& t : mesh.triangles)
      for (int v : t)
        require(v >= 0 && v < static_cast<int>(mesh.vertices.size()) && mesh.vertices[v].allFinite(),
                "triangles name vertices that are there, at finite numbers");
  });
}

}  // namespace

std::vector<Target> mesh_targets() {
  return {{"mesh-stl",
           [] {
             return std::vector{written("mesh.stl"), exported("mesh.stl", "stl")};
           },
           read_mesh, true},
          {"mesh-ply",
           [] {
             return std::vector{written("mesh.ply"), exported("mesh.ply", "ply")};
           },
           read_mesh, true},
          {"mesh-obj", [] { return std::vector{written("mesh.obj")}; }, read_mesh, true},
          {"mesh-off",
           [] {
             return std::vector{Seed{"mesh.off", off()}};
           },
           read_mesh, true},
          {"mesh-gltf",
           [] {
             return std::vector{Seed{"mesh.gltf", gltf()}};
           },
           read_mesh, true},
          {"mesh-glb", [] { return std::vector{exported("mesh.glb", "glb2")}; }, read_mesh, true},
          {"mesh-dae", [] { return std::vector{exported("mesh.dae", "collada")}; }, read_mesh, true},
          {"mesh-fbx", [] { return std::vector{exported("mesh.fbx", "fbxa")}; }, read_mesh, true},
          {"mesh-3ds", [] { return std::vector{exported("mesh.3ds", "3ds")}; }, read_mesh, true},
          {"mesh-x3d", [] { return std::vector{exported("mesh.x3d", "x3d")}; }, read_mesh, true},
          {"mesh-vtp", [] { return vtk_xml(false); }, read_mesh},
          {"mesh-vtu", [] { return vtk_xml(true); }, read_mesh},
          {"mesh-vtk", vtk_legacy, read_mesh}};
}

}  // namespace ostium::fuzz
