#include "app/session/run/play.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace ostium::app {

namespace {

using Clock = std::chrono::steady_clock;

/// How far the simulation may fall behind the clock: more than the demanding half of a beat costs, which the easy half
/// makes up for. Any further delay is dropped. Catching up runs at most at twice real time.
constexpr auto most_behind = std::chrono::milliseconds(500);
constexpr int most_haste = 2;

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

double thread_cpu_s() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Histogram of step times with bins of 1 %, from 1 us to 20 s: gives percentiles without storing every value.
class TimeBins {
 public:
  TimeBins() : bins_(count, 0) {}
  void add(double s) {
    ++bins_[static_cast<std::size_t>(std::clamp(std::log(s / least_s) / step, 0.0, count - 1.0))];
    ++all_;
    sum_ += s, most_ = std::max(most_, s);
  }
  double percentile_ms(double share) const {
    long left = static_cast<long>(share * static_cast<double>(all_));
    for (int b = 0; b < count; ++b)
      if ((left -= bins_[static_cast<std::size_t>(b)]) < 0) return 1e3 * least_s * std::exp((b + 0.5) * step);
    return 1e3 * most_;
  }
  double most_ms() const { return 1e3 * most_; }
  double mean_ms() const { return all_ ? 1e3 * sum_ / static_cast<double>(all_) : 0; }

 private:
  static constexpr double least_s = 1e-6, step = 0.01;
  static constexpr int count = 1700;
  std::vector<long> bins_;
  long all_ = 0;
  double sum_ = 0, most_ = 0;
};

/// Has the depth judged independently where contact says that it is deep. Contact's planes reach beyond their
/// triangles, so what they say is an upper bound, and one false alarm must not hide what follows: each second counts
/// anew.
class DepthJudge {
 public:
  void look(double deep_m, const SessionModel& model, const SessionState& state) {
    const std::uint64_t second = state.rods.step / 1000;
    if (second != second_) second_ = second, deepest_here_m_ = least_m;
    if (deep_m < 1.5 * deepest_here_m_ || deep_m < found_.deepest_m + least_m) return;
    deepest_here_m_ = deep_m;
    add(penetration(model, state), found_);
  }
  const Penetration& found() const { return found_; }

 private:
  static constexpr double least_m = 10e-6;
  std::uint64_t second_ = 0;
  double deepest_here_m_ = least_m;
  Penetration found_;
};

}  // namespace

PlayReport play(ScriptedRun& run, const RunSetup& setup, const PlayOptions& options) {
  Recorder recorder(options.recorder, run.model, setup, save(run.hands).size());
  if (!options.recorder.continues) recorder.begin(run.state, run.hands);
  if (options.begun) options.begun();
  TimeBins bins;
  PlayReport out;
  DepthJudge judge;
  const auto begin = Clock::now();
  const bool by_hand = run.plan.script.by_hand;
  std::string aborted;
  const auto step_length =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(run.model.step_s()));
  auto due = begin;
  while (true) {
    const auto now = Clock::now();
    const double cpu = thread_cpu_s();
    if (options.stop && options.stop->load(std::memory_order_relaxed))
      aborted = by_hand ? "by the operator" : "ended by the operator";
    if (options.seconds > 0 && seconds(run.model, run.state) >= options.seconds - 1e-9) aborted = "time limit";
    if (options.give_up_s > 0 && seconds_between(begin, now) > options.give_up_s) aborted = "gave up waiting";
    if (!aborted.empty() || !run.tick()) break;
    recorder.add(run.inputs, run.state, run.report, run.hands, run.events);
    bins.add(thread_cpu_s() - cpu);
    const double deep_m = run.report.rods.deepest_m;
    if (deep_m > out.deepest_m) out.deepest_m = deep_m, out.deepest_s = seconds(run.model, run.state);
    if (!options.real && options.recorder.penetration) judge.look(deep_m, run.model, run.state);
    if (options.progress && run.state.rods.step % 100 == 0) options.progress(run);
    if (options.real) {
      if (now - due > step_length) ++run.overruns;
      out.times.behind_most_ms = std::max(out.times.behind_most_ms, 1e3 * seconds_between(due, now));
      if (now - due > most_behind) due = now;
      due = run.stood ? Clock::now() : due + step_length;
      std::this_thread::sleep_until(std::max(due, now + step_length / most_haste));
    }
  }
  out.clock_s = seconds_between(begin, Clock::now());
  if (aborted.empty()) recorder.end(run.state, run.events);
  recorder.stop();
  out.simulated_s = seconds(run.model, run.state);
  out.outcome = words_for(aborted.empty() ? run.outcome : by_hand ? Outcome::ended : Outcome::aborted);
  out.reason = aborted.empty() ? reason(run) : by_hand ? aborted : aborted + ", in " + reason(run);
  if (const std::string tips = where_tips_lie(run.model, run.state, run.report); !out.reason.empty() && !tips.empty())
    out.reason += " (" + tips + ")";
  out.times.p50_ms = bins.percentile_ms(0.5), out.times.p99_ms = bins.percentile_ms(0.99);
  out.times.p999_ms = bins.percentile_ms(0.999);
  out.times.overruns = run.overruns;
  out.times.most_ms = bins.most_ms(), out.times.mean_ms = bins.mean_ms();
  data::RunRecord record = recorder.record();
  if (!run.xrays.poses().empty()) {
    const auto own = options.dosimeter ? nullptr : std::make_unique<const Dosimeter>(*run.model.vessel);
    (own ? *own : *options.dosimeter).measure(run.xrays, record);
  }
  out.metrics = metrics_of(record);
  out.penetration = recorder.penetration();
  add(judge.found(), out.penetration);
  // The judge looks at the wall where it came to lie, contact's planes at where it met it.
  if (out.penetration.deepest_m > out.deepest_m)
    out.deepest_m = out.penetration.deepest_m, out.deepest_s = out.penetration.deepest_s;
  out.waits = recorder.waits();
  out.hash = hash(run.state);
  out.problem = recorder.problem();
  try {
    recorder.finish(metrics_json(setup.vessel, setup.seed, out.outcome, out.reason, out.metrics));
  } catch (const std::runtime_error& error) {
    out.problem = error.what();
  }
  return out;
}

}  // namespace ostium::app
