/// The module `_ostium`: what Python calls of the engine. The package `ostium` beside it is what people import.
#include <pybind11/pybind11.h>

#include <filesystem>
#include <string_view>

#include "app/python/binding/bindings.h"
#include "app/python/binding/interpreter.h"
#include "app/reader/read_apart.h"
#include "data/catalogue/catalogue.h"
#include "data/formats/load_error.h"
#include "data/formats/write_file.h"
#include "vascular/geometry/mesh/mesh.h"
#include "vascular/geometry/mesh_files/raw_surface.h"

namespace py = pybind11;

namespace {

/// Bad input as ostium.OstiumError, which knows file and line from the message; half-made objects as TypeError.
void raise_as_ostium_error(std::exception_ptr thrown) {  // NOLINT(performance-unnecessary-value-param): so pybind11
  const auto raise = [](const std::exception& error) {
    const py::object type = py::module_::import("ostium.errors").attr("OstiumError");
    PyErr_SetString(type.ptr(), error.what());
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const ostium::data::LoadError& error) {
    raise(error);
  } catch (const ostium::data::WriteError& error) {
    raise(error);
  } catch (const ostium::vascular::MeshError& error) {
    raise(error);
  } catch (const std::filesystem::filesystem_error& error) {
    raise(error);
  } catch (const py::cast_error& error) {
    // So pybind11 calls an object without __init__ where it is handed over, as a model to an imager.
    if (std::string_view(error.what()).find("non-held") == std::string_view::npos) throw;
    PyErr_SetString(PyExc_TypeError, ostium::python::made_without_init);
  }
}

}  // namespace

PYBIND11_MODULE(_ostium, module) {
  module.doc() = "The engine of Ostium; import ostium instead.";
  module.attr("__version__") = OSTIUM_VERSION;
  py::register_exception_translator(raise_as_ostium_error);
  // Files of others are read by a program of its own, whose end is not that of the interpreter.
  ostium::vascular::read_meshes_with(ostium::app::read_surface_apart);
  module.def("set_folders", [](const std::string& data, const std::string& reader) {
    ostium::data::set_data_folder(data);
    ostium::app::set_reader(reader);
  });
  ostium::python::bind_vessel(module);
  ostium::python::bind_model(module);
  ostium::python::bind_data(module);
  ostium::python::bind_batch(module);
  ostium::python::bind_imager(module);
  ostium::python::bind_recording(module);
  ostium::python::bind_script(module);
  ostium::python::bind_catalogue(module);
  ostium::python::bind_explain(module);
}
