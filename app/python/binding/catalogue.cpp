#include "data/catalogue/catalogue.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "app/python/binding/bindings.h"
#include "data/catalogue/case/case.h"
#include "data/catalogue/script/script.h"
#include "fluoro/projection/views.h"

namespace ostium::python {

namespace {

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

}  // namespace

void bind_catalogue(pybind11::module_& module) {
  module.def(
      "cases", [] { return names_of(data::load_cases()); }, "Names that Vessel knows.");
  module.def(
      "instruments", [] { return names_of(data::load_catalogue()); }, "Names that Model's tools know.");
  module.def(
      "scripts", [] { return names_of(data::load_scripts()); }, "Names that run_script knows.");
  module.def(
      "views", [] { return names_of(fluoro::standard_views()); }, "Names that Imager knows.");
}

}  // namespace ostium::python
