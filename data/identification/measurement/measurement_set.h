#pragma once
/// A measured set: one instrument, or several nested ones, measured several times. SI internally; the file's schema is
/// data/schemas/measurement.schema.json.
#include <memory>
#include <optional>

#include "core/model/state.h"
#include "data/formats/load_error.h"

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

  enum class Kind { centreline, tip, radius };
  Kind kind = Kind::centreline;
  std::vector<Eigen::Vector3d> points_m;  ///< base to tip; a single point for a tip
  double radius_m = 0;
};

struct Imaging {
  std::optional<double> noise_sigma_m;  ///< per coordinate
  bool registration_free = false;       ///< measured = R model + t
  bool tip_offset_free = false;         ///< tracked = tip + R_tip o
};

struct MeasuredVessel {
  std::string mesh, units;
  double friction = 0;
  std::shared_ptr<const core::SurfaceDescription> wall;  ///< oriented outwards, in the set's frame
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
  std::string title, source;
  std::vector<MeasuredInstrument> instruments;  ///< outermost first
  Eigen::Vector3d gravity_m_s2 = Eigen::Vector3d::Zero();
  std::optional<MeasuredVessel> vessel;
  Imaging imaging;
  std::vector<DeclaredEffect> effects;
  std::vector<Experiment> experiments;
};

}  // namespace ostium::data
