#pragma once
#include <string>
#include <vector>

namespace ostium {

struct CheckOptions {
  std::vector<std::string> files;
  std::string unit = "auto";  ///< auto, mm, cm, m or in
  bool json = false;
  std::string picture;  ///< .png or .svg; empty: none
};

/// `ostium check`. Exit code 0 if all meshes are sound, 1 if not; throws MeshError.
int check_command(const CheckOptions& options);

}  // namespace ostium
