/// Scores a model on experiments that its fit did not use.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "data/identification/estimation/folds.h"
#include "data/identification/estimation/measured_push.h"
#include "data/identification/estimation/model_fit.h"
#include "data/identification/forward/misfit.h"

namespace ostium::data {

void ModelFit::score_held_out(FitOptions options, FittedModel& model) const {
  const auto folds = folds_of(set_);
  if (folds.empty()) return;
  options.descents = 1, options.only_x = set_.vessel.has_value();
  std::vector<Eigen::VectorXd> out(all_.size());
  std::vector<PredictedShape> shapes(all_.size());
  for (std::size_t f = 0; f < folds.size(); ++f) {
    say(fmt::format("fold {} of {}", f + 1, folds.size()));
    options.experiments.clear();
    for (int e : all_)
      if (std::find(folds[f].begin(), folds[f].end(), e) == folds[f].end()) options.experiments.push_back(e);
    options.starts = {parameters_.start(), fit_.x};
    Eigen::VectorXd x;
    try {
      x = fit(*forward_, parameters_, options).x;
    } catch (const std::runtime_error&) {
      return;  // no shape at this fold's result
    }
    const std::vector<Eigen::VectorXd> off = misfits(*forward_, parameters_, x, folds[f]);
    const std::vector<PredictedShape> seen = forward_->shapes({parameters_.changes(x)}, folds[f])[0];
    for (std::size_t k = 0; k < off.size(); ++k) {
      if (off[k].size() == 0) return;
      out[folds[f][k]] = off[k], shapes[folds[f][k]] = seen[k];
    }
  }
  model.held_out_misfits = out;
  model.rms_held_out_m = rms(set_, out);
  if (push_sigma_N(set_)) model.push_rms_held_out_N = push_rms_N(set_, shapes);
}

}  // namespace ostium::data
