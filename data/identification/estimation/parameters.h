#pragma once
/// The parameters that a fit may change: one scale per distinct section stiffness, whatever `imaging` leaves free, and
/// the parameters of the effects being tried. Nothing else.
#include "data/identification/effects/effect.h"
#include "data/identification/forward/misfit.h"

namespace ostium::data {

struct Parameter {
  std::string name;   ///< as in explanation.json: "EI_scale[0]", "registration.x_mm", "shaft_torsion.compliance"
  std::string label;  ///< description for people
  std::string unit;   ///< "1" if there is none
  double start = 0;   ///< also the mean of the prior
  double spread = 0;  ///< standard deviation of the prior; of the logarithm if `logarithmic`
  double least = 0, most = 0;
  bool logarithmic = false;
  bool moves_shape = true;  ///< false: changes only how the shape appears in the measurement
  double step = 0;          ///< finite-difference step in the optimiser's numbers; 0: derived from the spread
};

/// Parameters as a vector x of numbers for an optimiser; logarithmic ones as logarithms.
class Parameters {
 public:
  Parameters(const MeasurementSet& set, const std::vector<ActiveEffect>& declared,
             const std::vector<ActiveEffect>& tried);

  const std::vector<Parameter>& list() const { return list_; }
  int size() const { return static_cast<int>(list_.size()); }
  Eigen::VectorXd start() const;
  double value(int i, double x) const;      ///< value of parameter i at x
  double inner(int i, double value) const;  ///< the x that gives this value
  /// x at `part` (0 to 1) of the interval of two spreads on either side of the prior, within the range.
  double within(int i, double part) const;
  /// Multiplies the prior widths of the last tried effect's parameters by `factor`.
  void widen_last_effect(double factor);
  /// Widens the finite differences for a model that comes to rest only approximately.
  void coarsen_steps();
  double sigma(int i, double x, double sigma_x) const;
  /// Number of parameters that move shapes; they come first in x.
  int shape_parameters() const { return shape_parameters_; }

  Changes changes(const Eigen::VectorXd& x) const;
  MeasuredView view(const Eigen::VectorXd& x) const;
  /// The frame relative to which `view` is counted.
  void set_nominal_view(const MeasuredView& view) { nominal_ = view; }

 private:
  void add_stiffness(const MeasurementSet& set);
  void add_effect(const MeasurementSet& set, std::size_t tried);
  void add_view(const Imaging& imaging);

  std::vector<Parameter> list_;
  int shape_parameters_ = 0;
  std::vector<std::vector<int>> scale_of_;  ///< per instrument and section: index of its scale
  std::vector<ActiveEffect> declared_, tried_;
  std::vector<std::vector<int>> index_of_;  ///< per tried effect and parameter: index in the list, -1 if held fixed
  int registration_ = -1, offset_ = -1;     ///< index of the first of six, and of three
  MeasuredView nominal_;
};

/// The registration that best fits predicted to measured points (Kabsch 1976), without a tip offset.
MeasuredView registered(const MeasurementSet& set, const std::vector<PredictedShape>& shapes);

}  // namespace ostium::data
