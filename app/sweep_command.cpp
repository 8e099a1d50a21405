#include "app/sweep_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <thread>

#include "app/session/play.h"
#include "data/formats/load_error.h"

namespace ostium {

namespace {

namespace fs = std::filesystem;

std::atomic<bool> interrupted{false};

void say(const std::string& what) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "{:<78}\r", what);
}

struct Task {
  std::size_t vessel = 0;           ///< of those that are made
  std::vector<std::string> values;  ///< of the varied keys
  std::uint64_t seed = 0;
  RunSetup setup;  ///< without mesh
};

/// A sweep as it was asked for: runs in the order of the table.
struct Sweep {
  std::vector<std::string> keys;
  std::vector<RunSetup> vessels;  ///< one for each vessel that has to be made
  std::vector<Task> tasks;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts{""};
  for (char c : text)
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::pair<std::uint64_t, std::uint64_t> seeds_of(const std::string& text) {
  unsigned long long from = 0, to = 0;
  char rest;
  const int read = std::sscanf(text.c_str(), "%llu..%llu%c", &from, &to, &rest);
  if (text.find_first_not_of("0123456789.") != std::string::npos ||
      (read != 2 && text.find('.') != std::string::npos) || read < 1 || (read == 2 && to < from))
    throw LoadError(fmt::format("--seeds is \"{}\"; expected FROM..TO", text));
  return {from, read == 2 ? to : from};
}

Sweep plan(const SweepOptions& o) {
  Sweep sweep;
  std::vector<std::vector<std::string>> values;
  for (const std::string& vary : o.vary) {
    const std::size_t equals = vary.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == vary.size())
      throw LoadError(fmt::format("--vary {}: expected KEY=A,B,C", vary));
    sweep.keys.push_back(vary.substr(0, equals));
    values.push_back(split(vary.substr(equals + 1), ','));
  }
  const auto [first, last] = seeds_of(o.seeds);
  std::map<std::pair<std::string, std::string>, std::size_t> made;  // by vessel and person
  for (const std::string& vessel : o.vessels) {
    RunOptions run = o.run;
    run.vessel = vessel;
    const RunSetup base = setup_of(run);
    std::vector<std::size_t> at(values.size(), 0);
    for (bool more = true; more;) {
      Task task;
      task.setup = base;
      for (std::size_t k = 0; k < values.size(); ++k) {
        task.values.push_back(values[k][at[k]]);
        set_value(sweep.keys[k], values[k][at[k]], task.setup);
      }
      const std::string person = task.setup.person ? std::to_string(*task.setup.person) : "";
      const auto [found, is_new] = made.try_emplace({vessel, person}, sweep.vessels.size());
      if (is_new) sweep.vessels.push_back(task.setup);
      task.vessel = found->second;
      task.setup.mesh = {};
      for (std::uint64_t seed = first; seed <= last; ++seed) {
        task.seed = task.setup.seed = seed;
        sweep.tasks.push_back(task);
      }
      more = false;
      for (std::size_t k = values.size(); k-- > 0;) {
        if (++at[k] < values[k].size()) {
          more = true;
          break;
        }
        at[k] = 0;
      }
    }
  }
  return sweep;
}

std::string csv(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + "\"";
}

std::string heading(const Sweep& sweep) {
  std::string line = "case,script,seed";
  for (const std::string& key : sweep.keys) line += "," + csv(key);
  line += ",outcome,reason,simulated_s";
  for (const MetricDefinition& metric : metric_definitions()) line += "," + metric.name;
  return line + ",deepest_penetration_mm,nodes_outside,troubled_steps,state\n";
}

std::string beginning_of(const Task& task) {
  std::string line = fmt::format("{},{},{}", csv(task.setup.vessel), csv(task.setup.script.name), task.seed);
  for (const std::string& value : task.values) line += "," + csv(value);
  return line;
}

/// Of a run whose vessel cannot be built: one person whose artery has no room for a lesion must not end a sweep over a
/// thousand.
std::string line_without_vessel(const Task& task, const std::string& why) {
  return beginning_of(task) + ",aborted," + csv(why) + ",0.000" + std::string(metric_definitions().size() + 4, ',') +
         "\n";
}

std::string line_of(const Task& task, const ScriptedRun& run, const PlayReport& r) {
  std::string line = beginning_of(task);
  line += fmt::format(",{},{},{:.3f}", r.outcome, csv(r.reason), r.simulated_s);
  for (const Metric& m : r.metrics) line += std::isfinite(m.value) ? fmt::format(",{:.9g}", m.value) : ",";
  return line + fmt::format(",{:.6f},{},{},{:016x}\n", 1e3 * r.penetration.deepest_m, r.penetration.outside,
                            run.troubled, r.hash);
}

