#pragma once
/// numpy arrays over memory that an object of ours keeps.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <optional>
#include <vector>

namespace ostium::python {

namespace py = pybind11;

/// A view of `memory`, of that shape, row by row; `owner` lives as long as it does.
template <class T>
py::array_t<T> view_of(T* memory, std::vector<py::ssize_t> shape, const py::object& owner) {
  return py::array_t<T>(std::move(shape), memory, owner);
}

/// The same, which Python may not write to.
template <class T>
py::array_t<T> read_only(py::array_t<T> array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

/// An array of Python's own with a copy of these numbers.
template <class T>
py::array_t<T> copy_of(const std::vector<T>& numbers) {
  return py::array_t<T>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

/// Any array-like of real numbers as doubles in C order; text and complex numbers are refused, where numpy would read
/// the one and cut the other.
class [[gnu::visibility("hidden")]] Doubles : public py::array_t<double, py::array::c_style | py::array::forcecast> {
 public:
  using array_t::array_t;
  static std::optional<Doubles> of(py::handle numbers);
};

/// Throws ValueError: "inputs has shape (3, 4); expected (any, 12): (steps, inputs)". -1: any length.
void require_shape(const py::array& array, const std::vector<py::ssize_t>& shape, const char* name,
                   const char* expected);

}  // namespace ostium::python

template <>
struct pybind11::detail::type_caster<ostium::python::Doubles> {
  PYBIND11_TYPE_CASTER(ostium::python::Doubles, const_name("numpy.ndarray[numpy.float64]"));

  bool load(handle from, bool) {
    const auto found = ostium::python::Doubles::of(from);
    if (found) value = *found;
    return found.has_value();
  }
};
