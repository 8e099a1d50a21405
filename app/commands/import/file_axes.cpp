#include "app/commands/import/file_axes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "app/reader/read_apart.h"
#include "data/catalogue/case/markups_file.h"
#include "data/formats/load_error.h"

namespace ostium::app {

Eigen::Matrix3d axes_of(const std::string& letters) {
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  const std::string known = "LRSIAP";
  for (std::size_t i = 0; i < letters.size() && letters.size() == 3; ++i)
    if (const auto k = known.find(letters[i]); k != std::string::npos)
      R(static_cast<int>(k / 2), static_cast<int>(i)) = k % 2 ? -1 : 1;
  if (std::fabs(R.determinant() - 1) > 1e-9)
    throw data::LoadError(fmt::format(
        "the axes \"{}\" are no right-handed row of three; expected for instance LPS (DICOM), RAS or LSA", letters));
  return R;
}

std::string axes_said_by(const std::string& file) {
  return data::is_markups_file(file) ? data::load_markups(file).axes : read_axes_apart(file);
}

FileAxes file_axes(const std::vector<std::string>& files, const std::string& said) {
  FileAxes axes;
  std::string where;
  for (const std::string& file : files) {
    const std::string letters = axes_said_by(file);
    if (letters.empty()) continue;
    if (said != "auto" && said != letters)
      throw data::LoadError(
          fmt::format("{}: says that its axes are {}, and --axes says {}; leave --axes out, or correct the file", file,
                      letters, said));
    if (!where.empty() && letters != axes.letters)
      throw data::LoadError(fmt::format(
          "{}: says that its axes are {}, and {} says {}; expected files in the same axes: export one again", file,
          letters, where, axes.letters));
    axes = {letters, true}, where = file;
  }
  if (where.empty() && said != "auto") axes.letters = said;
  return axes;
}

}  // namespace ostium::app
