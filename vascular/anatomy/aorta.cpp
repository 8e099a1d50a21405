#include <cmath>

#include "core/base/units.h"
#include "vascular/anatomy/builder.h"

namespace ostium::vascular {

namespace {

std::vector<CoursePoint> course(const std::vector<TableRow>& rows) {
  std::vector<CoursePoint> points;
  for (const TableRow& r : rows) points.push_back({Eigen::Vector3d(r.x, r.y, r.z) * 1e-3, r.diameter_mm / 2e3});
  return points;
}

CoursePoint point(const Eigen::Vector3d& p, double diameter_mm = 0) { return {p, diameter_mm / 2e3}; }

Eigen::Vector3d at_mm(double x, double y, double z) { return Eigen::Vector3d(x, y, z) * 1e-3; }

/// The three sinuses with the closed leaflets between them: a wire lands on their floor.
void add_sinuses(AnatomyBuilder& builder, const Root& root, double sinus_mm) {
  const double k = sinus_mm / 29.8;
  const auto sinus = [&](const char* name, const Eigen::Vector3d& side) {
    const Eigen::Vector3d out = 4.6e-3 * k * side, low = root.p_annulus + 9.8e-3 * k * root.axis;
    builder.add(name, 0, {point(low + out, 19.6 * k), point(low + out + 5.5e-3 * k * root.axis, 20.6 * k)}, 0.5);
  };
  sinus("left sinus", root.to_left);
  sinus("right sinus", root.to_right);
  sinus("non-coronary sinus", root.to_noncoronary);
}

void add_arch_branches(AnatomyBuilder& builder, bool radial, Landmarks& marks) {
  std::vector<TableRow> right = {
      {-15, 66, -1, 12}, {-20, 84, -1, 12}, {-29, 104, -6, 11}, {-46, 119, -16, 9.3}, {-78, 118, -28, 8.6}};
  if (!radial) {
    right.back().diameter_mm = 8.4;
    builder.add("right subclavian", 0, course(right), 0.8);
  } else {
    for (const TableRow& row : std::vector<TableRow>{{-112, 99, -38, 7.2},
                                                     {-146, 64, -46, 6.2},
                                                     {-166, 10, -52, 5.2},
                                                     {-184, -75, -55, 4.6},
                                                     {-206, -160, -50, 4.3},
                                                     {-220, -215, -40, 3.4},
                                                     {-232, -300, -32, 2.9},
                                                     {-243, -385, -25, 2.6},
                                                     {-247, -412, -22, 2.6}})
      right.push_back(row);
    builder.add("right arm", 0, course(right), 0.8);
    builder.name_trunk("right subclavian", at_mm(-112, 99, -38));
    marks.p_access = at_mm(-243, -385, -25);
  }
  const int trunk = builder.tube("right subclavian");
  builder.add("right carotid", trunk, course({{-29, 104, -6, 7.4}, {-33, 122, -4, 7}, {-36, 160, -4, 6.4}}), 0.8);
  builder.add("left carotid", 0,
              course({{-5, 72, -18, 7.6}, {0, 92, -17, 7.2}, {10, 125, -10, 6.8}, {17, 160, -6, 6.4}}), 0.8);
  builder.add(
      "left subclavian", 0,
      course({{6, 70, -36, 10}, {13, 90, -37, 9.6}, {28, 112, -38, 9}, {56, 122, -40, 8.6}, {82, 114, -42, 8.4}}), 0.8);
}

void add_abdomen(AnatomyBuilder& builder, const AnatomyParameters& p, Landmarks& marks) {
  builder.add("coeliac trunk", 0, course({{5, -152, -52, 7.5}, {3, -158, -33, 7}, {4, -166, -20, 6.4}}), 0.6);
  builder.add("superior mesenteric", 0, course({{3, -168, -49, 7.5}, {1, -178, -31, 7}, {-3, -212, -19, 6.2}}), 0.6);
  builder.add("right renal", 0, course({{2, -186, -45, 6}, {-14, -188, -46, 5.6}, {-40, -196, -62, 5.2}}), 0.6);
  builder.add("left renal", 0, course({{2, -190, -44, 6}, {18, -192, -48, 5.6}, {42, -198, -64, 5.2}}), 0.6);
  const double cia = p.common_iliac_mm, eia = p.external_iliac_mm, cfa = p.femoral_mm;
  // The right common iliac continues the aorta's tube.
  builder.add("left iliac", 0,
              course({{-1, -277, -35, cia},
                      {13, -294, -40, cia},
                      {27, -315, -54, 0.95 * cia},
                      {38, -338, -56, eia},
                      {55, -372, -26, eia},
                      {70, -400, 2, eia},
                      {76, -420, 12, cfa},
                      {79, -446, 12, cfa},
                      {80, -470, 6, 0.9 * cfa}}),
              0.9);
  builder.add("right internal iliac", builder.tube("aorta"),
              course({{-31, -316, -54, 6}, {-40, -330, -68, 5.6}, {-46, -352, -82, 5}}), 0.8);
  builder.add("left internal iliac", builder.tube("left iliac"),
              course({{29, -317, -55, 6}, {38, -330, -68, 5.6}, {44, -352, -82, 5}}), 0.8);
  marks.p_access = at_mm(-81, -446, 12);
}

}  // namespace

void add_aorta(AnatomyBuilder& builder, const Root& root, const AnatomyParameters& p, Landmarks& marks) {
  const Eigen::Vector3d from = root.p_annulus, a = root.axis;
  const double k = p.sinus_mm / 29.8;
  std::vector<CoursePoint> aorta = {point(from + 13e-3 * k * a, 23.5 * k), point(from + 23e-3 * k * a, 27 * k),
                                    point(at_mm(-21.5, 5.5, 13.5)), point(at_mm(-25, 14, 15.5), p.ascending_mm)};
  // The arch: half an ellipse of the published width and height, in a plane from right anterior to left posterior.
  const Eigen::Vector3d first = at_mm(-25, 25, 14), across = at_mm(0.51, 0, -0.86).normalized();
  const double half_width = p.arch_width_mm / 2e3, height = p.arch_height_mm / 1e3;
  for (int i = 0; i <= 6; ++i) {
    const double u = units::pi * i / 6;
    const Eigen::Vector3d at =
        first + half_width * (1 - std::cos(u)) * across + Eigen::Vector3d(0, height * std::sin(u), 0);
    const double diameters_mm[] = {0, p.ascending_mm - 1.5, p.arch_mm, 0, p.arch_mm - 1.6, p.isthmus_mm, 0};
    aorta.push_back(point(at, diameters_mm[i]));
  }
  const double d = p.diaphragm_mm, i = p.infrarenal_mm;
  std::vector<TableRow> down = {{16, -10, -58, 0}, {14, -60, -58, 0}, {9, -110, -55, d}, {5, -150, -52, 0.92 * d}};
  if (p.access == Access::femoral) {
    const double cia = p.common_iliac_mm, eia = p.external_iliac_mm, cfa = p.femoral_mm;
    for (const TableRow& row : std::vector<TableRow>{{2, -190, -44, 0.5 * (0.8 * d + i)},
                                                     {0, -230, -36, i},
                                                     {-1, -262, -33, i},
                                                     {-5, -283, -36, 0.85 * i},
                                                     {-14, -298, -42, cia},
                                                     {-29, -316, -54, 0.95 * cia},
                                                     {-40, -339, -56, eia},
                                                     {-57, -373, -26, eia},
                                                     {-72, -401, 2, eia},
                                                     {-78, -421, 12, cfa},
                                                     {-81, -446, 12, cfa},
                                                     {-82, -470, 6, 0.9 * cfa}})
      down.push_back(row);
  } else {
    down.push_back({2, -190, -44, 0.5 * (0.8 * d + i)});
  }
  for (const CoursePoint& c : course(down)) aorta.push_back(c);
  builder.add(p.access == Access::femoral ? "right iliac" : "aorta", -1, aorta);
  if (p.access == Access::femoral) builder.name_trunk("aorta", at_mm(-5, -283, -36));
  add_sinuses(builder, root, p.sinus_mm);
  add_arch_branches(builder, p.access == Access::radial, marks);
  if (p.access == Access::femoral) add_abdomen(builder, p, marks);
}

}  // namespace ostium::vascular
