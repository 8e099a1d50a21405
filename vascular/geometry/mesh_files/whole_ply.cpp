#include "vascular/geometry/mesh_files/whole_ply.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "vascular/geometry/mesh/mesh.h"

namespace ostium::vascular {

namespace {

constexpr int longest_header = 10'000;  // lines

long size_of(const std::string& type) {
  static const std::map<std::string, long> sizes = {{"char", 1},  {"uchar", 1},   {"int8", 1},   {"uint8", 1},
                                                    {"short", 2}, {"ushort", 2},  {"int16", 2},  {"uint16", 2},
                                                    {"int", 4},   {"uint", 4},    {"int32", 4},  {"uint32", 4},
                                                    {"float", 4}, {"float32", 4}, {"double", 8}, {"float64", 8}};
  const auto found = sizes.find(type);
  return found == sizes.end() ? 0 : found->second;
}

struct Promise {
  bool ascii = false;
  long long elements = 0, bytes = 0;
  bool complete = false;  ///< the header was terminated
};

/// No element takes less than a byte, so that sums and products of what passes cannot overflow.
long long checked_count(const std::string& path, const std::string& element, const std::string& count) {
  const auto size = static_cast<long long>(std::filesystem::file_size(path));
  char* end = nullptr;
  const long long value = std::strtoll(count.c_str(), &end, 10);  // saturates
  if (count.empty() || *end || value < 0 || value > size)
    throw MeshError(
        fmt::format("{}: its header promises \"{}\" of \"{}\", and the file has {} bytes; expected a number that fits "
                    "into it: copy or export the file again",
                    path, count, element, size));
  return value;
}

Promise promised(const std::string& path, std::istream& file) {
  Promise promise;
  std::string line;
  long long count = 0;
  for (int n = 0; n < longest_header && std::getline(file, line); ++n) {
    std::istringstream words(line);
    std::string what, type, of, list;
    words >> what;
    if (what == "format") {
      words >> type;
      promise.ascii = type == "ascii";
    } else if (what == "element") {
      words >> type >> list;
      count = checked_count(path, type, list);
      promise.elements += count;
    } else if (what == "property") {
      words >> type >> of >> list;
      promise.bytes += count * (type == "list" ? size_of(of) + 3 * size_of(list) : size_of(type));
    } else if (what == "end_header") {
      promise.complete = true;
      break;
    }
  }
  return promise;
}

}  // namespace

void check_ply_whole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  if (!std::getline(file, magic) || !magic.starts_with("ply")) return;
  const Promise promise = promised(path, file);
  long long there = 0;
  if (promise.ascii) {
    for (std::string line; std::getline(file, line);)
      if (line.find_first_not_of(" \t\r") != std::string::npos) ++there;
  } else if (promise.complete) {
    there = static_cast<long long>(std::filesystem::file_size(path)) - static_cast<long long>(file.tellg());
  }
  const long long wanted = promise.ascii ? promise.elements : promise.bytes;
  if (!promise.complete || there < wanted)
    throw MeshError(
        fmt::format("{}: is cut short: {} of the {} {} that its header promises are there; expected the "
                    "whole file, copy it again",
                    path, there, wanted, promise.ascii ? "lines" : "bytes"));
}

}  // namespace ostium::vascular
