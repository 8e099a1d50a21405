#pragma once
/// Measured sets made by the boundary-value solver, with noise, to test the fit.
#include <Eigen/Geometry>

#include "data/identification/measurement/measurement_set.h"
#include "tests/support/boundary_value.h"
#include "tests/support/one_wire.h"

namespace ostium::synthetic {

/// How the true parameters differ from the set's declaration.
struct Truth {
  std::vector<std::vector<double>> stiffness_scale;  ///< per instrument and section
  double shaft_compliance = 0;                       ///< of the shafts relative to that given by their GJ
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
  Eigen::Vector3d t_m = Eigen::Vector3d::Zero(), tip_offset_m = Eigen::Vector3d::Zero();
  double sigma_m = 0;
  unsigned seed = 1;
};

/// The boundary-value problem of an experiment.
boundary_value::Problem problem_of(const data::MeasurementSet& set, const data::Experiment& experiment,
                                   const Truth& truth);

/// Fills in the measurements: centrelines (a point every `spacing_m`) or tips, according to each experiment's kind.
void measure(data::MeasurementSet& set, const Truth& truth, double spacing_m = 5e-3);

/// A wire with a soft curved tip, 120 to 300 mm of it inserted horizontally, rolled; some experiments have a load at
/// its tip.
data::MeasurementSet free_wire(int experiments);

/// The free part of this wire beyond the end of a tube, 90 to 190 mm of it, some with a load at its tip.
data::MeasurementSet free_shapes_of(const BenchWire& wire, unsigned seed);

/// Two tubes with curved ends and shafts behind the base; tips tracked in a separate frame.
data::MeasurementSet two_tubes(int experiments);

/// The set's file.
std::string to_json(const data::MeasurementSet& set);

/// Writes measurement.json and its mesh, in metres; returns the former's path.
std::string write_set(const std::string& folder, const data::MeasurementSet& set);

}  // namespace ostium::synthetic
