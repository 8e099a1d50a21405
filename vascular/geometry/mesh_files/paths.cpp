#include "vascular/geometry/mesh_files/paths.h"

namespace ostium::vascular {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code unseen;
  return fs::is_regular_file(path, unseen);
}

bool is_folder(const fs::path& path) {
  std::error_code unseen;
  return fs::is_directory(path, unseen);
}

bool is_there(const fs::path& path) {
  std::error_code unseen;
  return fs::exists(fs::symlink_status(path, unseen));
}

std::string why_no_file(const fs::path& path) {
  std::error_code error;
  switch (fs::status(path, error).type()) {
    case fs::file_type::regular:
      return "";
    case fs::file_type::not_found:
      return is_there(path) ? "it is a symbolic link to what is not there" : "there is no such file";
    case fs::file_type::directory:
      return "it is a folder, not a file";
    case fs::file_type::fifo:
      return "it is a pipe, not a file";
    case fs::file_type::socket:
      return "it is a socket, not a file";
    case fs::file_type::block:
    case fs::file_type::character:
      return "it is a device, not a file";
    default:
      break;
  }
  if (error == std::errc::too_many_symbolic_link_levels) return "a symbolic link on the way leads to itself";
  return error ? "what is there cannot be seen (" + error.message() + ")" : "it is no file";
}

}  // namespace ostium::vascular
