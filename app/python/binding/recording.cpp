#include "data/recording/recording.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "app/python/binding/arrays.h"
#include "app/python/binding/bindings.h"
#include "app/python/binding/interpreter.h"
#include "app/reader/read_apart.h"
#include "data/assessment/events.h"
#include "data/formats/load_error.h"

namespace ostium::python {

namespace {

struct RecordingHandle : data::RecordingReader, MadeByInit {
  using data::RecordingReader::RecordingReader;
};

template <class T>
py::array_t<T> table(const std::vector<T>& numbers, std::size_t columns) {
  const auto width = static_cast<py::ssize_t>(columns);
  return py::array_t<T>({static_cast<py::ssize_t>(numbers.size()) / width, width}, numbers.data());
}

py::object from_json(const std::string& text, const RecordingHandle& of) {
  try {
    return py::module_::import("json").attr("loads")(text);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;
    throw data::LoadError(of.path() + ": is damaged; copy the file again");
  }
}

/// Names by index, as the file has them.
auto names_of(const char* of_table, const char* attribute) {
  return [=](const RecordingHandle& self) { return self.tables().texts(of_table, attribute); };
}

/// (moments) steps and (moments, nodes, 3) points.
py::tuple shapes(const RecordingHandle& self, const std::string& tool) {
  const data::TableFile& file = self.tables();
  const std::string name = data::shape_table(tool);
  if (!file.has(name))
    throw py::value_error(self.path() + ": has no shapes of \"" + tool +
                          "\"; expected a tool of a run with --record shapes");
  const std::size_t moments = file.rows(name);
  const std::vector<double> numbers = file.numbers(name, 0, moments);
  const auto nodes = static_cast<py::ssize_t>(file.width(name)) / 3;
  return py::make_tuple(
      copy_of(file.integers("shapes_step", 0, moments)),
      py::array_t<double>({static_cast<py::ssize_t>(moments), nodes, py::ssize_t{3}}, numbers.data()));
}

}  // namespace

void bind_recording(py::module_& module) {
  auto bound =
      py::class_<RecordingHandle, std::shared_ptr<RecordingHandle>>(module, "RecordingFile",
                                                                    R"(A recording as `ostium run` writes it: run.h5.

RecordingFile(path) raises OstiumError for a file that is damaged, or is none of this version.)")
          .def(py::init([](const std::filesystem::path& path) {
                 const OthersRun others_run;
                 app::require_whole_recording(path.string());
                 return std::make_shared<RecordingHandle>(path.string());
               }),
               py::arg("path"))
          .def_property_readonly("path", [](const RecordingHandle& self) { return self.path(); })
          .def_property_readonly("software", [](const RecordingHandle& self) { return self.software(); })
          .def_property_readonly(
              "setup", [](const RecordingHandle& self) { return from_json(self.setup(), self); },
              "dict: case, script, instruments, seed.")
          .def_property_readonly(
              "end",
              [](const RecordingHandle& self) -> py::object {
                const auto end = self.end();
                return end ? from_json(*end, self) : py::none();
              },
              "dict: outcome, reason, metrics; None where the recording was cut off.")
          .def_property_readonly("step_s", [](const RecordingHandle& self) { return self.step_s(); })
          .def_property_readonly("steps", [](const RecordingHandle& self) { return self.steps(); })
          .def_property_readonly("signal_names", [](const RecordingHandle& self) { return self.signal_columns(); })
          .def_property_readonly("input_names", [](const RecordingHandle& self) { return self.input_columns(); })
          .def_property_readonly(
              "signals",
              [](const RecordingHandle& self) { return table(self.signals(), self.signal_columns().size()); },
              "(samples, signals), one every 10 steps.")
          .def_property_readonly(
              "inputs",
              [](const RecordingHandle& self) {
                return table(self.inputs(0, self.steps()), self.input_columns().size());
              },
              "(steps, inputs).")
          .def_property_readonly(
              "hashes", [](const RecordingHandle& self) { return copy_of(self.hashes(0, self.steps())); },
              "(steps) uint64, of the state after each.")
          .def_property_readonly(
              "events", [](const RecordingHandle& self) { return table(self.events(), 4); },
              "(events, 4): step, code, tool, value.")
          .def_property_readonly("event_names", names_of("events", "names"), "By code.")
          .def_property_readonly("tools", names_of("", "tools"))
          .def_property_readonly("branches", names_of("", "branches"), "By index, as tip_branch has them.")
          .def("shapes", shapes, py::arg("tool"),
               "(steps (n), points (n, nodes, 3) m, hub to tip, NaN outside the body), of a run with --record shapes.");
  refuse_to_pickle(bound);
}

}  // namespace ostium::python
