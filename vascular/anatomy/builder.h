#pragma once
/// Adds tubes to an anatomy from the tables of coronaries and aorta.
#include <array>
#include <random>

#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/root.h"

namespace ostium::vascular {

/// A point of a course in mm and the diameter there; 0: interpolated.
struct TableRow {
  double x, y, z, diameter_mm;
};

class AnatomyBuilder {
 public:
  explicit AnatomyBuilder(Anatomy& anatomy) : anatomy_(anatomy) {}

  /// Adds a tube that starts on the parent's centreline at the point nearest to the course's first. Its branch is
  /// called `name`; with `trunk`, the stretch before the point nearest to `trunk_end` is called that instead.
  int add(const std::string& name, int parent, std::vector<CoursePoint> course, double blend = 1);
  void name_trunk(const std::string& trunk, const Eigen::Vector3d& trunk_end);
  int tube(const std::string& branch) const;  ///< index of the tube that contains a branch

 private:
  Anatomy& anatomy_;
};

void add_aorta(AnatomyBuilder& builder, const Root& root, const AnatomyParameters& parameters, Landmarks& landmarks);
void add_coronaries(AnatomyBuilder& builder, const Root& root, const AnatomyParameters& parameters);

}  // namespace ostium::vascular
