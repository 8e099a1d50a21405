#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/fuzz/target.h"

namespace ostium::fuzz {

const std::vector<Target>& targets() {
  static const std::vector<Target> all = [] {
    std::vector<Target> list;
    for (const auto& some :
         {json_targets(), mesh_targets(), recording_targets(), protocol_targets(), text_targets(), sweep_targets()})
      list.insert(list.end(), some.begin(), some.end());
    return list;
  }();
  return all;
}

InputFile::InputFile(const Seed& input)
    : path_((std::filesystem::temp_directory_path() / ("ostium-fuzz-" + std::to_string(getpid()) + "-" + input.name))
                .string()) {
  std::ofstream(path_, std::ios::binary) << input.bytes;
}

InputFile::~InputFile() {
  std::error_code gone;
  std::filesystem::remove(path_, gone);
}

}  // namespace ostium::fuzz
