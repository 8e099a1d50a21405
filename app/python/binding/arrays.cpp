#include "app/python/binding/arrays.h"

#include <string>

namespace ostium::python {

void require_shape(const py::array& array, const std::vector<py::ssize_t>& shape, const char* name,
                   const char* expected) {
  bool same = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t i = 0; same && i < shape.size(); ++i)
    same = shape[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == shape[i];
  if (same) return;
  std::string of = "(", wanted = "(";
  for (py::ssize_t i = 0; i < array.ndim(); ++i) of += std::to_string(array.shape(i)) + ", ";
  for (py::ssize_t length : shape) wanted += (length < 0 ? "any" : std::to_string(length)) + ", ";
  throw py::value_error(std::string(name) + " has shape " + of + "); expected " + wanted + "): " + expected);
}

}  // namespace ostium::python
