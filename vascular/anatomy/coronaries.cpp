/// The coronary arteries of the mean right-dominant heart and its variants.
///
/// Courses: the points of Dodge et al., Circulation 1988;78:1167 (origins and middles of segments), joined so that the
/// artery runs on the heart; mm from the left ostium, for the right coronary from the right ostium; x left, y head, z
/// front. Proximal and distal diameters: Dodge et al., Circulation 1992;86:232; middle ones: CT. Side branches without
/// published diameters taper from about 2 mm (septals 1.5 to 2.0 mm).
#include <cassert>
#include <cmath>
#include <random>

#include "core/base/units.h"
#include "vascular/anatomy/builder.h"

namespace ostium::vascular {

namespace {

class Coronaries {
 public:
  Coronaries(AnatomyBuilder& builder, const Root& root, const AnatomyParameters& parameters)
      : builder_(builder), root_(root), p_(parameters), engine_(parameters.wander_seed) {}

  void add_left() {
    const double lm = p_.left_main_mm, lad = p_.lad_proximal_mm, end = p_.lad_distal_mm, lcx = p_.lcx_proximal_mm;
    std::vector<CoursePoint> course = from_left({{6.9, 0.6, 1.4, lm},
                                                 {11.2, -0.5, 3.2, 0.98 * lm},
                                                 {15, -0.9, 5.7, lad},
                                                 {20.4, -2, 10.6, 0.98 * lad},
                                                 {27.6, -4.9, 18.2, 0},
                                                 {35.4, -10.6, 34, 0.45 * lad + 0.45 * end},
                                                 {40.3, -21, 50, 0},
                                                 {42.3, -37, 64, end},
                                                 {42.8, -53.5, 73.4, 0.92 * end},
                                                 {44, -71, 76.5, 0},
                                                 {44.8, -86, 72, 0.75 * end},
                                                 {42.4, -89.5, 65.5, 0.68 * end},
                                                 {40, -89.5, 60, 0.62 * end}});
    course.insert(course.begin(),
                  {{root_.p_left_ostium - 5e-3 * root_.to_left, lm / 2e3}, {root_.p_left_ostium, lm / 2e3}});
    builder_.add("LAD", 0, wandering(course, 4), 0.7);
    builder_.name_trunk("LM", root_.from_left({11.2, -0.5, 3.2}));
    add_circumflex(lcx);
    const double k = p_.side_branch_scale;
    side("D1", "LAD",
         {{27.2, -4.7, 17.5, 2.1 * k},
          {38, -10.5, 21.5, 2 * k},
          {49.9, -24.2, 27.7, 1.7 * k},
          {58, -39, 34, 0},
          {61, -52, 41, 1.1 * k}});
    if (p_.diagonals > 1)
      side("D2", "LAD",
           {{35.1, -10.2, 33, 1.9 * k},
            {44, -18, 38.5, 1.8 * k},
            {53.1, -31.3, 46.1, 1.5 * k},
            {58, -44, 52, 0},
            {59.5, -55, 57, 1.1 * k}});
    if (p_.diagonals > 2)
      side("D3", "LAD",
           {{40.2, -20.5, 49.5, 1.6 * k},
            {47, -28, 54.5, 1.5 * k},
            {54.1, -39.5, 60.1, 1.3 * k},
            {56.5, -52, 65, 1 * k}});
    side("S1", "LAD",
         {{27.8, -5.2, 18.8, 1.8 * k},
          {25.5, -12, 25.5, 1.7 * k},
          {21.1, -22.1, 30.2, 1.4 * k},
          {16.5, -33, 34, 1 * k}});
    side("S2", "LAD",
         {{35.6, -11.2, 35.5, 1.6 * k},
          {31.5, -19, 40.5, 1.5 * k},
          {26.1, -28.1, 43.5, 1.3 * k},
          {20.5, -37, 45.5, 1 * k}});
    side("S3", "LAD",
         {{40.4, -21.6, 51, 1.4 * k}, {36.5, -29.5, 54, 1.3 * k}, {31.3, -37.6, 54.2, 1.1 * k}, {26, -45, 54, 1 * k}});
    if (p_.ramus)
      side("Ramus", "LAD",
           {{11.2, -0.6, 2.8, 2.3 * k},
            {22, -6.5, 5.5, 2.2 * k},
            {36, -19, 8.5, 2 * k},
            {45.7, -31.3, 9.5, 1.7 * k},
            {54, -45, 15, 1.1 * k}});
  }

