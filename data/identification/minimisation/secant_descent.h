#pragma once
/// Nonlinear least squares in which one evaluation is a whole contact history: expensive, and with kinks where a tip
/// begins to slide or a wall releases it. Derivatives are secants over the search radius rather than tangents: a linear
/// model through as many points as there are expensive ("dear") numbers, a trust region about the best point, and one
/// evaluation per step (derivative-free Gauss-Newton: Cartis, Roberts 2019, Math Program Comput 11:631).
#include "data/identification/minimisation/least_squares.h"

namespace ostium::data {

struct SecantDescent {
  LeastSquares problem;   ///< its `evaluate` is never asked for a Jacobian
  int dear = 0;           ///< this many leading numbers cost an evaluation each time they change; the others are free
  Eigen::VectorXd scale;  ///< typical large change of each number
  double first_radius = 0.3;  ///< of the trust region, in units of scale
  double last_radius = 0.03;
  double first_step = 0.1;    ///< distance of the first points from the start, in units of scale
  double least_gain = 0.01;   ///< in half the sum of squares; a step that gains less is not taken
  int most_evaluations = 60;  ///< number of points that differ in the dear numbers
};

/// `iterations` of the result counts these evaluations.
LeastSquaresResult minimise(const SecantDescent& descent);

}  // namespace ostium::data
