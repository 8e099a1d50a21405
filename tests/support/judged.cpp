#include "tests/support/judged.h"

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
#include "tests/support/undeclared.h"

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

Judged judge(const std::string& kind, unsigned seed, int threads) {
  const Undeclared truth = undeclared_set(kind, seed);
  const data::MeasurementSet set = as_read(truth.set, kind, seed);
  const double begin = cpu_seconds();
  data::ExplainOptions options;
  options.library = true, options.threads = threads;
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
  if (x.verdict == data::Verdict::effect) {
    out.said = joined(x.best().effects);
    out.right = truth.in_library && out.said == joined(truth.effects);
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
  if (out.right && x.verdict == data::Verdict::effect)
    for (const auto& [name, value] : truth.truth)
      for (const data::FittedParameter& p : best.parameters)
        if (p.parameter.name == name) ++out.parameters, out.within += std::fabs(p.value - value) < 3 * p.sigma;
  return out;
}

}  // namespace ostium::synthetic