  void add_right() {
    const double d = p_.rca_proximal_mm, k = p_.side_branch_scale;
    const bool reaches_crux = p_.dominance != Dominance::left;
    std::vector<TableRow> rows = {{-1.9, -0.8, 3.7, d},      {-5.4, -2.4, 5.1, d},          {-14.4, -6.9, 6, 0.98 * d},
                                  {-24, -19, 9.8, 0.93 * d}, {-29.3, -34.2, 9.5, 0.87 * d}, {-28.6, -48.5, 6, 0.8 * d}};
    if (reaches_crux) {
      for (const TableRow& row : std::vector<TableRow>{{-23.2, -58, -1, 0.75 * d}, {-13.5, -61.5, -12.5, 0.7 * d}})
        rows.push_back(row);
      if (p_.dominance == Dominance::right)
        for (const TableRow& row : std::vector<TableRow>{{-0.3, -57.2, -25, 0.56 * d},
                                                         {7, -57.5, -31, 0.5 * d},
                                                         {15.5, -61.5, -35.5, 0.46 * d},
                                                         {25.7, -66.6, -36.7, 0.4 * d},
                                                         {37, -69, -31, 0},
                                                         {47, -70, -22, 1.1 * k}})
          rows.push_back(row);
      else
        for (const TableRow& row : std::vector<TableRow>{{-5, -66, -12, 0.5 * d},
                                                         {7, -70, -5, 0.45 * d},
                                                         {18.1, -73.8, 3.2, 1.5 * k},
                                                         {33, -77, 14, 0},
                                                         {43, -78.5, 25, 1.1 * k}})
          rows.push_back(row);
    } else {
      for (const TableRow& row : std::vector<TableRow>{{-23.2, -58, -1, 1.5 * k}, {-15, -62, -9, 1.1 * k}})
        rows.push_back(row);
    }
    std::vector<CoursePoint> course = from_right(rows);
    course.insert(course.begin(),
                  {{root_.p_right_ostium - 5e-3 * root_.to_right, d / 2e3}, {root_.p_right_ostium, d / 2e3}});
    const char* end_name = p_.dominance == Dominance::right      ? "PLV"
                           : p_.dominance == Dominance::balanced ? "PDA"
                                                                 : "RCA";
    builder_.add(end_name, 0, wandering(course, 4), 0.7);
    if (reaches_crux) builder_.name_trunk("RCA", root_.from_right({-9, -61.2, -16.5}));
    right_side("Conus", "RCA",
               {{-8, -3.2, 5.6, 1.3 * k}, {-5, -7, 13, 1.2 * k}, {4, -15, 24, 1.1 * k}, {14, -24, 33, 1 * k}});
    right_side("RV", "RCA",
               {{-28.4, -49.5, 5.5, 1.8 * k},
                {-23, -57, 14, 1.7 * k},
                {-10, -65, 27, 1.5 * k},
                {8, -72, 38, 0},
                {22, -76, 44, 1.1 * k}});
    if (p_.dominance == Dominance::right) {
      right_side("PDA", "PLV",
                 {{-9.6, -61.2, -16, 0.5 * d + 0.2},
                  {-3, -67, -8.5, 0.5 * d},
                  {6, -70.6, -3, 0},
                  {18.1, -73.8, 3.2, 1.7 * k},
                  {33, -77, 14, 0},
                  {43, -78.5, 25, 1.1 * k}});
      right_side(
          "PLV2", "PLV",
          {{2, -57, -27, 1.7 * k}, {9, -63.5, -26, 1.6 * k}, {17.2, -70.5, -22.7, 1.4 * k}, {29, -74.5, -15, 1 * k}});
    }
  }

