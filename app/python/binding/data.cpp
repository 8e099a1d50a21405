#include "app/python/binding/data.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <stdexcept>

#include "app/python/binding/arrays.h"
#include "app/python/binding/bindings.h"
#include "app/session/run/run.h"
#include "core/rod/introducer.h"

namespace ostium::python {

InUse::InUse(std::atomic<bool>& mark, const char* what) : mark_(mark) {
  if (mark.exchange(true))
    throw std::runtime_error(fmt::format("another thread steps this {}; each thread needs one of its own", what));
}

int require_steps(long long n) {
  constexpr long long most = 86'400'000;
  if (n < 1 || n > most)
    throw py::value_error(fmt::format("n is {}; expected a number of steps from 1 to {}", n, most));
  return static_cast<int>(n);
}

void run_steps(int count, const std::function<void(const std::function<bool()>& stop)>& work) {
  if (count > app::FreeRun::steps_unasked) return run_until_interrupted(work);
  const OthersRun others_run;
  work({});
}

py::object nodes_of(const ModelHandle& model, app::SessionState& state, const std::string& tool,
                    const py::object& owner) {
  const auto t = static_cast<std::size_t>(model.tool(tool));
  const core::Rod& rod = model.model->session.rods.rods[t];
  core::RodState& s = state.rods.rods[t];
  const py::ssize_t count = in_body(rod, s) ? rod.elements + 1 - s.first : 0;
  const auto number = static_cast<py::ssize_t>(sizeof(double));
  return read_only(py::array_t<double>({count, py::ssize_t{3}}, {number, s.position.stride() * number},
                                       s.position.at(0) + (count ? s.first : 0), owner));
}

namespace {

using SharedData = std::shared_ptr<DataHandle>;

DataHandle& of(const py::object& self) { return self.cast<DataHandle&>(); }

void step(const ModelHandle& model, DataHandle& data, long long n) {
  if (model.fingerprint != data.model->fingerprint) throw py::value_error("this Data is one of another model");
  const int count = require_steps(n);
  const InUse used(data.used, "Data");
  run_steps(count, [&](const std::function<bool()>& stop) { data.run.step(count, stop); });
}

py::array_t<double> get_state(const DataHandle& self) {
  const InUse used(self.used, "Data");
  py::array_t<double> numbers(static_cast<py::ssize_t>(self.model->state_size()));
  self.model->put_state(self.run.state, numbers.mutable_data());
  return numbers;
}

void set_state(DataHandle& self, const Doubles& numbers) {
  const InUse used(self.used, "Data");
  self.run.set_state(self.model->state_of(numbers.data(), static_cast<std::size_t>(numbers.size())));
}

void reset_data(DataHandle& self, std::optional<std::uint64_t> seed) {
  const InUse used(self.used, "Data");
  const OthersRun others_run;
  self.run.reset(seed.value_or(self.model->model->seed));
}

py::array forces_view(std::vector<app::ToolForces>& forces, const py::object& owner) {
  static_assert(sizeof(app::ToolForces) == 4 * sizeof(double));
  return read_only(view_of(&forces.data()->push_N, {static_cast<py::ssize_t>(forces.size()), 4}, owner));
}

SharedData copy(const DataHandle& self) {
  const InUse used(self.used, "Data");
  return std::make_shared<DataHandle>(self);
}

}  // namespace

void bind_data(py::module_& module) {
  auto bound =
      py::class_<DataHandle, SharedData>(
          module, "Data",
          R"(A session of a model: its state, the inputs of its next steps, and what came of the last ones.

Data(model). Arrays are views of the engine's own memory, and show what the last step made of them; they outlive this
object. One thread at a time: a second one that steps, copies, saves or restores gets RuntimeError.)")
          .def(py::init([](std::shared_ptr<ModelHandle> model) {
                 const OthersRun others_run;
                 return std::make_shared<DataHandle>(std::move(model));
               }),
               py::arg("model").none(false))
          .def_property_readonly(
              "model", [](const DataHandle& self) { return std::const_pointer_cast<ModelHandle>(self.model); },
              "Of which it is a session.")
          .def_property(
              "inputs",
              [](const py::object& self) {
                auto& row = of(self).run.row;
                return view_of(row.data(), {static_cast<py::ssize_t>(row.size())}, self);
              },
              [](DataHandle& self, const Doubles& to) {
                auto& row = self.run.row;
                require_shape(to, {static_cast<py::ssize_t>(row.size())}, "inputs", "one for each of input_names");
                std::copy(to.data(), to.data() + to.size(), row.begin());
              },
              "(inputs) of the next steps, to be written to; names, units and ranges: Model.input_names, input_ranges.")
          .def_property_readonly(
              "input_names", [](const DataHandle& self) { return self.model->model->input_names; },
              "As Model.input_names.")
          .def_property_readonly(
              "signals",
              [](const py::object& self) {
                auto& row = of(self).run.signals;
                return read_only(view_of(row.data(), {static_cast<py::ssize_t>(row.size())}, self));
              },
              "(signals) float32, after the last step; Model.signals says what they are. NaN: there is none, such as "
              "the "
              "pressure of a guide that is not in the body.")
          .def(
              "signal",
              [](const DataHandle& self, const std::string& name) {
                const auto& names = self.model->model->signal_names;
                const auto found = std::find(names.begin(), names.end(), name);
                if (found == names.end())
                  throw py::value_error("there is no signal \"" + name + "\"; see Model.signals");
                return self.run.signals[static_cast<std::size_t>(found - names.begin())];
              },
              py::arg("name"), "One signal by its name.")
          .def_property_readonly(
              "forces", [](const py::object& self) { return forces_view(of(self).run.forces, self); },
              "(tools, 4) after the last step: push N, torque N m (of the hand), normal force of the walls "
              "N, the same on the last 10 mm N.")
          .def_property_readonly(
              "peaks", [](const py::object& self) { return forces_view(of(self).run.peaks, self); },
              "(tools, 4) the largest magnitudes of these during the last call of step.")
          .def(
              "nodes",
              [](const py::object& self, const std::string& tool) {
                DataHandle& d = of(self);
                return nodes_of(*d.model, d.run.state, tool, self);
              },
              py::arg("tool"),
              "(n, 3) points of a tool from the introducer to its tip, m; empty outside the body. A view: "
              "ask again after a step, as more of it may have come in.")
          .def(
              "tip",
              [](const DataHandle& self, const std::string& tool) {
                return app::tip(self.model->model->session, self.run.state, self.model->tool(tool));
              },
              py::arg("tool"), "(3) its tip, m; the introducer while it is outside.")
          .def(
              "tip_direction",
              [](const DataHandle& self, const std::string& tool) {
                return app::tip_direction(self.model->model->session, self.run.state, self.model->tool(tool));
              },
              py::arg("tool"), "(3) unit vector.")
          .def_property_readonly(
              "time", [](const DataHandle& self) { return app::seconds(self.model->model->session, self.run.state); },
              "Simulated time, s.")
          .def_property_readonly(
              "phase", [](const DataHandle& self) { return self.run.state.blood.heart.phase; },
              "Of the heartbeat, [0, 1).")
          .def_property_readonly(
              "trouble", [](const DataHandle& self) { return app::trouble_words(self.run.trouble); },
              "What gave way in the last call: \"drive_limited, feed_stopped\"; empty: nothing.")
          .def_property_readonly(
              "depth", [](const DataHandle& self) { return self.run.deepest_m; },
              "Deepest that a node lay in the wall in the last call, m.")
          .def(
              "step", [](DataHandle& self, long long n) { step(*self.model, self, n); }, py::arg("n") = 1,
              "n steps with these inputs; doses are given by the first. Raises ValueError, and does nothing, for an "
              "input "
              "out of its range; drives of tools are limited instead, and `trouble` says so.")
          .def("reset", reset_data, py::arg("seed") = py::none(), "To the beginning: of a seed, or the model's.")
          .def("get_state", get_state, "(Model.state_size) all that it takes to go on to the bit.")
          .def("set_state", set_state, py::arg("state"),
               "Goes on from what get_state gave. Forces and what depends on them are zero until the next step. Raises "
               "ValueError for the state of another model.")
          .def(
              "hash", [](const DataHandle& self) { return app::hash(self.run.state); },
              "64 bits of all that affects later steps, as recordings have it.")
          .def("copy", copy, "Another session that goes on as this one would; copy.copy and copy.deepcopy do the same.")
          .def("__copy__", copy)
          .def("__deepcopy__", [](const DataHandle& self, const py::dict&) { return copy(self); })
          .def("__repr__",
               [](const DataHandle& self) {
                 return fmt::format("<ostium.Data of {} at {:.3f} s>", self.model->recipe.vessel->vessel->name,
                                    app::seconds(self.model->model->session, self.run.state));
               })
          .def(py::pickle(
              [](const DataHandle& self) {
                return py::make_tuple(std::const_pointer_cast<ModelHandle>(self.model), get_state(self),
                                      copy_of(self.run.row));
              },
              [](const py::tuple& r) {
                if (r.size() != 3) throw py::value_error("this is no data of this version");
                const auto data = std::make_shared<DataHandle>(r[0].cast<std::shared_ptr<ModelHandle>>());
                set_state(*data, r[1].cast<Doubles>());
                const auto row = r[2].cast<Doubles>();
                require_shape(row, {static_cast<py::ssize_t>(data->run.row.size())}, "inputs", "of this model");
                std::copy(row.data(), row.data() + row.size(), data->run.row.begin());
                return data;
              }));
  pickle_in_every_protocol(bound);
  module.def(
      "step", [](const ModelHandle& model, DataHandle& data, long long n) { step(model, data, n); },
      py::arg("model").none(false), py::arg("data").none(false), py::arg("n") = 1,
      "As data.step(n); other Python threads run meanwhile.");
}

}  // namespace ostium::python
