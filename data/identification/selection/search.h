#pragma once
/// Searches all available effects for those that a set shows: singly, then in combination.
#include <atomic>
#include <deque>

#include "data/identification/estimation/model_fit.h"
#include "data/identification/selection/evidence.h"

namespace ostium::data {

class EffectSearch {
 public:
  /// `workers` may throw Ended: then what was being fitted is left as it was, and nothing more is.
  EffectSearch(const MeasurementSet& set, const Workers& workers,
               const std::function<void(const std::string&)>& progress)
      : set_(set), workers_(workers), progress_(progress) {}

  /// Models with effects, best first, finalists scored on held-out data (in a vessel those not far behind). Refines
  /// `noise` if it was estimated; replaces it where what the best models leave goes with nothing that was varied and
  /// yet is no noise as declared. `most_effects`: in a model, where the noise is known.
  std::vector<FittedModel> run(const ModelFit& declared, FittedModel& of_declared, Noise& noise,
                               std::size_t most_effects = 3);
  bool ended() const { return ended_; }

 private:
  struct Tried {
    FittedModel model;
    ModelFit* study = nullptr;
    std::vector<ActiveEffect> effects;
    bool fitted = false, complete = false;
  };
  /// At rest the shapes of one model are found side by side; in a vessel its histories come one after the other, and
  /// models side by side.
  void for_each(std::size_t count, const std::function<void(std::size_t)>& model) const;
  /// Fits and judges those models that were not tried before.
  void add(const std::vector<std::vector<ActiveEffect>>& models, const FittedModel& near, const Noise& noise);
  double cost_ahead_of(const std::vector<ActiveEffect>& effects, const FittedModel& near, const Noise& noise);
  /// Adds the most promising effects to `base`; nullptr: fits every single effect.
  void add_to(const Tried* base, const FittedModel& near, const Noise& noise);
  void add_laws(const Tried* library, const FittedModel& near, const Noise& noise);
  void sort_by_bic();
  /// Whether the model may be complete: only noise is left, and no parameter is at the edge of its range.
  bool fits(const FittedModel& model, const Noise& noise) const;
  bool is_worth_folds(const Tried& tried) const;
  /// Fits to the end and scores on held-out data; nothing for models in a vessel that are far behind the best.
  void complete(Tried& tried, const Noise& noise);
  void judge_again(const ModelFit& declared, FittedModel& of_declared, Noise& noise);
  void prune(const Noise& noise);
  void grow_to_noise(const ModelFit& declared, FittedModel& of_declared, Noise& noise, std::size_t most_effects);
  /// The noise of the model of most evidence, each with its own noise, if that has no pattern; if it is not as
  /// declared, all are judged by it.
  void adopt_noise(const ModelFit& declared, FittedModel& of_declared, Noise& noise);
  void judge_all(const ModelFit& declared, FittedModel& of_declared, const Noise& noise);
  void grow_by_held_out(const FittedModel& of_declared, const Noise& noise);

  const MeasurementSet& set_;
  const Workers& workers_;
  std::function<void(const std::string&)> progress_;
  std::atomic<bool> ended_ = false;
  std::deque<ModelFit> fits_;
  std::deque<Tried> tried_;
};

}  // namespace ostium::data
