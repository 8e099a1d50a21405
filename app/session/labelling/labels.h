#pragma once
/// What is where in a picture of a session: the truth that a picture hides.
#include <string>
#include <vector>

#include "app/session/model/session.h"
#include "fluoro/display/display.h"
#include "fluoro/projection/silhouette.h"

namespace ostium::app {

/// Pixels of a mask by what is there, the nearer to the operator's attention the higher; what is higher lies on top.
enum class LabelClass { none, vessel, coronary, catheter, wire, device_shaft, balloon, stent };
inline constexpr const char* label_class_names[] = {"background", "vessel",       "coronary artery", "catheter",
                                                    "wire",       "device shaft", "balloon",         "stent"};

struct LabelledThing {
  LabelClass of_class = LabelClass::none;
  std::string name;      ///< of a branch, or of the script's tool; "balloon", "stent"
  std::string category;  ///< of COCO: a branch's name, or an instrument's kind
  int tool = -1;         ///< of a tool, its index
  fluoro::Silhouette covered;
  Eigen::Matrix3Xd line_P;  ///< its centreline, m: a branch's from its origin, a tool's from the introducer to the tip
};

struct LabelledPoint {
  std::string name;  ///< "tip of wire", "marker 1 of balloon", "ostium of RCA", "lesion 1, middle"
  Eigen::Vector3d p_P = Eigen::Vector3d::Zero();
};

struct Labels {
  std::vector<LabelledThing> things;  ///< those that cover at least a pixel, lowest class first
  std::vector<LabelledPoint> points;
};

/// What a pixel shows: the highest class that covers it, and how far that is from the source.
struct LabelledPixels {
  fluoro::Picture mask;              ///< LabelClass of each pixel
  std::vector<std::uint16_t> depth;  ///< in units of depth_unit_m, along the axis of the beam; 0: nothing
};
inline constexpr double depth_unit_m = 20e-6;

LabelledPixels pixels_of(const fluoro::View& view, const Labels& labels);

class Labeller {
 public:
  /// Keeps what does not change. Takes some 0.1 s. The model must outlive this.
  explicit Labeller(const SessionModel& model);
  Labels at(const SessionState& state, const fluoro::View& view) const;

 private:
  void find_cells();
  std::vector<Eigen::Vector3d> wall_at(const SessionState& state) const;
  void add_vessels(const SessionState& state, const fluoro::View& view, Labels& out) const;
  void add_tools(const SessionState& state, const fluoro::View& view, Labels& out) const;
  void add_treatment(const SessionState& state, const fluoro::View& view, Labels& out) const;
  void add_places(const SessionState& state, Labels& out) const;
  Eigen::Vector3d centre(std::size_t branch, std::size_t sphere, const SessionState& state) const;

  const SessionModel& model_;
  const std::vector<std::array<int, 3>>& triangles_;  ///< of the lumen
  std::vector<int> branch_of_;                        ///< of each triangle
  std::vector<bool> coronary_;                        ///< whether a branch is one
  std::vector<std::vector<int>> cell_of_;             ///< of each branch's spheres; -1: none
};

}  // namespace ostium::app
