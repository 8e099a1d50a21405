#pragma once
#include <string>
#include <vector>

namespace ostium {

struct CheckOptions {
  std::vector<std::string> files;
  std::string unit = "mm";  ///< mm, cm or m
  bool json = false;
};

/// `ostium check`. Exit code 0 if all meshes are sound, 1 if not; throws MeshError.
int check_command(const CheckOptions& options);

}  // namespace ostium
