#include "app/commands/run/report.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/session/model/outcome.h"
#include "data/formats/paths.h"

namespace ostium::app {

nlohmann::ordered_json to_json(const BoxDriver& hand) {
  const device::BoxSnapshot& now = hand.now();
  return {{"stood", hand.stood()},  {"openings", now.openings},          {"reports", now.reports}, {"lost", now.lost},
          {"ignored", now.ignored}, {"departures", now.port.departures}, {"advice", advice(now)}};
}

nlohmann::ordered_json to_json(const RunSetup& setup, const ScriptedRun& run, const PlayReport& r,
                               const std::string& file) {
  nlohmann::ordered_json out = {{"case", setup.vessel},
                                {"script", setup.script.name},
                                {"seed", setup.seed},
                                {"outcome", r.outcome},
                                {"reason", r.reason},
                                {"simulated_s", r.simulated_s},
                                {"clock_s", r.clock_s},
                                {"deepest_penetration_mm", 1e3 * r.penetration.deepest_m},
                                {"deepest_of_all_steps_mm", 1e3 * r.deepest_m},
                                {"deepest_at_s", r.deepest_s},
                                {"nodes_outside", r.penetration.outside},
                                {"step_ms",
                                 {{"mean", r.times.mean_ms},
                                  {"p50", r.times.p50_ms},
                                  {"p99", r.times.p99_ms},
                                  {"p999", r.times.p999_ms},
                                  {"most", r.times.most_ms}}},
                                {"overruns", r.times.overruns},
                                {"behind_most_ms", r.times.behind_most_ms},
                                {"troubled_steps", run.troubled},
                                {"trouble", trouble_words(run.troubles)},
                                {"hash", fmt::format("{:016x}", r.hash)},
                                {"recording", file},
                                {"recording_problem", r.problem}};
  out["metrics"] =
      nlohmann::ordered_json::parse(metrics_json(setup.vessel, setup.seed, r.outcome, r.reason, r.metrics))["metrics"];
  return out;
}

void print_report(const ScriptedRun& run, const PlayReport& r, const std::string& file) {
  fmt::print("{}{}{}\n", r.outcome, r.reason.empty() ? "" : ": ", r.reason);
  fmt::print("{:.3f} s simulated in {:.1f} s; deepest in the wall {:.3f} mm, {} nodes found outside\n", r.simulated_s,
             r.clock_s, 1e3 * r.penetration.deepest_m, r.penetration.outside);
  fmt::print("(judged once a second and where it may be deep; in no step more than {:.3f} mm, at {:.3f} s)\n",
             1e3 * r.deepest_m, r.deepest_s);
  fmt::print("step {:.2f} ms of CPU, p50 {:.2f}, p99 {:.2f}, p99.9 {:.2f}, most {:.1f}\n", r.times.mean_ms,
             r.times.p50_ms, r.times.p99_ms, r.times.p999_ms, r.times.most_ms);
  if (r.times.behind_most_ms > 0)
    fmt::print("{} steps began over a millisecond late, at most {:.1f} ms\n", r.times.overruns, r.times.behind_most_ms);
  if (const std::string patient = run.model.has_patient() ? patient_words(run.state) : ""; !patient.empty())
    fmt::print("patient: {}\n", patient);
  if (run.troubled) fmt::print("{} steps had to give way: {}\n", run.troubled, trouble_words(run.troubles));
  for (const data::Metric& m : r.metrics)
    if (const std::string value = value_text(m); !value.empty()) fmt::print("  {:<32} {}\n", m.name, value);
  // Somebody may have taken it away meanwhile.
  const bool there = !file.empty() && data::is_there(file);
  const char* kept = !there ? "" : r.problem.empty() ? ", recorded in " : ", recorded in part in ";
  fmt::print("state {:016x}{}{}\n", r.hash, kept, there ? file : "");
}

void print_report(const BoxDriver& hand) {
  const device::BoxSnapshot& now = hand.now();
  fmt::print("at the box: {} reports, {} lost, {} ignored; stood {} times at an end of the travel\n", now.reports,
             now.lost, now.ignored, hand.stood());
}

}  // namespace ostium::app
