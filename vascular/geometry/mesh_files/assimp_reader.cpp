#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/geometry/mesh_files/raw_surface.h"
#include "vascular/geometry/mesh_files/whole_off.h"
#include "vascular/geometry/mesh_files/whole_ply.h"
#include "vascular/geometry/mesh_files/whole_stl.h"

namespace ostium::vascular {

namespace {

/// Checks indices, since not all of assimp's readers do and the code below relies on them.
void check_indices(const std::string& path, const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f)
      for (unsigned k = 0; k < part.mFaces[f].mNumIndices; ++k)
        if (part.mFaces[f].mIndices[k] >= part.mNumVertices)
          throw MeshError(fmt::format("{}: part {} (\"{}\"), face {} names vertex {} of {}; expected a whole file",
                                      path, m, part.mName.C_Str(), f, part.mFaces[f].mIndices[k], part.mNumVertices));
  }
}

/// What assimp would take as a smaller mesh, or as a reason to ask for more memory than there is.
void check_whole(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".ply") check_ply_whole(path);
  if (ending == ".stl") check_stl_whole(path);
  if (ending == ".off") check_off_whole(path);
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  if (!has_mesh_ending(path))
    throw MeshError(fmt::format("{}: the ending \"{}\" names no format that is read as a mesh; expected one of {}",
                                path, ending_of(path), listed_mesh_endings()));
  throw MeshError(fmt::format("{}: cannot be read as a mesh: {}; export it again, best as .stl, .ply or .vtp", path,
                              why.empty() ? "its content is not what its ending says" : why));
}

}  // namespace

RawSurface read_assimp(const std::string& path) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_PP_PTV_KEEP_HIERARCHY, false);
  check_whole(path);
  const aiScene* scene = importer.ReadFile(path, 0);
  if (!scene) refuse(path, importer.GetErrorString());
  check_indices(path, *scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate | aiProcess_PreTransformVertices);
  if (!scene) refuse(path, importer.GetErrorString());
  RawSurface surface;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices < 3) {
        ++surface.skipped;
        continue;
      }
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& p = part.mVertices[face.mIndices[k]];
        surface.corners.emplace_back(p.x, p.y, p.z);
        if (!surface.corners.back().allFinite())
          throw MeshError(
              fmt::format("{}: part {} (\"{}\"), face {} has a corner that is no finite number; expected three "
                          "coordinates",
                          path, m, part.mName.C_Str(), f));
      }
    }
  }
  return surface;
}

}  // namespace ostium::vascular
