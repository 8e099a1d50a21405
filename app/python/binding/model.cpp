#include "app/python/binding/model.h"

#include <fmt/format.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <iterator>
#include <tuple>
#include <variant>

#include "app/python/binding/arrays.h"
#include "app/python/binding/bindings.h"
#include "app/session/recorder/signals.h"
#include "core/base/field_numbers.h"
#include "data/catalogue/catalogue.h"
#include "data/catalogue/drug/drug_file.h"
#include "data/catalogue/instrument/instrument_reader.h"
#include "data/formats/read_file.h"

namespace ostium::python {

namespace {

using NamedTools = std::vector<std::pair<std::string, std::string>>;
/// (name, instrument), or (name, instrument, the wire that it goes over).
using WantedTool = std::variant<std::pair<std::string, std::string>, std::tuple<std::string, std::string, std::string>>;
using WantedTools = std::vector<WantedTool>;

std::tuple<std::string, std::string, std::string> parts_of(const WantedTool& tool) {
  if (const auto* pair = std::get_if<0>(&tool)) return {pair->first, pair->second, ""};
  return std::get<1>(tool);
}

std::shared_ptr<const app::FreeRunModel> model_of(const ModelRecipe& recipe) {
  std::vector<app::SessionTool> tools;
  for (const ModelRecipe::Tool& tool : recipe.tools)
    tools.push_back({tool.name, data::read_instrument(tool.file, tool.text), tool.over});
  app::SessionOptions options = recipe.options;
  for (const ModelRecipe::DrugFile& drug : recipe.drugs) options.drugs.push_back(data::read_drug(drug.file, drug.text));
  return std::make_shared<app::FreeRunModel>(make_session(recipe.vessel->vessel, std::move(tools), options),
                                             recipe.options.seed);
}

/// A whole number below 2^53, which a double holds.
double checksum(const void* first, std::size_t doubles) {
  return static_cast<double>(core::hash_bytes(first, doubles * sizeof(double), 0) >> 11);
}

double fingerprint_of(const ModelRecipe& recipe) {
  std::string all = recipe.vessel->key;
  for (const ModelRecipe::Tool& tool : recipe.tools) all += '\0' + tool.name + '\0' + tool.over + '\0' + tool.text;
  for (const ModelRecipe::DrugFile& drug : recipe.drugs) all += '\0' + drug.text;
  all += fmt::format("{} {} {} {} {}", recipe.options.seed, recipe.options.breaths_1_min, recipe.options.arteries_yield,
                     recipe.options.friction.value_or(-1), recipe.options.begin);
  return static_cast<double>(core::hash_bytes(all.data(), all.size(), 0) >> 11);
}

ModelRecipe recipe_of(std::shared_ptr<VesselHandle> vessel, const WantedTools& tools, std::uint64_t seed,
                      const std::optional<std::string>& begin, std::optional<double> friction, double breathing,
                      const std::string& arteries) {
  ModelRecipe recipe{.vessel = std::move(vessel), .tools = {}, .drugs = {}, .options = {}};
  if (tools.empty()) throw py::value_error("tools is empty; expected (name, instrument) for one tool at least");
  for (const WantedTool& tool : tools) {
    const auto [name, instrument, over] = parts_of(tool);
    const auto same = [&, &wanted = name](const ModelRecipe::Tool& other) { return other.name == wanted; };
    if (name.empty() || name.find('.') != std::string::npos ||
        std::any_of(recipe.tools.begin(), recipe.tools.end(), same))
      throw py::value_error(
          fmt::format("a tool is called \"{}\"; expected a name of its own for each, without a dot", name));
    const std::string file = data::instrument_file(instrument);
    recipe.tools.push_back({name, file, data::read_file(file), over});
  }
  for (const std::string& file : data::drug_files()) recipe.drugs.push_back({file, data::read_file(file)});
  if (!(breathing == 0 || (breathing >= 4 && breathing <= 60)))
    throw py::value_error(fmt::format("breathing is {}; expected breaths a minute, 4 to 60, or 0", breathing));
  if (arteries != "rigid" && arteries != "yield")
    throw py::value_error(fmt::format("arteries is \"{}\"; expected rigid or yield", arteries));
  if (friction && !(*friction >= 0 && *friction <= 1))
    throw py::value_error(fmt::format("friction is {}; expected a number from 0 to 1", *friction));
  recipe.options = {.seed = seed,
                    .breaths_1_min = breathing,
                    .arteries_yield = arteries == "yield",
                    .friction = friction,
                    .begin = begin.value_or(""),
                    .drugs = {}};
  return recipe;
}

py::tuple recipe_to_python(const ModelHandle& self) {
  py::list tools;
  for (const ModelRecipe::Tool& tool : self.recipe.tools)
    tools.append(py::make_tuple(tool.name, tool.file, tool.text, tool.over));
  py::list drugs;
  for (const ModelRecipe::DrugFile& drug : self.recipe.drugs) drugs.append(py::make_tuple(drug.file, drug.text));
  const app::SessionOptions& o = self.recipe.options;
  return py::make_tuple(std::const_pointer_cast<VesselHandle>(self.recipe.vessel), tools, o.seed, o.breaths_1_min,
                        o.friction, o.begin, drugs, o.arteries_yield);
}

std::shared_ptr<ModelHandle> from_python(const py::tuple& r) {
  if (r.size() != 8) throw py::value_error("this is no model of this version");
  ModelRecipe recipe{.vessel = r[0].cast<std::shared_ptr<VesselHandle>>(), .tools = {}, .drugs = {}, .options = {}};
  for (const py::handle tool : r[1]) {
    const auto parts = tool.cast<py::tuple>();
    recipe.tools.push_back({parts[0].cast<std::string>(), parts[1].cast<std::string>(), parts[2].cast<std::string>(),
                            parts[3].cast<std::string>()});
  }
  for (const py::handle drug : r[6]) {
    const auto parts = drug.cast<py::tuple>();
    recipe.drugs.push_back({parts[0].cast<std::string>(), parts[1].cast<std::string>()});
  }
  recipe.options = {.seed = r[2].cast<std::uint64_t>(),
                    .breaths_1_min = r[3].cast<double>(),
                    .arteries_yield = r[7].cast<bool>(),
                    .friction = r[4].cast<std::optional<double>>(),
                    .begin = r[5].cast<std::string>(),
                    .drugs = {}};
  const OthersRun others_run;
  return std::make_shared<ModelHandle>(std::move(recipe));
}

}  // namespace

ModelHandle::ModelHandle(ModelRecipe from)
    : recipe(std::move(from)), model(model_of(recipe)), fingerprint(fingerprint_of(recipe)) {}

int ModelHandle::tool(const std::string& name) const {
  std::string known;
  for (std::size_t t = 0; t < recipe.tools.size(); ++t) {
    if (recipe.tools[t].name == name) return static_cast<int>(t);
    known += (known.empty() ? "" : ", ") + recipe.tools[t].name;
  }
  throw py::value_error(fmt::format("there is no tool \"{}\"; expected one of {}", name, known));
}

void ModelHandle::put_state(const app::SessionState& state, double* numbers) const {
  numbers[0] = fingerprint;
  app::put_state(state, numbers + head);
  numbers[1] = checksum(numbers + head, model->state_count());
}

const double* ModelHandle::state_of(const double* numbers, std::size_t count) const {
  if (count != state_size())
    throw py::value_error(fmt::format(
        "a state has {} numbers here, and this has {}; expected what get_state gave, float64", state_size(), count));
  if (numbers[0] != fingerprint)
    throw py::value_error("this is a state of another model; expected one of the same vessel, tools and options");
  if (numbers[1] != checksum(numbers + head, count - head))
    throw py::value_error("this state is not as get_state gave it; states cannot be edited");
  return numbers + head;
}

void bind_model(py::module_& module) {
  auto bound =
      py::class_<ModelHandle, std::shared_ptr<ModelHandle>>(module, "Model",
                                                            R"(Instruments in a vessel; does not change.

Model(vessel, tools, seed=0, begin=None, friction=None, breathing=0, arteries="rigid")
  tools      [(name, instrument), ...], outermost first; an instrument is a name of `ostium instruments` or a file;
             of several wires, a balloon says which it goes over: (name, instrument, "wire")
  seed       of the person's physiology and of chance; 0: the mean. Also what Data begins with
  begin      an artery ("RCA"): instruments come in before its ostium, not at the access
  friction   of the wall, [0, 1]; breathing: breaths a minute, 4 to 60, or 0; arteries: rigid, or
             yield, to what presses on them
Many threads may use one. Raises OstiumError for instruments that are not there or do not go together.)")
          .def(py::init([](std::shared_ptr<VesselHandle> vessel, const WantedTools& tools, std::uint64_t seed,
                           const std::optional<std::string>& begin, std::optional<double> friction, double breathing,
                           const std::string& arteries) {
                 const OthersRun others_run;
                 return std::make_shared<ModelHandle>(
                     recipe_of(std::move(vessel), tools, seed, begin, friction, breathing, arteries));
               }),
               py::arg("vessel").none(false), py::arg("tools"), py::arg("seed") = 0, py::arg("begin") = py::none(),
               py::arg("friction") = py::none(), py::arg("breathing") = 0.0, py::arg("arteries") = "rigid")
          .def_property_readonly(
              "vessel",
              [](const ModelHandle& self) { return std::const_pointer_cast<VesselHandle>(self.recipe.vessel); },
              "Where its tools are.")
          .def_property_readonly(
              "tools",
              [](const ModelHandle& self) {
                NamedTools names;
                for (std::size_t t = 0; t < self.recipe.tools.size(); ++t)
                  names.emplace_back(self.recipe.tools[t].name, self.model->session.tools[t].instrument.name);
                return names;
              },
              "[(name, instrument), ...].")
          .def_property_readonly(
              "seed", [](const ModelHandle& self) { return self.recipe.options.seed; }, "As it was given.")
          .def_property_readonly(
              "step_s", [](const ModelHandle& self) { return self.model->session.step_s(); }, "Length of a step, s.")
          .def_property_readonly(
              "input_names", [](const ModelHandle& self) { return self.model->input_names; },
              "Names of the columns of inputs, with their units: \"wire.advance_m_s\".")
          .def_property_readonly(
              "input_ranges",
              [](const ModelHandle& self) {
                Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> ranges(self.model->ranges.size(), 2);
                for (Eigen::Index i = 0; i < ranges.rows(); ++i) {
                  const app::InputRange& one = self.model->ranges[static_cast<std::size_t>(i)];
                  ranges.row(i) << one.least, one.most;
                }
                return ranges;
              },
              "(inputs, 2) least and most of each.")
          .def_property_readonly(
              "signal_names", [](const ModelHandle& self) { return self.model->signal_names; },
              "Names of the columns of signals, with their units.")
          .def_property_readonly(
              "signals",
              [](const ModelHandle& self) {
                std::vector<std::tuple<std::string, std::string, std::string>> out;
                for (const app::SignalDefinition& s : signal_definitions(self.model->session))
                  out.emplace_back(s.name, s.unit, s.definition);
                return out;
              },
              "[(name, unit, what it is), ...].")
          .def_property_readonly(
              "state_size", [](const ModelHandle& self) { return self.state_size(); },
              "How many numbers Data.get_state gives.")
          .def("__copy__", [](const std::shared_ptr<ModelHandle>& self) { return self; })
          .def("__deepcopy__", [](const std::shared_ptr<ModelHandle>& self, const py::dict&) { return self; })
          .def("__repr__",
               [](const ModelHandle& self) {
                 std::string tools;
                 for (const ModelRecipe::Tool& tool : self.recipe.tools)
                   tools += (tools.empty() ? "" : ", ") + tool.name;
                 return fmt::format("<ostium.Model of {} with {}>", self.recipe.vessel->vessel->name, tools);
               })
          .def(py::pickle([](const ModelHandle& self) { return recipe_to_python(self); },
                          [](const py::tuple& recipe) { return from_python(recipe); }));
  pickle_in_every_protocol(bound);
}

}  // namespace ostium::python
