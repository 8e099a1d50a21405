#include "app/python/binding/batch.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <thread>

#include "app/python/binding/arrays.h"
#include "app/python/binding/bindings.h"
#include "core/base/parallel_loop.h"

namespace ostium::python {

BatchHandle::BatchHandle(std::shared_ptr<const ModelHandle> of, std::size_t num, int most_threads)
    : model(std::move(of)), threads(most_threads), runs(num) {
  const app::FreeRunModel& m = *model->model;
  const std::size_t tools = m.session.tools.size();
  inputs.resize(num * m.input_names.size());
  signals.resize(num * m.signal_names.size());
  tips.resize(num * tools * 3);
  forces.resize(num * tools), peaks.resize(num * tools);
  trouble.resize(num);
  const app::FreeRun first(model->model);
  for (std::size_t i = 0; i < num; ++i) {
    runs[i] = std::make_unique<app::FreeRun>(first);
    std::copy(first.row.begin(), first.row.end(), inputs.begin() + static_cast<std::ptrdiff_t>(i * first.row.size()));
    gather(i);
  }
}

void BatchHandle::gather(std::size_t i) {
  const app::FreeRun& e = *runs[i];
  const auto put = [i](const auto& from, auto& block) {
    std::copy(from.begin(), from.end(), block.begin() + static_cast<std::ptrdiff_t>(i * from.size()));
  };
  put(e.signals, signals), put(e.forces, forces), put(e.peaks, peaks);
  trouble[i] = e.trouble;
  const std::size_t tools = e.forces.size();
  for (std::size_t t = 0; t < tools; ++t) {
    const Eigen::Vector3d p = app::tip(model->model->session, e.state, static_cast<int>(t));
    std::copy(p.data(), p.data() + 3, &tips[3 * (i * tools + t)]);
  }
}

void BatchHandle::step(int count, const bool* mask, const std::function<bool()>& stop) {
  const app::FreeRunModel& m = *model->model;
  const std::size_t width = m.input_names.size();
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (mask && !mask[i]) continue;
    chosen.push_back(i);
    const std::string wrong = first_out_of_range(m.input_names, m.ranges, &inputs[i * width]);
    if (!wrong.empty()) throw std::invalid_argument(fmt::format("session {}: {}", i, wrong));
  }
  core::for_each_on(threads, chosen.size(), [&](std::size_t k) {
    const std::size_t i = chosen[k];
    app::FreeRun& e = *runs[i];
    std::copy_n(&inputs[i * width], width, e.row.begin());
    e.step(count, stop);
    gather(i);
  });
}

void BatchHandle::reset(std::size_t i, std::uint64_t seed) {
  app::FreeRun& e = *runs[i];
  e.reset(seed);
  std::copy(e.row.begin(), e.row.end(), inputs.begin() + static_cast<std::ptrdiff_t>(i * e.row.size()));
  gather(i);
}

void BatchHandle::set_state(std::size_t i, const double* numbers) {
  runs[i]->set_state(numbers);
  gather(i);
}

