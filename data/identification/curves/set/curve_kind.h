#pragma once
/// A kind of measurement: its runs, what a declared fit may change, its effects, and its forward model.
///
/// To write a kind: a struct `Setup` with every number that an effect may change, a forward model from it to curves,
/// and effects that change it (`EffectOn<Setup>`, a file each); `SetOf<Setup>` does the rest.
#include <functional>
#include <memory>
#include <span>

#include "data/identification/curves/set/curve_noise.h"
#include "data/identification/effects/effect.h"

namespace ostium::data {
class JsonObject;
}

namespace ostium::data::curves {

/// What a person reads of an effect, and what a fit needs to know of it.
struct EffectHead {
  std::string id;
  std::string form;  ///< "" if the effect has only one; effects of one id have different forms
  std::string what;  ///< phrase that follows "with"
  std::vector<EffectParameter> parameters;
  std::string confused_with;  ///< id of an effect that some data cannot distinguish from this one; "" if none
  /// A law that is learned: its curve, from its values and the numbers that are free in what is declared. Null: it is
  /// none.
  LawCurve (*law)(const std::vector<double>& values, std::span<const double> free) = nullptr;
  bool of_data = false;  ///< a mistake in some of the runs: the others, fitted alone, cannot tell of it

  std::string name() const { return form.empty() ? id : id + " (" + form + ")"; }
};

/// An effect that is switched on, with its numbers.
struct Switched {
  std::size_t effect = 0;  ///< in `Set::effects()`
  std::vector<double> values;
};

/// What a law says of every run.
struct Foretold {
  Foretold(std::vector<Curves> of_runs) : curves(std::move(of_runs)) {}  // most laws leave nothing open
  std::vector<Curves> curves;
  /// Standard deviations, in the unit of each channel, of what the law leaves open beside the noise, such as when a
  /// wire slips; one for each number of `curves`, or empty: nothing is left open.
  std::vector<Curves> open;
};

/// A measured set of one kind.
class Set {
 public:
  virtual ~Set() = default;
  const std::vector<Run>& runs() const { return runs_; }
  const std::vector<EffectParameter>& free() const { return free_; }  ///< what a declared fit may change
  const std::vector<EffectHead>& effects() const { return heads_; }   ///< those that can show in this set
  const std::vector<Switched>& declared() const { return declared_; }
  const Noise& noise() const { return noise_; }  ///< as declared
  /// The curves of every run, with the numbers in `free` and the effects that are declared or switched on.
  std::vector<Curves> predict(std::span<const double> free, std::span<const Switched> on) const {
    return foretell(free, on).curves;
  }
  /// The same, and what the law leaves open.
  virtual Foretold foretell(std::span<const double> free, std::span<const Switched> on) const = 0;

  std::string file, kind, title, source;
  /// What is held out to score a model: whole runs, or channels where each run has numbers of its own to fit.
  bool hold_out_channels = false;

 protected:
  friend void declare(const JsonObject& root, Set& set);
  std::vector<Run> runs_;
  std::vector<EffectParameter> free_;
  std::vector<EffectHead> heads_;
  std::vector<Switched> declared_;
  Noise noise_;
};

/// An effect on a kind's setup.
template <class Setup>
struct EffectOn {
  EffectHead head;
  void (*apply)(const std::vector<double>& values, Setup& setup);
  /// Empty if it can show in what is declared, else why not; null: it always can.
  std::string (*why_not)(const Setup& declared) = nullptr;
  /// Adapts priors and ranges to what is declared; null: they are as listed.
  void (*adapt)(const Setup& declared, std::vector<EffectParameter>& parameters) = nullptr;
};

template <class Setup>
class SetOf : public Set {
 public:
  using Law = std::function<Foretold(const Setup& setup)>;
  using Free = void (*)(std::span<const double> free, Setup& setup);

  // Both are moved below.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  SetOf(Setup setup, std::vector<Run> runs, std::vector<EffectParameter> free, Free set_free, Law law,
        const std::vector<EffectOn<Setup>>& effects)
      : setup_(std::move(setup)), set_free_(set_free), law_(std::move(law)) {
    runs_ = std::move(runs), free_ = std::move(free);
    noise_ = declared_noise(runs_);
    for (const EffectOn<Setup>& e : effects) {
      if (e.why_not && !e.why_not(setup_).empty()) continue;
      effects_.push_back(e);
      if (e.adapt) e.adapt(setup_, effects_.back().head.parameters);
      heads_.push_back(effects_.back().head);
    }
  }
  const Setup& setup() const { return setup_; }

  Foretold foretell(std::span<const double> free, std::span<const Switched> on) const override {
    Setup setup = setup_;
    set_free_(free, setup);
    for (const Switched& s : declared_) effects_[s.effect].apply(s.values, setup);
    for (const Switched& s : on) effects_[s.effect].apply(s.values, setup);
    return law_(setup);
  }

 private:
  Setup setup_;
  Free set_free_;
  Law law_;
  std::vector<EffectOn<Setup>> effects_;
};

}  // namespace ostium::data::curves
