#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <new>
#include <string_view>

#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/formats.h"
#include "vascular/geometry/mesh_files/paths.h"
#include "vascular/geometry/mesh_files/raw_surface.h"

namespace ostium::vascular {

RawSurface read_surface(const std::string& path) {
  if (const std::string why = why_no_file(path); !why.empty())
    throw MeshError(fmt::format("{}: cannot be read, {}; expected a mesh ({})", path, why, listed_mesh_endings()));
  const std::string ending = ending_of(path);
  if (!has_mesh_ending(path))
    throw MeshError(fmt::format("{}: the ending \"{}\" names no format that is read as a mesh; expected one of {}",
                                path, ending, listed_mesh_endings()));
  std::error_code unseen;
  if (const std::uintmax_t bytes = std::filesystem::file_size(path, unseen); bytes > longest_mesh_file)
    throw MeshError(fmt::format("{}: has {} MB; expected at most {}: simplify the mesh", path, bytes / 1'000'000,
                                longest_mesh_file / 1'000'000));
  std::array<char, 4> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  const std::string_view mark(start.data(), 2), letter(start.data() + 2, 2);  // binary files may begin with either
  if (mark[0] != '\0' && mark[1] != '\0' && is_utf16(mark) && is_utf16(letter))
    throw MeshError(path + ": " + utf16_cure);
  try {
    if (ending == ".off") return read_off(path);
    return ending == ".vtp" || ending == ".vtu" || ending == ".vtk" ? read_vtk(path) : read_assimp(path);
  } catch (const MeshError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw MeshError(path + ": asks for more memory than a reader has; expected a whole file, or a simpler mesh");
  } catch (const std::exception& error) {
    throw MeshError(fmt::format("{}: cannot be read as a mesh: {}; expected a whole file", path, error.what()));
  }
}

}  // namespace ostium::vascular
