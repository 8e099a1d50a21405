#pragma once
/// A plain SVG drawing in millimetres, for README pictures and `ostium instruments --picture`.
#include <Eigen/Core>
#include <string>
#include <vector>

namespace ostium::data {

/// x to the right, y down, mm. Later shapes cover earlier ones.
class Drawing {
 public:
  Drawing(double width_mm, double height_mm) : width_(width_mm), height_(height_mm) {}

  void line(const std::vector<Eigen::Vector2d>& points_mm, const std::string& colour, double thickness_mm,
            bool round_ends = true);
  void cross(const Eigen::Vector2d& at_mm, const std::string& colour);
  void rectangle(const Eigen::Vector2d& corner_mm, const Eigen::Vector2d& size_mm, const std::string& colour);
  void text(const Eigen::Vector2d& at_mm, const std::string& words, double size_mm = 3.5);

  /// Throws WriteError.
  void write(const std::string& path) const;

 private:
  double width_, height_;
  std::string body_;
};

}  // namespace ostium::data
