#pragma once
/// What the interpreter asks of those who leave its lock, and of objects that Python makes.
#include <pybind11/pybind11.h>

#include <cstddef>
#include <string>

namespace ostium::python {

/// Lets other Python threads run, for as long as this lives. As the interpreter ends, a thread that comes back stands
/// still instead: it must not run on, and to unwind it would end the process.
class OthersRun {
 public:
  OthersRun() : mine_(PyEval_SaveThread()) {}
  ~OthersRun();
  OthersRun(const OthersRun&) = delete;

 private:
  PyThreadState* mine_;
};

/// Whether somebody pressed Ctrl-C; only the main thread is told. For code without the interpreter's lock.
bool interrupted();
/// Throws KeyboardInterrupt if so, after `interrupted` was true. With the lock.
void raise_if_interrupted();

/// Base of classes that only their __init__ makes. pybind11 would hand out raw memory for what CLASS.__new__ alone
/// made.
struct MadeByInit {
  static void* operator new(std::size_t) {
    throw pybind11::type_error("this object was made without __init__, and cannot be used");
  }
  static void operator delete(void*) {}
};

/// __getstate__ and __setstate__ for every protocol of pickle; by itself pybind11 ends the process at 0 and 1.
template <class Class>
void pickle_in_every_protocol(Class& of) {
  of.def("__reduce_ex__", [](const pybind11::object& self, int) {
    return pybind11::make_tuple(pybind11::module_::import("copyreg").attr("__newobj__"),
                                pybind11::make_tuple(pybind11::type::of(self)), self.attr("__getstate__")());
  });
}
template <class Class>
void refuse_to_pickle(Class& of) {
  of.def("__reduce_ex__", [](const pybind11::object& self, int) -> pybind11::object {
    const auto name = pybind11::type::of(self).attr("__name__").template cast<std::string>();
    throw pybind11::type_error(name + " cannot be pickled or copied; make one where it is needed");
  });
}

}  // namespace ostium::python
