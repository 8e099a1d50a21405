#include "app/command_line/arguments.h"

#include <fmt/format.h>

#include "data/formats/decimal.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"
#include "vascular/geometry/mesh_files/formats.h"

namespace ostium::app {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  for (char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::pair<std::string, std::string> key_and_value(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) return {};
  return {text.substr(0, equals), text.substr(equals + 1)};
}

std::optional<Eigen::Vector3d> three_numbers(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 3) return std::nullopt;
  Eigen::Vector3d point;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::optional<double> number = data::decimal(parts[i]);
    if (!number) return std::nullopt;
    point[static_cast<Eigen::Index>(i)] = *number;
  }
  return point;
}

Eigen::Vector3d mesh_point(const std::string& text) {
  if (const auto point = three_numbers(text)) return *point;
  throw data::LoadError(
      fmt::format("the point \"{}\" is not x,y,z; expected three numbers with commas, in the mesh's unit", text));
}

void require_ending(const std::string& file, const std::vector<std::string>& known) {
  std::string list;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (vascular::ending_of(file) == known[i]) return;
    list += (i == 0 ? "" : i + 1 < known.size() ? ", " : " and ") + known[i];
  }
  throw data::LoadError(fmt::format("{}: what is it to be? {} {} known", file, list, known.size() == 1 ? "is" : "are"));
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw data::WriteError(fmt::format("{}: cannot be made ({}); expected a folder", folder.string(), error.message()));
}

}  // namespace ostium::app
