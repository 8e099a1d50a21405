#pragma once
/// Parses command-line values, and refuses impossible ones.
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ostium::app {

std::vector<std::string> split(const std::string& text, char at);
/// Splits "KEY=VALUE"; the key is empty if the text is not of that form.
std::pair<std::string, std::string> key_and_value(const std::string& text);

/// "X,Y,Z"; empty if the text is not of that form.
std::optional<Eigen::Vector3d> three_numbers(const std::string& text);
/// The same for a point of a mesh, in the mesh's unit. Throws LoadError.
Eigen::Vector3d mesh_point(const std::string& text);

/// Throws LoadError unless the file name has one of these endings, in upper or lower case: {".png", ".mp4"}.
void require_ending(const std::string& file, const std::vector<std::string>& known);

/// Throws WriteError if the folder does not exist and cannot be created.
void make_folder(const std::filesystem::path& folder);

}  // namespace ostium::app
