#pragma once
/// What the interpreter asks of those who leave its lock, and of objects that Python makes.
#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>
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

/// Runs work(stop) on another thread; this one lets other Python threads run and listens for Ctrl-C, of which Python
/// tells its main thread alone. Once somebody pressed it, stop() is true on every thread that work uses, and
/// KeyboardInterrupt is thrown when work returns. Else throws what work threw. With the interpreter's lock.
void run_until_interrupted(const std::function<void(const std::function<bool()>& stop)>& work);

/// What is said of an object that CLASS.__new__ alone made.
inline constexpr const char* made_without_init = "this object was made without __init__, and cannot be used";

/// Base of classes that only their __init__ makes. pybind11 would hand out raw memory for what CLASS.__new__ alone
/// made.
struct MadeByInit {
  static void* operator new(std::size_t) { throw pybind11::type_error(made_without_init); }
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
