#include "vascular/geometry/mesh_files/whole_off.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

namespace {

/// The first words that are no comments: the format's name, then the numbers of vertices and faces. The first two
/// numbers may stand on the first line, too.
std::vector<std::string> first_words(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; words.size() < 3 && file >> word;) {
    if (word.front() == '#')
      std::getline(file, word);
    else
      words.push_back(word);
  }
  return words;
}

}  // namespace

void check_off_whole(const std::string& path) {
  constexpr unsigned long long shortest = 4;  // bytes: "1 0\n" is a face, and a vertex has more
  const unsigned long long most = std::filesystem::file_size(path) / shortest;
  for (const std::string& word : first_words(path)) {
    char* end = nullptr;
    const unsigned long long count = std::strtoull(word.c_str(), &end, 10);  // saturates, also for -1
    if (end != word.c_str() && count > most)
      throw MeshError(
          fmt::format("{}: promises {} vertices or faces, and its {} bytes cannot hold more than {}; expected the "
                      "whole file, copy it again",
                      path, word, std::filesystem::file_size(path), most));
  }
}

void check_off_faces(const std::string& path, std::size_t read) {
  std::vector<std::size_t> counts;
  for (const std::string& word : first_words(path)) {
    char* end = nullptr;
    const unsigned long long count = std::strtoull(word.c_str(), &end, 10);
    if (end != word.c_str() && *end == '\0') counts.push_back(count);
  }
  if (counts.size() >= 2 && counts[1] != read)
    throw MeshError(
        fmt::format("{}: promises {} faces, and {} could be read; expected faces of one to nine corners: export it as "
                    "triangles",
                    path, counts[1], read));
}

}  // namespace ostium::vascular
