#include "data/catalogue/script/script.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>

#include "app/python/binding/bindings.h"
#include "app/python/binding/data.h"
#include "app/session/run/play.h"

namespace ostium::python {

namespace py = pybind11;

namespace {

using Values = std::map<std::string, std::string>;

struct Played {
  app::PlayReport report;
  std::vector<std::string> chosen;
};

Played play_script(const std::string& vessel, const std::string& script, std::uint64_t seed, const Values& values,
                   double seconds, const std::optional<std::filesystem::path>& recording,
                   const std::function<bool()>& stop) {
  app::RunSetup setup;
  setup.seed = seed;
  set_vessel(vessel, vascular::LengthUnit::millimetre, setup);
  if (setup.is_mesh()) throw py::value_error(vessel + ": is a mesh; expected a case");
  set_script(data::find_script(script), setup);
  for (const auto& [key, value] : values) set_value(key, value, setup);
  app::RunSetup of_vessel;
  of_vessel.vessel = setup.vessel, of_vessel.case_text = setup.case_text, of_vessel.person = setup.person;
  const auto handle = VesselHandle::of(std::move(of_vessel));
  Played played{.report = {}, .chosen = choose_sizes(*handle->vessel, setup)};
  app::ScriptedRun run(setup, handle->vessel);
  std::atomic<bool> stopped{false};
  app::PlayOptions options;
  options.recorder.mode = recording ? app::RecordMode::full : app::RecordMode::none;
  if (recording) options.recorder.file = recording->string();
  options.seconds = seconds;
  options.stop = &stopped;
  options.progress = [&](const app::ScriptedRun&) {
    if (stop()) stopped = true;
  };
  played.report = play(run, setup, options);
  return played;
}

}  // namespace

void bind_script(py::module_& module) {
  module.def(
      "run_script",
      [](const std::string& case_name, const std::string& script, std::uint64_t seed, const py::dict& values,
         double seconds, const std::optional<std::filesystem::path>& recording) {
        if (!(seconds >= 0 && seconds <= 36000)) throw py::value_error("seconds is outside 0 to 36000");
        Values texts;
        for (const auto& [key, value] : values) texts[py::str(key)] = py::str(value);
        Played played;
        run_until_interrupted([&](const std::function<bool()>& stop) {
          played = play_script(case_name, script, seed, texts, seconds, recording, stop);
        });
        const app::PlayReport& report = played.report;
        if (!report.problem.empty())
          throw py::value_error("the recording could not be written to its end: " + report.problem);
        py::dict metrics;
        for (const data::Metric& metric : report.metrics) metrics[py::str(metric.name)] = metric.value;
        return py::dict(py::arg("outcome") = report.outcome, py::arg("reason") = report.reason,
                        py::arg("simulated_s") = report.simulated_s, py::arg("clock_s") = report.clock_s,
                        py::arg("deepest_mm") = 1e3 * report.penetration.deepest_m, py::arg("hash") = report.hash,
                        py::arg("chosen") = played.chosen, py::arg("metrics") = metrics);
      },
      py::arg("case"), py::arg("script"), py::arg("seed") = 0, py::arg("values") = py::dict(), py::arg("seconds") = 0.0,
      py::arg("recording") = py::none(),
      R"(Plays a script, as `ostium run` does, without its files.

case, script   names of `ostium cases` and `ostium scripts`, or files
values         as --set: {"person": 3, "wire": "rosen", "friction": 0.05, ...}
seconds        simulated at most; 0: as long as it takes
recording      a file, run.h5, to record into
Returns a dict: outcome, reason, simulated_s, clock_s, deepest_mm, hash of the last state, chosen sizes, metrics (NaN: does
not apply). Other Python threads run meanwhile. Raises OstiumError.)");
}

}  // namespace ostium::python
