#include "data/identification/selection/verdict_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/units.h"
#include "data/identification/residuals/noise_model.h"
#include "data/identification/selection/evidence.h"

namespace ostium::data {

namespace {

using units::mm;

/// A misfit in the unit that people see.
std::string with_unit(double misfit, const MisfitUnit& unit) {
  return fmt::format("{:.3g} {}", misfit / unit.size, unit.name);
}

std::string held_out(const FittedModel& m, const MisfitUnit& unit) {
  return m.rms_held_out_m ? with_unit(*m.rms_held_out_m, unit) + " on held-out experiments"
                          : "not scored on held-out experiments";
}

/// " The noise is not as declared: ..." or nothing.
std::string of_other_noise(const Explanation& x) {
  if (!x.noise.model) return "";
  const std::string words = in_words(*x.noise.model, x.declared_sigma_m, mm, "mm");
  return fmt::format(" The noise is not {}: it is {}.", x.declared_sigma_m ? "as declared" : "independent and normal",
                     words);
}

/// "removes 97 % of what is beyond noise", or nothing where there is nothing beyond it.
std::string removal(const Explanation& x, const FittedModel& m) {
  const auto share = x.noise.sigma_m ? share_removed(misfit_of(x.declared), misfit_of(m)) : std::nullopt;
  return share ? fmt::format("removes {:.3g} % of what is beyond noise and leaves {:.2f} times the noise", 100 * *share,
                             rms_over_noise(misfit_of(m)))
               : "";
}

std::string of_verdict(const Explanation& x) {
  switch (x.verdict) {
    case Verdict::explained:
      return "What is declared explains the measurements: what the fit leaves is noise.";
    case Verdict::mostly:
      return fmt::format("{} is missing from what is declared: it {}. The rest is more than noise, and is described.",
                         x.candidates.front().name, removal(x, x.candidates.front()));
    case Verdict::cannot_be_judged:
      return "This cannot be judged: what the fit of the declared model leaves shows no pattern, but without a known "
             "noise nothing says whether it is noise.";
    case Verdict::effect:
      return fmt::format(
          "What is declared does not explain the measurements; with {} it does better on data it has not seen{}.",
          x.candidates.front().name,
          x.noise.sigma_m ? ", and what is left is noise"
                          : ". The noise is unknown, so this rests on "
                            "held-out error and BIC alone");
    case Verdict::ambiguous: {
      std::string list;
      for (std::size_t i = 0; i < x.rivals; ++i)
        list += (i == 0 ? "" : i + 1 < x.rivals ? ", " : " or ") + x.candidates[i].name;
      return x.rivals > 1 ? "These measurements cannot tell what is missing: " + list + " explain them equally."
                          : "These measurements are too few to tell.";
    }
    default:
      return x.candidates.empty() ? "What is declared does not explain the measurements."
                                  : "Neither what is declared nor what was tried explains the measurements.";
  }
}

/// Radii as relative errors of curvature, as is usual in tube bending; empty if not all are radii.
std::string in_curvature(const MeasurementSet& set, const std::vector<Eigen::VectorXd>& misfits) {
  double sum = 0;
  for (std::size_t e = 0; e < misfits.size(); ++e) {
    if (set.experiments[e].kind != Experiment::Kind::radius) return "";
    const double measured = set.experiments[e].radius_m, off = measured / (measured - misfits[e][0]) - 1;
    sum += off * off;
  }
  return misfits.empty() ? "" : fmt::format("{:.1f} %", 100 * std::sqrt(sum / static_cast<double>(misfits.size())));
}

void of_pushes(const Explanation& x, std::vector<std::string>& out) {
  if (!x.declared.push_rms_N) return;
  constexpr double mN = 1e-3;
  const auto of = [](const FittedModel& m) {
    return fmt::format("{}, {:.3g} mN{}", m.name, *m.push_rms_N / mN,
                       m.push_rms_held_out_N ? fmt::format(" ({:.3g} held out)", *m.push_rms_held_out_N / mN) : "");
  };
  std::string words = "Push at the base, off by: " + of(x.declared);
  for (const FittedModel& c : x.candidates) words += "; " + of(c);
  out.push_back(words + ". It is taken to be known to a tenth of what was measured.");
}

void of_curvature(const MeasurementSet& set, const Explanation& x, std::vector<std::string>& out) {
  const std::string nominal = in_curvature(set, x.nominal_misfits);
  if (nominal.empty()) return;
  std::string words = "In curvature: nothing fitted " + nominal;
  const auto add = [&](const FittedModel& m) {
    words += "; " + m.name + ", fitted, " + in_curvature(set, m.misfits);
    if (!m.held_out_misfits.empty()) words += " (" + in_curvature(set, m.held_out_misfits) + " held out)";
  };
  add(x.declared);
  for (const FittedModel& c : x.candidates) add(c);
  out.push_back(words + ".");
}

void of_noise(const Explanation& x, std::vector<std::string>& out) {
  if (!x.noise.sigma_m) {
    out.push_back(
        "The noise is neither declared nor can it be told from repeats or from point to point; standard errors "
        "take what the fit leaves for noise.");
    return;
  }
  const std::string from = x.noise.declared ? "declared" : "estimated from the " + x.noise.from;
  out.push_back(fmt::format("Noise {} per coordinate, {}; chi-square per degree of freedom {:.3g} over {:.0f} degrees.",
                            with_unit(*x.noise.sigma_m, x.unit), from, *x.declared.chi2_per_dof,
                            x.declared.degrees_of_freedom) +
                of_other_noise(x));
}

void of_parameters(const MeasurementSet& set, const FittedModel& m, std::vector<std::string>& out) {
  bool loaded = false;
  for (const Experiment& e : set.experiments) loaded = loaded || !e.tip_force_N.isZero();
  bool stiffness_open = false, at_edge = false;
  for (const FittedParameter& p : m.parameters) {
    const bool stiffness = p.parameter.name.starts_with("EI_scale");
    stiffness_open = stiffness_open || (stiffness && p.informed < 0.5);
    const double range = p.parameter.most - p.parameter.least;
    at_edge = p.value < p.parameter.least + 1e-6 * range || p.value > p.parameter.most - 1e-6 * range;
    if (at_edge && p.informed > 0.01)  // a parameter on which there are no data stays at its start
      out.push_back(fmt::format("{} ended at the edge of its range, {:.3g}: it stands in for something else.",
                                p.parameter.label, p.value));
  }
  if (stiffness_open && set.gravity_m_s2.isZero() && !loaded)
    out.push_back(
        "Nothing loads the instruments, so stiffness shows at most as a ratio between them; what the data leave "
        "open is the declared value.");
  else if (!loaded && !m.push_rms_N && !set.gravity_m_s2.isZero() && set.instruments.size() == 1)
    out.push_back(
        "Without known tip loads only EI over weight was found: a wrong weight would be taken for stiffness.");
}

void of_residual(const FittedModel& m, std::vector<std::string>& out) {
  if (m.correlation && m.correlation->standard_errors > 4)
    out.push_back(
        fmt::format("Neighbouring points are off alike (correlation {:.2f}, {:.0f} standard errors): a shape, not "
                    "noise.",
                    m.correlation->value, m.correlation->standard_errors));
  int told = 0;
  for (const ResidualTest& d : m.residual_tests.list) {
    if (!d.significant || ++told > 3) continue;
    const bool common = d.on.starts_with("common");
    out.push_back(common ? fmt::format("{:.0f} % of the residual is {}.", 100 * d.share, d.on)
                         : fmt::format("{:.0f} % of the residual's scatter goes with {}.", 100 * d.share, d.on));
  }
  static const std::vector<std::pair<std::string, std::string>> meanings = {
      {"material", "What is left turns with the roll: it is in the instrument, not in the room."},
      {"lab",
       "What is left stays where it is whatever the roll: it is in the room, as a load, a weight or a frame is."},
      {"time", "What is left changes with time."},
      {"image", "What is left goes with the place alone, as a scale or distortion of the picture would."}};
  for (const auto& [frame, words] : meanings)
    if (m.residual_tests.signature.frame == frame) out.push_back(words);
  if (told == 0) out.push_back("The residual goes with nothing that was varied.");
}

/// Of the first candidate that has laws, whether it won or not.
void of_laws(const Explanation& x, std::vector<std::string>& out) {
  const auto c =
      std::find_if(x.candidates.begin(), x.candidates.end(), [](const FittedModel& m) { return !m.laws.empty(); });
  if (c == x.candidates.end()) return;
  for (const LearnedLaw& law : c->laws) out.push_back("Learned " + in_words(law));
}

}  // namespace

std::string remaining_text(const Explanation& x, const std::vector<ResidualAttribution>& fields,
                           const Remaining& left) {
  std::string out = fmt::format("Left beyond noise: {:.2g} %, {:.2f} times the noise.", 100 * left.share,
                                rms_over_noise(misfit_of(x.best())));
  if (fields.empty()) return out;
  if (left.signature.frame == "none") return out + " No field without a hypothesis removes a part of it.";
  const ResidualAttribution& field = fields.front();
  out += fmt::format(" {} would remove {:.0f} % of that, with {:.0f} numbers", field.what, 100 * field.removed,
                     field.numbers_used);
  if (left.signature.from_tip_m)
    out += fmt::format(", {:.0f} to {:.0f} mm from the tip", left.signature.from_tip_m->x() / mm,
                       left.signature.from_tip_m->y() / mm);
  return out + ".";
}

void warn_of_scales(const FittedModel& model, std::vector<std::string>& warnings) {
  constexpr double far = 3;
  for (const FittedParameter& p : model.parameters) {
    if (!p.parameter.name.starts_with("EI_scale")) continue;
    const double deviations = std::fabs(std::log(p.value / p.parameter.start)) / p.parameter.spread;
    if (deviations > far)
      warnings.push_back(
          fmt::format("Suspicious: {} is {:.2g} times what is declared, {:.1f} standard deviations from it. A section "
                      "that ends elsewhere than declared, or a wrong number, looks like this.",
                      p.parameter.label, p.value, deviations));
  }
  if (const std::string doubt = doubt_of_noise(model.chi2_per_dof.value_or(1), model.degrees_of_freedom);
      !doubt.empty())
    warnings.push_back(doubt);
}

void add_faults(const std::vector<DataFault>& faults, Explanation& x) {
  if (faults.empty()) return;
  std::string words;
  for (const DataFault& f : faults) words += fmt::format("{}: {}; {} ({}). ", f.id, f.what, f.mend, f.told_by);
  x.faults.insert(x.faults.begin(), faults.begin(), faults.end());
  x.verdict_text.front() = words + "The rest: " + x.verdict_text.front();
  if (x.verdict == Verdict::explained) x.verdict = Verdict::effect;
}

std::vector<std::string> verdict_text(const MeasurementSet& set, const Explanation& x) {
  std::vector<std::string> out = {of_verdict(x)};
  if (x.ended_early) out.emplace_back(ended_early_words);
  out.push_back(fmt::format("{}: {}. Declared model, fitted: {}, {}.",
                            set.imaging.registration_free ? "Nothing fitted but the measuring frame" : "Nothing fitted",
                            with_unit(x.rms_nominal_m, x.unit), with_unit(x.declared.rms_m, x.unit),
                            held_out(x.declared, x.unit)));
  for (const FittedModel& c : x.candidates) {
    const std::string removed = removal(x, c);
    out.push_back(fmt::format("With {}: {}, {}; BIC changes by {:+.1f}{}.", c.name, with_unit(c.rms_m, x.unit),
                              held_out(c, x.unit), c.bic - x.declared.bic, removed.empty() ? "" : "; it " + removed));
  }
  of_laws(x, out);
  if (x.remaining) out.push_back(x.remaining->text);
  out.insert(out.end(), x.warnings.begin(), x.warnings.end());
  of_pushes(x, out);
  of_curvature(set, x, out);
  of_noise(x, out);
  of_parameters(set, x.best(), out);
  of_residual(x.best(), out);
  for (const ResidualAttribution& t : x.attributions)
    if (t.removed >= part_of_it && t.log_evidence > convincing_log_evidence(x.attributions))
      out.push_back(
          fmt::format("Without a hypothesis: {} would remove {:.0f} % of what is not noise, with {:.0f} numbers; "
                      "log evidence {:+.0f}.",
                      t.what, 100 * t.removed, t.numbers_used, t.log_evidence));
  if (!x.attributions.empty() && x.signature.frame != "none" && x.signature.from_tip_m)
    out.push_back(fmt::format("It would sit {:.0f} to {:.0f} mm from the tip.", x.signature.from_tip_m->x() / mm,
                              x.signature.from_tip_m->y() / mm));
  if (x.next_experiment) out.push_back("Measure next: " + x.next_experiment->why + ".");
  if (!x.best().converged)
    out.push_back("The fit ran out of iterations before it settled: take its numbers with care.");
  for (const std::string& id : x.best().other_branches)
    out.push_back(fmt::format("{} has more than one stable shape near the fitted values.", id));
  return out;
}

}  // namespace ostium::data
