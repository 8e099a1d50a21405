#pragma once
/// Nonlinear least squares where one evaluation is a whole history of contact: dear, and with kinks where a tip begins
/// to slide or a wall lets go. Derivatives are secants over as far as the search looks, not tangents at a point: a
/// linear model through as many points as there are dear numbers, a trust region about the best of them, and one
/// evaluation a step (derivative-free Gauss-Newton: Cartis, Roberts 2019, Math Program Comput 11:631).
#include "data/identification/estimation/least_squares.h"

namespace ostium::data {

struct SecantDescent {
  LeastSquares problem;       ///< its `evaluate` is never asked for a Jacobian
  int dear = 0;               ///< the first so many numbers cost an evaluation; the others are free to move
  Eigen::VectorXd scale;      ///< of all numbers: what is far for each
  double first_radius = 0.3;  ///< of the trust region, in scales
  double last_radius = 0.03;
  double first_step = 0.1;    ///< to the first points about the start, in scales
  double least_gain = 0.01;   ///< of half the sum of squares: less is not worth a step
  int most_evaluations = 60;  ///< at places that differ in the dear numbers
};

/// `iterations` of the result are such evaluations.
LeastSquaresResult minimise(const SecantDescent& descent);

}  // namespace ostium::data
