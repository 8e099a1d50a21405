#pragma once
/// Adds tubes to an anatomy, so that the tables of coronaries and aorta stay tables.
#include <array>
#include <random>

#include "vascular/anatomy/anatomy.h"
#include "vascular/anatomy/root.h"

namespace ostium::vascular {

/// A point of a course in mm and the diameter there, 0 where it is interpolated.
struct TableRow {
  double x, y, z, diameter_mm;
};

class AnatomyBuilder {
 public:
  explicit AnatomyBuilder(Anatomy& anatomy) : anatomy_(anatomy) {}

  /// A tube out of the parent's centreline at the point nearest to the course's first. Its own branch has its name;
  /// with `trunk`, the stretch before the point nearest to `trunk_end` has that name instead.
  int add(const std::string& name, int parent, std::vector<CoursePoint> course, double blend = 1);
  void name_trunk(const std::string& trunk, const Eigen::Vector3d& trunk_end);
  int tube(const std::string& branch) const;  ///< index of the tube that a branch is part of

 private:
  Anatomy& anatomy_;
};

void add_aorta(AnatomyBuilder& builder, const Root& root, const AnatomyParameters& parameters, Landmarks& landmarks);
void add_coronaries(AnatomyBuilder& builder, const Root& root, const AnatomyParameters& parameters);

}  // namespace ostium::vascular