/// What is done, in a file beside the table: a line a run, each written at once. Its first line says of which sweep.
class Journal {
 public:
  Journal(const std::string& file, const Sweep& sweep, bool resume) : file_(file), lines_(sweep.tasks.size()) {
    std::string what = heading(sweep);
    for (const Task& task : sweep.tasks) what += to_json(task.setup);
    const std::string first =
        fmt::format("sweep of {} runs, {:016x}", sweep.tasks.size(), std::hash<std::string>{}(what));
    if (fs::exists(file)) {
      if (!resume)
        throw LoadError(
            fmt::format("{} is of a sweep that was not finished; --resume goes on with it, or remove it", file));
      read(first);
    }
    out_.open(file, std::ios::app | std::ios::binary);
    if (done_ == 0 && fs::file_size(file) == 0) out_ << first << "\n";
    out_.flush();
    if (!out_) throw LoadError(file + ": cannot be written; is its folder there, and the disk not full?");
  }
  bool has(std::size_t task) const { return !lines_[task].empty(); }
  void add(std::size_t task, const std::string& line) {
    lines_[task] = line;
    ++done_;
    out_ << task << " " << line << std::flush;
    if (!out_) throw LoadError(file_ + ": cannot be written; is the disk full?");
  }
  std::size_t done() const { return done_; }
  /// Puts the table, whole and in order, in its place.
  void finish(const std::string& table, const std::string& head) {
    const std::string unfinished = table + ".unfinished";
    std::ofstream out(unfinished, std::ios::binary);
    out << head;
    for (const std::string& line : lines_) out << line;
    out.close();
    if (!out || std::rename(unfinished.c_str(), table.c_str()) != 0) {
      std::remove(unfinished.c_str());
      throw LoadError(table + ": cannot be written; is its folder there, and the disk not full?");
    }
    out_.close();
    std::remove(file_.c_str());
  }

 private:
  void read(const std::string& first) {
    std::ifstream in(file_, std::ios::binary);
    std::string line, kept;
    std::getline(in, line);
    if (line != first)
      throw LoadError(
          fmt::format("{} is of another sweep; expected the same cases, script, seeds and parameters", file_));
    kept = line + "\n";
    // What follows the last line end was cut off by a kill.
    while (std::getline(in, line) && !in.eof()) {
      std::size_t used = 0;
      const std::size_t task = std::stoul(line, &used);
      if (task >= lines_.size()) throw LoadError(file_ + ": is damaged");
      if (lines_[task].empty()) ++done_;
      lines_[task] = line.substr(used + 1) + "\n";
      kept += line + "\n";
    }
    in.close();
    std::ofstream(file_, std::ios::binary) << kept;
  }

  std::string file_;
  std::ofstream out_;
  std::vector<std::string> lines_;
  std::size_t done_ = 0;
};

}  // namespace

int sweep_command(const SweepOptions& o) {
  const Sweep sweep = plan(o);
  Journal journal(o.table + ".part", sweep, o.resume);
  const auto ask_to_stop = [](int) { interrupted = true; };
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  const std::size_t jobs =
      o.jobs > 0 ? static_cast<std::size_t>(o.jobs) : std::max(1u, std::thread::hardware_concurrency());
  std::mutex mutex;
  std::string problem;
  std::size_t refused = 0;
  // A vessel at a time, so that no more than one is in memory.
  for (std::size_t v = 0; v < sweep.vessels.size() && !interrupted && problem.empty(); ++v) {
    std::vector<std::size_t> open;
    for (std::size_t t = 0; t < sweep.tasks.size(); ++t)
      if (sweep.tasks[t].vessel == v && !journal.has(t)) open.push_back(t);
    if (open.empty()) continue;
    say("building " + sweep.vessels[v].vessel);
    std::string warnings;
    std::shared_ptr<const Vessel> vessel;
    try {
      vessel = make_vessel(sweep.vessels[v], warnings);
    } catch (const std::exception& error) {
      for (const std::size_t t : open) journal.add(t, line_without_vessel(sweep.tasks[t], error.what()));
      refused += open.size();
      say("");
      fmt::print(stderr, "ostium sweep: {} cannot be built{}: {}\n", sweep.vessels[v].vessel,
                 sweep.vessels[v].person ? fmt::format(" for person {}", *sweep.vessels[v].person) : "", error.what());
      continue;
    }
    const auto dosimeter = std::make_shared<const Dosimeter>(*vessel);
    std::atomic<std::size_t> next{0};
    const auto work = [&] {
      for (std::size_t i; (i = next++) < open.size() && !interrupted;) {
        const Task& task = sweep.tasks[open[i]];
        try {
          RunSetup setup = task.setup;
          choose_sizes(*vessel, setup);
          ScriptedRun run(setup, vessel);
          PlayOptions options;
          options.recorder.mode = RecordMode::none;
          options.seconds = o.run.seconds;
          options.dosimeter = dosimeter;
          options.stop = &interrupted;
          const PlayReport report = play(run, setup, options);
          if (interrupted) return;  // it did not come to its own end
          const std::lock_guard lock(mutex);
          journal.add(open[i], line_of(task, run, report));
          say(fmt::format("{} of {} runs, {} seed {}: {}", journal.done(), sweep.tasks.size(), task.setup.vessel,
                          task.seed, report.outcome));
        } catch (const std::exception& error) {
          const std::lock_guard lock(mutex);
          problem = error.what();
          interrupted = true;
        }
      }
    };
    std::vector<std::thread> threads;
    for (std::size_t j = 0; j < std::min(jobs, open.size()); ++j) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
  }
  say("");
  if (refused == sweep.tasks.size()) {
    fs::remove(o.table + ".part");
    throw LoadError("no vessel of the sweep can be built");
  }
  if (!problem.empty()) throw LoadError(problem);
  if (interrupted) {
    fmt::print(stderr, "ostium sweep: stopped after {} of {} runs; --resume goes on\n", journal.done(),
               sweep.tasks.size());
    return 1;
  }
  journal.finish(o.table, heading(sweep));
  fmt::print("{}: {} runs\n", o.table, sweep.tasks.size());
  return 0;
}

}  // namespace ostium