namespace {

using SharedBatch = std::shared_ptr<BatchHandle>;

int threads_or_all(std::optional<int> threads) {
  if (threads && *threads < 1) throw py::value_error(fmt::format("threads is {}; expected 1 or more", *threads));
  return threads ? *threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

std::uint64_t seed_of(const py::object& number) {
  if (const auto whole = py::reinterpret_steal<py::object>(PyNumber_Index(number.ptr()))) {
    const unsigned long long seed = PyLong_AsUnsignedLongLong(whole.ptr());
    if (!PyErr_Occurred()) return seed;
  }
  PyErr_Clear();
  throw py::value_error("the seed is " + py::str(number).cast<std::string>() +
                        "; expected a whole number from 0 to 2^64 - 1");
}

std::size_t index(const BatchHandle& self, py::ssize_t i) {
  const auto num = static_cast<py::ssize_t>(self.runs.size());
  if (i < -num || i >= num) throw py::index_error(fmt::format("session {} is none; there are {}", i, num));
  return static_cast<std::size_t>(i < 0 ? i + num : i);
}

void step(BatchHandle& self, long long n,
          const std::optional<py::array_t<bool, py::array::c_style | py::array::forcecast>>& mask) {
  const int count = require_steps(n);
  if (mask) require_shape(*mask, {static_cast<py::ssize_t>(self.runs.size())}, "mask", "one for each session");
  const bool* of = mask ? mask->data() : nullptr;
  const InUse used(self.used, "Batch");
  run_steps(count, [&](const std::function<bool()>& stop) { self.step(count, of, stop); });
}

void reset(BatchHandle& self, std::optional<py::ssize_t> which, const py::object& to) {
  const InUse used(self.used, "Batch");
  std::size_t first = 0, last = self.runs.size();
  if (which) first = index(self, *which), last = first + 1;
  // Also a whole number of numpy, as its generators draw them.
  const bool whole = PyIndex_Check(to.ptr()) && !PyBool_Check(to.ptr()) && !py::isinstance<py::array>(to);
  if (!to.is_none() && !whole) {
    const auto state = Doubles::of(to);
    if (!state || state->ndim() != 1)
      throw py::value_error("to is no seed and no state; expected a whole number from 0 on, or what get_state gave");
    const double* numbers = self.model->state_of(state->data(), static_cast<std::size_t>(state->size()));
    for (std::size_t i = first; i < last; ++i) self.set_state(i, numbers);
    return;
  }
  const std::uint64_t seed = to.is_none() ? self.model->model->seed : seed_of(to);
  const OthersRun others_run;
  core::for_each_on(self.threads, last - first, [&](std::size_t k) { self.reset(first + k, seed); });
}

template <class T>
auto block(std::vector<T>& memory, std::vector<py::ssize_t> shape, const py::object& owner) {
  return view_of(memory.data(), std::move(shape), owner);
}

py::tuple rollout(const ModelHandle& model, const Doubles& states, const Doubles& inputs, long long hold,
                  std::optional<int> threads) {
  const app::FreeRunModel& m = *model.model;
  const auto width = static_cast<py::ssize_t>(m.input_names.size());
  require_shape(states, {-1, static_cast<py::ssize_t>(model.state_size())}, "states", "(n, Model.state_size)");
  require_shape(inputs, {states.shape(0), -1, width}, "inputs", "(n, steps, inputs)");
  const auto n = static_cast<std::size_t>(states.shape(0)), steps = static_cast<std::size_t>(inputs.shape(1));
  const int each = require_steps(hold), most = threads_or_all(threads);
  for (std::size_t i = 0; i < n; ++i) {
    model.state_of(states.data(static_cast<py::ssize_t>(i), 0), model.state_size());
    for (std::size_t k = 0; k < steps; ++k) {
      const std::string wrong = first_out_of_range(
          m.input_names, m.ranges, inputs.data(static_cast<py::ssize_t>(i), static_cast<py::ssize_t>(k), 0));
      if (!wrong.empty()) throw py::value_error(fmt::format("inputs[{}, {}]: {}", i, k, wrong));
    }
  }
  py::array_t<float> signals({states.shape(0), inputs.shape(1), static_cast<py::ssize_t>(m.signal_names.size())});
  py::array_t<double> ends({states.shape(0), states.shape(1)});
  const double *from = states.data(), *rows = inputs.data();
  float* out = signals.mutable_data();
  double* last = ends.mutable_data();
  run_until_interrupted([&](const std::function<bool()>& stop) {
    const app::FreeRun first(model.model);
    core::for_each_on(most, n, [&](std::size_t i) {
      app::FreeRun e(first);
      e.set_state(from + i * model.state_size() + ModelHandle::head);
      for (std::size_t k = 0; k < steps; ++k) {
        std::copy_n(rows + (i * steps + k) * e.row.size(), e.row.size(), e.row.begin());
        if (stop()) return;
        e.step(each, stop);
        std::copy(e.signals.begin(), e.signals.end(), out + (i * steps + k) * e.signals.size());
      }
      model.put_state(e.state, last + i * model.state_size());
    });
  });
  return py::make_tuple(signals, ends);
}

}  // namespace

void bind_batch(py::module_& module) {
  auto bound =
      py::class_<BatchHandle, SharedBatch>(module, "Batch", R"(Many sessions of one model, stepped side by side.

Batch(model, num, threads=None): on all cores, or so many threads. What comes of a session does not depend on the others
or on the threads. Arrays are views, as those of Data.)")
          .def(py::init([](std::shared_ptr<ModelHandle> model, long long num, std::optional<int> threads) {
                 if (num < 1 || num > 100'000)
                   throw py::value_error(fmt::format("num is {}; expected 1 to 100000", num));
                 const int most = threads_or_all(threads);
                 const OthersRun others_run;
                 return std::make_shared<BatchHandle>(std::move(model), static_cast<std::size_t>(num), most);
               }),
               py::arg("model").none(false), py::arg("num"), py::arg("threads") = py::none())
          .def_property_readonly(
              "model", [](const BatchHandle& self) { return std::const_pointer_cast<ModelHandle>(self.model); },
              "Of which these are sessions.")
          .def_property_readonly(
              "num", [](const BatchHandle& self) { return self.runs.size(); }, "How many sessions there are.")
          .def("__len__", [](const BatchHandle& self) { return self.runs.size(); })
          .def_property(
              "inputs",
              [](const py::object& self) {
                auto& b = self.cast<BatchHandle&>();
                const auto num = static_cast<py::ssize_t>(b.runs.size());
                return block(b.inputs, {num, static_cast<py::ssize_t>(b.inputs.size()) / num}, self);
              },
              [](BatchHandle& self, const Doubles& to) {
                const auto num = static_cast<py::ssize_t>(self.runs.size());
                require_shape(to, {num, static_cast<py::ssize_t>(self.inputs.size()) / num}, "inputs", "(num, inputs)");
                std::copy(to.data(), to.data() + to.size(), self.inputs.begin());
              },
              "(num, inputs) of the next steps, to be written to.")
          .def_property_readonly(
              "signals",
              [](const py::object& self) {
                auto& b = self.cast<BatchHandle&>();
                const auto num = static_cast<py::ssize_t>(b.runs.size());
                return read_only(block(b.signals, {num, static_cast<py::ssize_t>(b.signals.size()) / num}, self));
              },
              "(num, signals) float32, after the last step.")
          .def_property_readonly(
              "tips",
              [](const py::object& self) {
                auto& b = self.cast<BatchHandle&>();
                const auto num = static_cast<py::ssize_t>(b.runs.size());
                return read_only(block(b.tips, {num, static_cast<py::ssize_t>(b.forces.size()) / num, 3}, self));
              },
              "(num, tools, 3) m.")
          .def_property_readonly(
              "forces",
              [](const py::object& self) {
                auto& b = self.cast<BatchHandle&>();
                const auto num = static_cast<py::ssize_t>(b.runs.size());
                return read_only(
                    view_of(&b.forces.data()->push_N, {num, static_cast<py::ssize_t>(b.forces.size()) / num, 4}, self));
              },
              "(num, tools, 4) as Data.forces.")
          .def_property_readonly(
              "peaks",
              [](const py::object& self) {
                auto& b = self.cast<BatchHandle&>();
                const auto num = static_cast<py::ssize_t>(b.runs.size());
                return read_only(
                    view_of(&b.peaks.data()->push_N, {num, static_cast<py::ssize_t>(b.peaks.size()) / num, 4}, self));
              },
              "(num, tools, 4) as Data.peaks.")
          .def_property_readonly(
              "phases",
              [](const BatchHandle& self) {
                py::array_t<double> phases(static_cast<py::ssize_t>(self.runs.size()));
                for (std::size_t i = 0; i < self.runs.size(); ++i)
                  phases.mutable_data()[i] = self.runs[i]->state.blood.heart.phase;
                return phases;
              },
              "(num) of the heartbeats, [0, 1), a copy.")
          .def_property_readonly(
              "trouble",
              [](const py::object& self) {
                auto& b = self.cast<BatchHandle&>();
                return read_only(block(b.trouble, {static_cast<py::ssize_t>(b.trouble.size())}, self));
              },
              "(num) uint32: bits of what gave way in the last call (core/model/report.h); 0: nothing.")
          .def("step", step, py::arg("n") = 1, py::arg("mask") = py::none(),
               "n steps of all, or of those where mask (num) is true. Raises ValueError, and steps none, for an input "
               "out "
               "of "
               "its range.")
          .def("reset", reset, py::arg("i") = py::none(), py::arg("to") = py::none(),
               "Session i, or all, to the beginning of a seed (the model's), or to a state.")
          .def(
              "get_state",
              [](const BatchHandle& self, py::ssize_t i) {
                const InUse used(self.used, "Batch");
                py::array_t<double> numbers(static_cast<py::ssize_t>(self.model->state_size()));
                self.model->put_state(self.runs[index(self, i)]->state, numbers.mutable_data());
                return numbers;
              },
              py::arg("i"), "(Model.state_size) of session i, as Data.get_state.")
          .def(
              "hash",
              [](const BatchHandle& self, py::ssize_t i) { return app::hash(self.runs[index(self, i)]->state); },
              py::arg("i"), "As Data.hash, of session i.")
          .def(
              "nodes",
              [](const py::object& self, py::ssize_t i, const std::string& tool) {
                auto& b = self.cast<BatchHandle&>();
                return nodes_of(*b.model, b.runs[index(b, i)]->state, tool, self);
              },
              py::arg("i"), py::arg("tool"), "As Data.nodes, of session i.")
          .def(
              "data",
              [](const BatchHandle& self, py::ssize_t i) {
                const InUse used(self.used, "Batch");
                const app::FreeRun& from = *self.runs[index(self, i)];
                return std::make_shared<DataHandle>(self.model, from);
              },
              py::arg("i"), "A copy of session i.");
  refuse_to_pickle(bound);
  module.def("rollout", rollout, py::arg("model").none(false), py::arg("states"), py::arg("inputs"),
             py::arg("hold") = 1, py::arg("threads") = py::none(),
             R"(Sequences of inputs from states, side by side.

states (n, Model.state_size), inputs (n, steps, inputs), each held for `hold` steps of the engine.
Returns (signals (n, steps, signals) float32, last states (n, Model.state_size)).)");
}

}  // namespace ostium::python
