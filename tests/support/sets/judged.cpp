#include "tests/support/sets/judged.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <set>

#include "data/identification/effects/effect_list.h"
#include "data/identification/forward/misfit.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/selection/explain.h"
#include "tests/support/sets/undeclared.h"

namespace ostium::synthetic {

namespace {

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

std::string joined(const std::vector<std::string>& ids) {
  std::vector<std::string> sorted = ids;
  std::sort(sorted.begin(), sorted.end());
  std::string out;
  for (const std::string& id : sorted) out += (out.empty() ? "" : "+") + id;
  return out;
}

/// Whether the two lists differ in one effect each, and some data cannot distinguish these two.
bool confusable(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::string> x, y;
  for (const std::string& id : a)
    if (std::find(b.begin(), b.end(), id) == b.end()) x.push_back(id);
  for (const std::string& id : b)
    if (std::find(a.begin(), a.end(), id) == a.end()) y.push_back(id);
  return x.size() == 1 && y.size() == 1 && data::often_confused(x[0], y[0]);
}

/// "unit_error x3", "explained, noise 2.1 x, 25 mm, heavy": what was said of data and noise besides.
std::string of_data(const data::Explanation& x) {
  std::string out;
  for (const data::DataFault& f : x.faults)
    for (const std::string& e : f.experiments) out += " " + e;
  if (x.noise.model)
    out += fmt::format(" [noise {:.1f} x, {:.0f} mm{}]", x.noise.model->sigma / x.declared_sigma_m.value_or(1),
                       1e3 * x.noise.model->length, x.noise.model->heavy() ? ", heavy" : "");
  return out;
}

/// Whether what is said of the noise is what was done to it.
bool noise_is_right(const data::Explanation& x, const std::string& kind) {
  const auto& m = x.noise.model;
  if (kind.empty()) return !m;
  if (!m) return false;
  if (kind == "noise:shared" || kind == "noise:smooth") return m->correlated();
  if (kind == "noise:twice") return std::fabs(m->sigma / *x.declared_sigma_m - 2) < 0.3;
  return m->heavy();
}

/// Whether one of the faults that were made is named with its culprits, and no other.
bool faults_are_right(const data::Explanation& x, const Undeclared& truth) {
  if (truth.faults.empty()) return x.faults.empty();
  if (x.faults.size() != 1) return false;
  const data::DataFault& f = x.faults[0];
  const std::set<std::string> said(f.experiments.begin(), f.experiments.end()),
      made(truth.culprits.begin(), truth.culprits.end());
  return said == made && std::find(truth.faults.begin(), truth.faults.end(), f.id) != truth.faults.end();
}

/// Compares a learned law with the truth.
void judge_law(const data::LearnedLaw& law, const std::function<double(double)>& truth, Judged& out) {
  std::vector<double> widths;
  for (std::size_t i = 0; i < law.sigma.size(); ++i) {
    ++out.law_points;
    if (!law.reached(i)) continue;
    const Eigen::Vector2d p = law.curve.points[i];
    ++out.law_reached, out.law_within += std::fabs(p.y() - truth(p.x())) < data::band_sigmas * law.sigma[i];
    widths.push_back(data::band_sigmas * law.sigma[i] / std::fabs(p.y()));
  }
  std::sort(widths.begin(), widths.end());
  if (!widths.empty()) out.law_half_width = widths[widths.size() / 2], out.law_widest = widths[widths.size() * 9 / 10];
}

/// Writes the set to files and reads it back, like a user's.
data::MeasurementSet as_read(const data::MeasurementSet& set, const std::string& kind, unsigned seed) {
  if (!set.vessel) return data::read_measurement("measurement.json", to_json(set));
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       fmt::format("ostium-{}-{}-{}", kind.substr(kind.find(':') + 1), seed, getpid());
  const data::MeasurementSet out = data::load_measurement(write_set(folder.string(), set));
  std::filesystem::remove_all(folder);
  return out;
}

}  // namespace

Judged judge(const std::string& kind, unsigned seed, int threads, const std::vector<std::string>& only) {
  const Undeclared truth = undeclared_set(kind, seed);
  const data::MeasurementSet set = as_read(truth.set, kind, seed);
  const double begin = cpu_seconds();
  data::ExplainOptions options;
  options.library = only.empty(), options.threads = threads;
  if (!only.empty()) options.tries = {only};
  const data::Explanation x = explain(set, options);

  Judged out;
  out.kind = kind, out.seed = seed;
  out.cpu_s = cpu_seconds() - begin;
  const double floor = data::noise_floor(set, *set.imaging.noise_sigma_m);
  out.size = std::sqrt(std::max(x.declared.rms_m * x.declared.rms_m - floor * floor, 0.0)) / floor;
  out.chi2_before = *x.declared.chi2_per_dof;
  const data::FittedModel& best =
      x.candidates.empty() || x.verdict == data::Verdict::explained ? x.declared : x.candidates.front();
  out.after = best.rms_held_out_m.value_or(best.rms_m) / floor;
  out.chi2_after = best.chi2_per_dof.value_or(0);
  out.said = to_string(x.verdict);
  const std::vector<std::string> added = x.adds_effects ? x.best().effects : std::vector<std::string>{};
  if (x.verdict == data::Verdict::effect || x.verdict == data::Verdict::mostly) {
    out.said = (x.verdict == data::Verdict::mostly ? "mostly " : "") + joined(x.effects());
    // Laws of another form than the library's are named, and something may be left.
    const bool whole = x.verdict == data::Verdict::effect || kind.starts_with("form:");
    out.right = truth.in_library && whole && joined(added) == joined(truth.effects);
  } else if (x.verdict == data::Verdict::ambiguous) {
    bool among = false, listed = true;
    out.said += ":";
    for (std::size_t i = 0; i < x.rivals; ++i) {
      out.said += (i ? " or " : " ") + joined(x.candidates[i].effects);
      among = among || joined(x.candidates[i].effects) == joined(truth.effects);
      listed = listed && (joined(x.candidates[i].effects) == joined(truth.effects) ||
                          confusable(x.candidates[i].effects, truth.effects));
    }
    out.right = truth.in_library && among && listed;
  } else if (x.verdict == data::Verdict::unexplained) {
    out.said += " (" + x.signature.frame + ")";
    out.right = !truth.in_library && x.signature.frame == truth.frame;
  } else {
    out.right = x.verdict == data::Verdict::explained && truth.in_library && truth.effects.empty();
  }
  out.right = out.right && noise_is_right(x, truth.noise) && faults_are_right(x, truth);
  out.said += of_data(x);
  if (truth.law && x.adds_effects && !best.laws.empty()) judge_law(best.laws[0], truth.law, out);
  if (out.right && x.verdict == data::Verdict::effect)
    for (const auto& [name, value] : truth.truth)
      for (const data::FittedParameter& p : best.parameters)
        if (p.parameter.name == name) ++out.parameters, out.within += std::fabs(p.value - value) < 3 * p.sigma;
  return out;
}

}  // namespace ostium::synthetic
