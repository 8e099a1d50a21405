#pragma once
/// A measured set: one instrument, or several nested ones, measured several times. SI internally; the file's schema is
/// data/schemas/measurement.schema.json.
#include <memory>
#include <optional>

#include "core/model/state.h"
#include "data/formats/load_error.h"
#include "data/identification/measurement/camera.h"

namespace ostium::data {

struct MeasuredInstrument {
  std::string name;
  double length_m = 0;
  double radius_m = 0, inner_radius_m = 0;
  std::vector<core::Section> sections;  ///< from the distal tip towards the hub
};

/// Insertion and roll of one instrument.
struct Placement {
  double inserted_m = 0;  ///< from the base to its tip
  double roll_rad = 0;    ///< as commanded, right-handed about the base's d3; full turns are kept
  double shaft_m = 0;     ///< straight shaft between the drive that rolls it and the base
};

/// A wire as a person clicked it along in one view, base to tip.
struct ClickedPolyline {
  int view = 0;  ///< of the set's views
  std::vector<Eigen::Vector2d> points_px;
};

struct Experiment {
  std::string id;
  std::string place;           ///< "experiments[3]", for messages
  core::EndState base;         ///< d3 is the tangent, d1 is `up` made orthogonal to it; before roll
  std::vector<Placement> set;  ///< one per instrument
  std::vector<std::optional<Eigen::Vector2d>> specimen;  ///< rest curvature, 1/m, replacing nonzero declared ones
  Eigen::Vector3d tip_force_N = Eigen::Vector3d::Zero();
  std::optional<double> proximal_force_N;
  std::optional<double> elapsed_s;
  std::string group;  ///< empty if none

  enum class Kind { centreline, tip, radius, projections };
  Kind kind = Kind::centreline;
  std::vector<Eigen::Vector3d> points_m;  ///< base to tip; a single point for a tip
  double radius_m = 0;
  std::vector<ClickedPolyline> polylines;  ///< of projections, one for each view that saw it
};

struct Imaging {
  std::optional<double> noise_sigma_m;  ///< per coordinate; px for projections (MisfitUnit)
  bool registration_free = false;       ///< measured = R model + t
  bool tip_offset_free = false;         ///< tracked = tip + R_tip o
};

struct MeasuredVessel {
  std::string mesh, units;
  double friction = 0;
  std::shared_ptr<const core::SurfaceDescription> wall;  ///< oriented outwards, in the set's frame
};

/// One view of a C-arm.
struct MeasuredCArm {
  std::string id;
  Camera camera;
};

/// The unit of misfits, of their noise and their root mean squares. Where names end in _m, they are in m, or in px
/// where a set was measured in pixels; divided by `size` they are in the unit that people see.
struct MisfitUnit {
  std::string name = "mm";
  double size = 1e-3;
};

/// An effect that the file asks the model to include.
struct DeclaredEffect {
  std::string id;
  std::optional<int> instrument;  ///< none: all that it can act on
  std::vector<std::pair<std::string, double>> parameters;
  std::string place;  ///< "FILE:LINE: effects[0]", for messages
};

struct MeasurementSet {
  std::string file;
  std::string table;  ///< of polylines; empty: they are in the file
  std::string title, source;
  std::vector<MeasuredInstrument> instruments;  ///< outermost first
  Eigen::Vector3d gravity_m_s2 = Eigen::Vector3d::Zero();
  std::optional<MeasuredVessel> vessel;
  Imaging imaging;
  std::vector<MeasuredCArm> views;  ///< of a set of projections; others have none
  std::vector<DeclaredEffect> effects;
  std::vector<Experiment> experiments;

  MisfitUnit unit() const { return views.empty() ? MisfitUnit{} : MisfitUnit{"px", 1}; }
};

}  // namespace ostium::data
