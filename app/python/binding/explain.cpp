#include "data/identification/selection/explain.h"

#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <optional>
#include <sstream>

#include "app/python/binding/bindings.h"
#include "app/python/binding/data.h"
#include "data/identification/curves/curve_explanation.h"
#include "data/identification/curves/curve_report.h"
#include "data/identification/curves/kinds.h"
#include "data/identification/curves/set/run_table.h"
#include "data/identification/measurement/measurement_reader.h"
#include "data/identification/report/explanation_report.h"

namespace ostium::python {

namespace py = pybind11;

namespace {

/// "a+b" as a and b together.
std::vector<std::vector<std::string>> together(const std::vector<std::string>& tries) {
  std::vector<std::vector<std::string>> out;
  for (const std::string& words : tries) {
    std::istringstream parts(words);
    out.emplace_back();
    for (std::string part; std::getline(parts, part, '+');) out.back().push_back(part);
  }
  return out;
}

/// explanation.json.
std::string explanation_of(const std::string& path, const std::vector<std::string>& tries, int threads,
                           const std::function<bool()>& stop) {
  const data::JsonValue root = data::load_json(data::measurement_file(path));
  if (data::curves::kind_of(root)) {
    data::curves::CurveOptions options;
    options.tries = together(tries);
    options.stop = stop;
    return to_json(data::curves::explain_curves(data::curves::with_tables(root), options));
  }
  data::ExplainOptions options;
  options.threads = threads, options.library = tries.empty();
  options.tries = together(tries);
  options.stop = stop;
  return to_json(explain(data::load_measurement(path), options));
}

}  // namespace

void bind_explain(py::module_& module) {
  module.def(
      "explain",
      [](const std::filesystem::path& set, const std::vector<std::string>& tries, std::optional<int> threads) {
        if (threads && *threads < 1) throw py::value_error(fmt::format("threads is {}; expected 1 or more", *threads));
        std::string text;
        run_until_interrupted([&](const std::function<bool()>& stop) {
          text = explanation_of(set.string(), tries, threads.value_or(0), stop);
        });
        return py::module_::import("json").attr("loads")(text);
      },
      py::arg("set"), py::arg("tries") = std::vector<std::string>{}, py::arg("threads") = py::none(),
      R"(Fits a measured set, and names the effect that the model lacks; as `ostium explain --json`.

set      its folder, or its measurement.json
tries    effects to switch on ("shaft_torsion", "a+b": both together); none: the library is searched where it does not fit
threads  None: all cores
Returns explanation.json as a dict: verdict, parameters, errors before and after. Raises OstiumError.)");
}

}  // namespace ostium::python
