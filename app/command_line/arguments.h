#pragma once
/// Reading what was typed, and refusing what cannot be meant.
#include <Eigen/Core>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ostium::app {

std::vector<std::string> split(const std::string& text, char at);
/// "KEY=VALUE" in two; the key is empty where there is no such pair.
std::pair<std::string, std::string> key_and_value(const std::string& text);

/// "X,Y,Z"; empty if it is something else.
std::optional<Eigen::Vector3d> three_numbers(const std::string& text);
/// The same of a point in a mesh, in the mesh's unit. Throws LoadError.
Eigen::Vector3d mesh_point(const std::string& text);

/// Throws LoadError unless the file's name ends with one of these: {".png", ".mp4"}.
void require_ending(const std::string& file, const std::vector<std::string>& known);
/// Throws LoadError for an option that is infinite or "nan".
void require_finite(std::initializer_list<std::pair<const char*, double>> options);

/// Throws LoadError if the folder is not there and cannot be made.
void make_folder(const std::filesystem::path& folder);

}  // namespace ostium::app
