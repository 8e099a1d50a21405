#pragma once
/// Where the axes of somebody's meshes point to.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace ostium::app {

/// Three letters as DICOM has them: left or right, superior or inferior, anterior or posterior.
struct FileAxes {
  std::string letters;        ///< empty: nobody says
  bool said_by_file = false;  ///< as 3D Slicer does; else by --axes
};

/// From axes that point so to the patient's. Throws LoadError if they are no right-handed row of three.
Eigen::Matrix3d axes_of(const std::string& letters);

/// What a file says of its axes: "LPS", "RAS", or empty.
std::string axes_said_by(const std::string& file);

/// `said`: by --axes, or "auto". Throws LoadError if one of the files says otherwise, or another file.
FileAxes file_axes(const std::vector<std::string>& files, const std::string& said);

}  // namespace ostium::app
