#include "data/formats/write_file.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace ostium::data {

void write_file(const std::string& path, const std::string& text) {
  std::error_code none;
  const auto folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, none);
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.flush();
  if (!file) throw std::runtime_error(path + ": cannot be written; is its folder there, and the disk not full?");
}

}  // namespace ostium::data