 private:
  void add_circumflex(double d) {
    std::vector<TableRow> rows = {{11.2, -0.5, 3, d},           {13.5, -2.7, 0.9, d},
                                  {16.2, -7.2, -1.6, 0.98 * d}, {18.6, -11.6, -4.6, 0.94 * d},
                                  {22, -18.7, -10.8, 0.8 * d},  {23, -26, -15.2, 0.7 * d},
                                  {22, -36.8, -21, 0.55 * d}};
    const double k = p_.side_branch_scale;
    if (p_.dominance == Dominance::right) {
      rows.push_back({17.5, -45, -22.5, 0.45 * d});
      rows.push_back({12, -51, -21.5, 0.38 * d});
    } else {
      rows[5].diameter_mm = 0.82 * d, rows[6].diameter_mm = 0.74 * d;
      rows.push_back({15, -47.5, -22.5, 0.68 * d});
      rows.push_back({4.6, -57.5, -18.6, 0.6 * d});
      if (p_.dominance == Dominance::left) {
        rows.push_back({-6, -66, -8, 0.54 * d});
        for (const TableRow& row :
             std::vector<TableRow>{{-5, -74.5, 5, 0.48 * d}, {5, -82, 18, 2}, {18, -88, 33, 0}, {31, -90, 48, 1.2}})
          rows.push_back(row);
      } else {
        rows.push_back({-2, -62.5, -12.5, 1.4});
      }
    }
    std::vector<CoursePoint> course = from_left(rows);
    if (p_.dominance == Dominance::left) {
      builder_.add("PDA", builder_.tube("LM"), wandering(course, 2), 0.7);
      builder_.name_trunk("LCx", root_.from_left({-6, -66, -8}));
    } else {
      builder_.add("LCx", builder_.tube("LM"), wandering(course, 2), 0.7);
    }
    side("OM1", "LCx",
         {{18.5, -11.4, -4.4, 2.2 * k},
          {29, -20.5, -4, 2.1 * k},
          {44.1, -34.5, -0.8, 1.8 * k},
          {54, -46.5, 5.5, 0},
          {59, -57, 13, 1.1 * k}});
    side("OM2", "LCx",
         {{22.5, -22, -12.8, 2.1 * k},
          {28.5, -32, -14, 2 * k},
          {35.7, -46.6, -12.3, 1.7 * k},
          {41.5, -58, -7, 0},
          {45.5, -68, 1, 1.1 * k}});
    side("OM3", "LCx",
         {{22.2, -36, -20.6, 1.7 * k},
          {26.5, -45, -20.5, 1.6 * k},
          {30.4, -55.1, -16.4, 1.4 * k},
          {34, -66, -9.5, 1.1 * k}});
    if (p_.dominance != Dominance::right)
      side("PLV", "LCx",
           {{10, -53, -21, 1.9 * k}, {12, -65, -18.5, 1.8 * k}, {15.5, -77, -11.5, 1.5 * k}, {25, -84, -2, 1.1 * k}});
  }

  std::vector<CoursePoint> placed(const std::vector<TableRow>& rows, bool right) const {
    std::vector<CoursePoint> course;
    for (const TableRow& r : rows) {
      const Eigen::Vector3d p(r.x, r.y, r.z);
      course.push_back({right ? root_.from_right(p) : root_.from_left(p), r.diameter_mm / 2e3});
    }
    return course;
  }
  std::vector<CoursePoint> from_left(const std::vector<TableRow>& rows) const { return placed(rows, false); }
  std::vector<CoursePoint> from_right(const std::vector<TableRow>& rows) const { return placed(rows, true); }

  void side(const char* name, const char* parent, const std::vector<TableRow>& rows) {
    builder_.add(name, builder_.tube(parent), wandering(from_left(rows), 2), 0.8);
  }
  void right_side(const char* name, const char* parent, const std::vector<TableRow>& rows) {
    builder_.add(name, builder_.tube(parent), wandering(from_right(rows), 2), 0.8);
  }

  /// Bends the course by the remaining scatter between people: two waves along it, from its point `first` on.
  std::vector<CoursePoint> wandering(std::vector<CoursePoint> course, std::size_t first) {
    const auto deviate = [&] {  // the sum of four uniform numbers has variance 1/3
      double sum = -2;
      for (int n = 0; n < 4; ++n) sum += static_cast<double>(engine_() >> 11) / 9007199254740992.0;
      return std::sqrt(3.0) * sum;
    };
    std::vector<double> length(course.size(), 0);
    for (std::size_t i = first + 1; i < course.size(); ++i)
      length[i] = length[i - 1] + (course[i].p - course[i - 1].p).norm();
    for (int wave = 1; wave <= 2; ++wave) {
      const double x = deviate(), y = deviate(), z = deviate();
      for (std::size_t i = first; i < course.size(); ++i)
        course[i].p +=
            p_.course_wander_m * std::sin(units::pi * wave * length[i] / length.back()) * Eigen::Vector3d(x, y, z);
    }
    return course;
  }

  AnatomyBuilder& builder_;
  const Root& root_;
  const AnatomyParameters& p_;
  std::mt19937_64 engine_;
};

}  // namespace

void add_coronaries(AnatomyBuilder& builder, const Root& root, const AnatomyParameters& parameters) {
  Coronaries coronaries(builder, root, parameters);
  coronaries.add_left();
  coronaries.add_right();
}

}  // namespace ostium::vascular
