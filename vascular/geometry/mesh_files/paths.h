#pragma once
/// What lies where a path leads. Nothing is opened, as a pipe would wait for its other end, and nothing is thrown.
#include <filesystem>
#include <string>

namespace ostium::vascular {

bool is_file(const std::filesystem::path& path);
bool is_folder(const std::filesystem::path& path);
/// Something has this name, be it a link that leads nowhere.
bool is_there(const std::filesystem::path& path);

/// Why it cannot be read as a file, such as "it is a pipe, not a file"; empty: it is a file.
std::string why_no_file(const std::filesystem::path& path);

}  // namespace ostium::vascular
