#pragma once
/// What a fit may change: one scale per distinct section stiffness, what `imaging` leaves free, and the parameters of
/// the effects that are tried. Nothing else.
#include "data/identification/effects/effect.h"
#include "data/identification/forward/misfit.h"

namespace ostium::data {

struct Parameter {
  std::string name;   ///< as in explanation.json: "EI_scale[0]", "registration.x_mm", "shaft_torsion.compliance"
  std::string label;  ///< in words
  std::string unit;   ///< "1" if there is none
  double start = 0;   ///< also the middle of the prior
  double spread = 0;  ///< of the prior: standard deviation, of the logarithm if `logarithmic`
  double least = 0, most = 0;
  bool logarithmic = false;
  bool moves_shape = true;  ///< false: changes only how the shape appears
  double step = 0;          ///< of finite differences, in the optimiser's numbers; 0: by the spread
};

/// Parameters as a vector of numbers for an optimiser: logarithms where they are logarithmic.
class Parameters {
 public:
  Parameters(const MeasurementSet& set, const std::vector<ActiveEffect>& declared,
             const std::vector<ActiveEffect>& tried);

  const std::vector<Parameter>& list() const { return list_; }
  int size() const { return static_cast<int>(list_.size()); }
  Eigen::VectorXd start() const;
  double value(int i, double x) const;      ///< of parameter i
  double inner(int i, double value) const;  ///< the x that has this value
  /// x that lies `part` (0 to 1) of the way through what the prior expects, two spreads to each side, and the range.
  double within(int i, double part) const;
  /// Makes the priors of the tried effects' parameters `factor` times as wide.
  void widen_effects(double factor);
  /// Finite differences wide enough for a model that comes to rest only nearly.
  void coarsen_steps();
  double sigma(int i, double x, double sigma_x) const;
  /// The part of x that moves shapes comes first; so many.
  int shape_parameters() const { return shape_parameters_; }

  Changes changes(const Eigen::VectorXd& x) const;
  MeasuredView view(const Eigen::VectorXd& x) const;
  /// The frame that `view` counts from.
  void set_nominal_view(const MeasuredView& view) { nominal_ = view; }

 private:
  void add_stiffness(const MeasurementSet& set);
  void add_effect(const MeasurementSet& set, std::size_t tried);
  void add_view(const Imaging& imaging);

  std::vector<Parameter> list_;
  int shape_parameters_ = 0;
  std::vector<std::vector<int>> scale_of_;  ///< per instrument and section: index of its scale
  std::vector<ActiveEffect> declared_, tried_;
  std::vector<std::vector<int>> index_of_;  ///< of tried effect and parameter: which of the list, -1 if it is held
  int registration_ = -1, offset_ = -1;     ///< index of the first of six, of three
  MeasuredView nominal_;
};

/// The registration that lays predicted points over measured ones best (Kabsch 1976), without a tip offset.
MeasuredView registered(const MeasurementSet& set, const std::vector<PredictedShape>& shapes);

}  // namespace ostium::data
