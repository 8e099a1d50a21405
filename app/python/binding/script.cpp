#include "data/catalogue/script/script.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "app/python/binding/bindings.h"
#include "app/python/binding/data.h"
#include "app/session/labelling/label_set.h"
#include "app/session/labelling/labelled_run.h"
#include "app/session/labelling/splits.h"
#include "app/session/run/play.h"
#include "data/formats/dicom/dicom.h"
#include "data/formats/write_file.h"

namespace ostium::python {

namespace py = pybind11;

namespace {

using Values = std::map<std::string, std::string>;

struct Played {
  app::PlayReport report;
  std::vector<std::string> chosen;
};

/// What is played: a script in a case.
struct Ready {
  app::RunSetup setup;
  std::shared_ptr<const app::Vessel> vessel;
  std::vector<std::string> chosen;
};

Ready make_ready(const std::string& vessel, const std::string& script, std::uint64_t seed, const Values& values) {
  Ready out;
  app::RunSetup& setup = out.setup;
  setup.seed = seed;
  set_vessel(vessel, vascular::LengthUnit::millimetre, setup);
  if (setup.is_mesh()) throw py::value_error(vessel + ": is a mesh; expected a case");
  set_script(data::find_script(script), setup);
  for (const auto& [key, value] : values) set_value(key, value, setup);
  app::RunSetup of_vessel;
  of_vessel.vessel = setup.vessel, of_vessel.case_text = setup.case_text, of_vessel.person = setup.person;
  out.vessel = VesselHandle::of(std::move(of_vessel))->vessel;
  out.chosen = choose_sizes(*out.vessel, setup);
  return out;
}

Played play_script(const Ready& ready, double seconds, const std::optional<std::filesystem::path>& recording,
                   const std::function<bool()>& stop) {
  const app::RunSetup& setup = ready.setup;
  Played played{.report = {}, .chosen = ready.chosen};
  app::ScriptedRun run(setup, ready.vessel);
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

Values texts_of(const py::dict& values) {
  Values texts;
  for (const auto& [key, value] : values) texts[py::str(key)] = py::str(value);
  return texts;
}

void require_seconds(double seconds) {
  if (!(seconds >= 0 && seconds <= 36000)) throw py::value_error("seconds is outside 0 to 36000");
}

/// Before anything is built. Its folder is made as needed.
void require_recording(const std::filesystem::path& file) {
  data::require_place_for(file.string());
  std::error_code none;  // what cannot be made is said when the file is
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path(), none);
}

using Json = nlohmann::ordered_json;

/// JSON of one labelled run; empty if it was stopped.
std::string label_run(const Ready& ready, const std::string& name, const std::filesystem::path& folder,
                      const app::FrameOptions& options) {
  const Json made = frames_of_run(ready.setup, ready.vessel, name, folder.string(), options);
  if (made.empty()) return "";
  Json out = {{"name", name},
              {"case", ready.setup.vessel},
              {"script", ready.setup.script.name},
              {"seed", ready.setup.seed},
              {"person", person_of(ready.setup)}};
  out.update(made);
  return out.dump();
}

}  // namespace

void bind_script(py::module_& module) {
  module.def(
      "run_script",
      [](const std::string& case_name, const std::string& script, std::uint64_t seed, const py::dict& values,
         double seconds, const std::optional<std::filesystem::path>& recording) {
        require_seconds(seconds);
        if (recording) require_recording(*recording);
        const Values texts = texts_of(values);
        Played played;
        run_until_interrupted([&](const std::function<bool()>& stop) {
          played = play_script(make_ready(case_name, script, seed, texts), seconds, recording, stop);
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
  module.def(
      "_label_run",
      [](const std::string& case_name, const std::string& script, std::uint64_t seed, const py::dict& values,
         double seconds, const std::string& name, const std::filesystem::path& folder, double every_s, int pixels,
         bool dicom) {
        require_seconds(seconds);
        if (!(every_s >= 0.05 && every_s <= 3600)) throw py::value_error("every_s is outside 0.05 to 3600");
        if (pixels < 64 || pixels > 1024) throw py::value_error("pixels is outside 64 to 1024");
        const Values texts = texts_of(values);
        std::string json;
        run_until_interrupted([&](const std::function<bool()>& stop) {
          app::FrameOptions options{.every_s = every_s, .pixels = pixels, .seconds = seconds, .dicom = dicom};
          options.stop = stop;
          json = label_run(make_ready(case_name, script, seed, texts), name, folder, options);
        });
        return json;
      },
      py::arg("case"), py::arg("script"), py::arg("seed"), py::arg("values"), py::arg("seconds"), py::arg("name"),
      py::arg("folder"), py::arg("every_s"), py::arg("pixels"), py::arg("dicom"));
  module.def("_require_dicom", &data::require_dicom);
  module.def(
      "_write_label_set",
      [](const std::filesystem::path& folder, double every_s, int pixels, const std::vector<std::string>& keys,
         const std::vector<std::string>& runs) {
        const OthersRun others_run;
        std::vector<Json> read;
        for (const std::string& run : runs) read.push_back(Json::parse(run));
        return app::write_label_set(folder.string(), {every_s, pixels, keys}, read);
      },
      py::arg("folder"), py::arg("every_s"), py::arg("pixels"), py::arg("keys"), py::arg("runs"));
}

}  // namespace ostium::python
