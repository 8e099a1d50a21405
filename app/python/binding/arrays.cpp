#include "app/python/binding/arrays.h"

#include <string>
#include <string_view>

namespace ostium::python {

std::optional<Doubles> Doubles::of(py::handle numbers) {
  const auto array = py::array::ensure(numbers);
  if (!array || std::string_view("biuf").find(array.dtype().kind()) == std::string_view::npos) return std::nullopt;
  const auto doubles = array_t::ensure(array);
  if (!doubles) return std::nullopt;
  Doubles out;
  static_cast<array_t&>(out) = doubles;
  return out;
}

namespace {

/// As Python writes it: "(3,)", "(3, any)".
template <class Length>
std::string tuple_of(py::ssize_t count, const Length& length) {
  std::string out = "(";
  for (py::ssize_t i = 0; i < count; ++i) {
    const py::ssize_t n = length(i);
    out += (i ? ", " : "") + (n < 0 ? "any" : std::to_string(n));
  }
  return out + (count == 1 ? ",)" : ")");
}

}  // namespace

void require_shape(const py::array& array, const std::vector<py::ssize_t>& shape, const char* name,
                   const char* expected) {
  bool same = array.ndim() == static_cast<py::ssize_t>(shape.size());
  for (std::size_t i = 0; same && i < shape.size(); ++i)
    same = shape[i] < 0 || array.shape(static_cast<py::ssize_t>(i)) == shape[i];
  if (same) return;
  const auto rank = static_cast<py::ssize_t>(shape.size());
  throw py::value_error(std::string(name) + " has shape " +
                        tuple_of(array.ndim(), [&](py::ssize_t i) { return array.shape(i); }) + "; expected " +
                        tuple_of(rank, [&](py::ssize_t i) { return shape[static_cast<std::size_t>(i)]; }) + ": " +
                        expected);
}

}  // namespace ostium::python
