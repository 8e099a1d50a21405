#pragma once
/// Small plots as SVG text, for reports.
#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace ostium::data {

class Plot {
 public:
  Plot(std::string title, std::string x_label, std::string y_label, double width = 460, double height = 300);

  using Points = std::vector<Eigen::Vector2d>;
  void line(const Points& points, const std::string& colour, double width = 1.6, const std::string& dashes = "");
  void dots(const Points& points, const std::string& colour, double radius = 2.2);
  /// A line across the whole plot at y, labelled at its right end.
  void level(double y, const std::string& words);
  /// Vertical bars from zero: one per value and series, side by side, labelled below.
  void bars(const std::vector<std::string>& names, const std::vector<std::vector<double>>& series,
            const std::vector<std::string>& colours);
  void legend(const std::string& words, const std::string& colour, bool dot = false, const std::string& dashes = "");
  /// Uses the same scale for x and y.
  void equal_scales() { equal_ = true; }
  /// Larger values of y are further down, as rows of pictures are.
  void y_downwards() { downwards_ = true; }
  void y_from_zero() { include_.push_back({NAN, 0}); }

  std::string svg() const;

 private:
  struct Item {
    Points points;
    std::string colour, dashes;
    double size;
    bool dots;
  };
  struct Entry {
    std::string words, colour, dashes;
    bool dot;
  };
  std::string title_, x_label_, y_label_;
  double width_, height_;
  bool equal_ = false, downwards_ = false;
  std::vector<Item> items_;
  std::vector<std::pair<double, std::string>> levels_;
  std::vector<Entry> legend_;
  std::vector<std::string> bar_names_;
  std::vector<std::vector<double>> bar_values_;
  std::vector<std::string> bar_colours_;
  std::vector<Eigen::Vector2d> include_;
};

}  // namespace ostium::data
