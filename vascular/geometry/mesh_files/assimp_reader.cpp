#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <array>
#include <assimp/Importer.hpp>
#include <filesystem>
#include <new>
#include <string_view>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/geometry/mesh_files/raw_surface.h"
#include "vascular/geometry/mesh_files/whole_ply.h"
#include "vascular/geometry/mesh_files/whole_stl.h"

namespace ostium::vascular {

namespace {

namespace fs = std::filesystem;

/// Opens the mesh and the files that it names (buffers of glTF, materials of OBJ) where they lie in its folder or
/// below, and no others: a mesh from somewhere must not read what is ours.
class FilesBeside : public Assimp::DefaultIOSystem {
 public:
  explicit FilesBeside(const std::string& path) : folder_(fs::weakly_canonical(fs::absolute(path)).parent_path()) {}

  Assimp::IOStream* Open(const char* name, const char* mode) override {
    std::error_code unseen;
    // Absolute, as what is not there would stay relative, and so lie in no folder.
    const fs::path file = fs::weakly_canonical(fs::absolute(name, unseen), unseen);
    const fs::path within = file.lexically_relative(folder_);
    // Assimp puts the folder before every name, so that of "/etc/x" or "http://x" has two slashes together.
    const bool elsewhere = std::string_view(name).find("//") != std::string_view::npos;
    if (elsewhere || unseen || within.empty() || *within.begin() == "..") {
      outside_ = name;
      return nullptr;
    }
    return fs::is_regular_file(file, unseen) ? DefaultIOSystem::Open(name, mode) : nullptr;
  }

  /// The last one that was refused; empty: none.
  const std::string& outside() const { return outside_; }

 private:
  fs::path folder_;
  std::string outside_;
};

/// Checks indices, since not all of assimp's readers do and the code below relies on them.
void check_indices(const std::string& path, const aiScene& scene) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      if (part.mFaces[f].mNumIndices == 0)
        throw MeshError(
            fmt::format("{}: part {} (\"{}\"), face {} has no corners; expected a whole file: export it again", path, m,
                        part.mName.C_Str(), f));
      for (unsigned k = 0; k < part.mFaces[f].mNumIndices; ++k)
        if (part.mFaces[f].mIndices[k] >= part.mNumVertices)
          throw MeshError(fmt::format("{}: part {} (\"{}\"), face {} names vertex {} of {}; expected a whole file",
                                      path, m, part.mName.C_Str(), f, part.mFaces[f].mIndices[k], part.mNumVertices));
    }
  }
}

/// What assimp would take as a smaller mesh, or as a reason to ask for more memory than there is.
void check_whole(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".ply") check_ply_whole(path);
  if (ending == ".stl") check_stl_whole(path);
}

/// Assimp's words, which may hold all that is left of the file.
std::string short_words(const std::string& words) {
  constexpr std::size_t most = 200;
  std::string out = words.substr(0, most);
  for (char& c : out)
    if (c < ' ' || c == 0x7f) c = '?';
  return out + (words.size() > most ? "..." : "");
}

[[noreturn]] void refuse(const std::string& path, const std::string& why) {
  if (why.find("bad_alloc") != std::string::npos) throw std::bad_alloc();  // which assimp caught
  throw MeshError(fmt::format("{}: cannot be read as a mesh: {}; export it again, best as .stl, .ply or .vtp", path,
                              why.empty() ? "its content is not what its ending says" : short_words(why)));
}

/// Adds a part where a node places it. A mirrored part is turned inside out again, as glTF has it; assimp's own
/// transformation leaves it.
void add_part(const std::string& path, const aiMesh& part, unsigned number, const aiMatrix4x4& placed,
              RawSurface& surface) {
  const bool mirrored = placed.Determinant() < 0;
  for (unsigned f = 0; f < part.mNumFaces; ++f) {
    const aiFace& face = part.mFaces[f];
    if (face.mNumIndices < 3) {
      ++surface.skipped;
      continue;
    }
    for (const unsigned k : mirrored ? std::array{0U, 2U, 1U} : std::array{0U, 1U, 2U}) {
      const aiVector3D p = placed * part.mVertices[face.mIndices[k]];
      surface.corners.emplace_back(p.x, p.y, p.z);
      if (!surface.corners.back().allFinite())
        throw MeshError(
            fmt::format("{}: part {} (\"{}\"), face {} has a corner that is no finite number; expected three "
                        "coordinates",
                        path, number, part.mName.C_Str(), f));
    }
  }
}

void add_below(const std::string& path, const aiScene& scene, const aiNode& node, const aiMatrix4x4& above,
               RawSurface& surface) {
  const aiMatrix4x4 placed = above * node.mTransformation;
  for (unsigned m = 0; m < node.mNumMeshes; ++m)
    add_part(path, *scene.mMeshes[node.mMeshes[m]], node.mMeshes[m], placed, surface);
  for (unsigned c = 0; c < node.mNumChildren; ++c) add_below(path, scene, *node.mChildren[c], placed, surface);
}

}  // namespace

RawSurface read_assimp(const std::string& path) {
  Assimp::Importer importer;
  check_whole(path);
  auto* files = new FilesBeside(path);
  importer.SetIOHandler(files);  // which owns it from now on
  const std::string capitals = ending_of(path) == ".stl" ? stl_in_capitals(path) : "";
  const aiScene* scene = capitals.empty() ? importer.ReadFile(fs::path(path).lexically_normal().string(), 0)
                                          : importer.ReadFileFromMemory(capitals.data(), capitals.size(), 0, "stl");
  if (!files->outside().empty())
    throw MeshError(
        fmt::format("{}: names the file \"{}\", which does not lie in its folder; expected all of a mesh in "
                    "one folder: put it there, and name it without a path",
                    path, files->outside()));
  if (!scene) refuse(path, importer.GetErrorString());
  check_indices(path, *scene);
  scene = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (!scene || !scene->mRootNode) refuse(path, importer.GetErrorString());
  RawSurface surface;
  add_below(path, *scene, *scene->mRootNode, aiMatrix4x4(), surface);
  if (surface.corners.empty() && surface.skipped == 0) refuse(path, "it holds no faces");
  return surface;
}

}  // namespace ostium::vascular
