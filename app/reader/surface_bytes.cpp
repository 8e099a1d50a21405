#include "app/reader/surface_bytes.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "data/formats/load_error.h"

namespace ostium::app {

namespace {

struct SurfaceHeader {
  std::array<char, 8> word = {'o', 's', 't', 's', 'u', 'r', 'f', '1'};
  std::int64_t skipped = 0;
  std::uint64_t corners = 0;
};
static_assert(std::is_trivially_copyable_v<SurfaceHeader> && sizeof(SurfaceHeader) == 24);

constexpr std::size_t corner_bytes = sizeof(Eigen::Vector3d);
static_assert(corner_bytes == 24);

}  // namespace

bool write_surface(const vascular::RawSurface& surface, std::FILE* to) {
  SurfaceHeader header;
  header.skipped = surface.skipped, header.corners = surface.corners.size();
  return std::fwrite(&header, sizeof(header), 1, to) == 1 &&
         std::fwrite(surface.corners.data(), corner_bytes, surface.corners.size(), to) == surface.corners.size() &&
         std::fflush(to) == 0;
}

vascular::RawSurface surface_of(const std::string& bytes, const std::string& file) {
  SurfaceHeader header, expected;
  if (bytes.size() >= sizeof(header)) std::memcpy(&header, bytes.data(), sizeof(header));
  const std::uint64_t corners = (bytes.size() - sizeof(header)) / corner_bytes;
  if (bytes.size() < sizeof(header) || header.word != expected.word || header.corners != corners || corners % 3 ||
      (bytes.size() - sizeof(header)) % corner_bytes || header.skipped < 0 || header.skipped > INT32_MAX)
    throw data::LoadError(file + ": led its reader astray; expected a whole file: export it again");
  vascular::RawSurface surface;
  surface.skipped = static_cast<int>(header.skipped);
  surface.corners.resize(corners);
  if (corners) std::memcpy(surface.corners.data()->data(), bytes.data() + sizeof(header), corners * corner_bytes);
  return surface;
}

}  // namespace ostium::app
