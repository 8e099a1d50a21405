#pragma once
/// What each file adds to the module.
#include <pybind11/pybind11.h>

namespace ostium::python {

void bind_vessel(pybind11::module_& module);
void bind_model(pybind11::module_& module);
void bind_data(pybind11::module_& module);
void bind_batch(pybind11::module_& module);
void bind_imager(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_script(pybind11::module_& module);
void bind_catalogue(pybind11::module_& module);
void bind_explain(pybind11::module_& module);

}  // namespace ostium::python
