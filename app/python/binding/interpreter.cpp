#include "app/python/binding/interpreter.h"

#include <chrono>
#include <thread>

// In 3.13 it lost its underscore.
#if PY_VERSION_HEX < 0x030D0000
#define Py_IsFinalizing _Py_IsFinalizing
#endif

namespace ostium::python {

OthersRun::~OthersRun() {
  while (Py_IsFinalizing()) std::this_thread::sleep_for(std::chrono::hours(1));
  PyEval_RestoreThread(mine_);
}

bool interrupted() {
  static const std::thread::id main = [] {
    const pybind11::gil_scoped_acquire lock;
    return std::this_thread::get_id();
  }();
  if (std::this_thread::get_id() != main || Py_IsFinalizing()) return false;
  const pybind11::gil_scoped_acquire lock;
  return PyErr_CheckSignals() != 0;
}

void raise_if_interrupted() {
  if (PyErr_Occurred()) throw pybind11::error_already_set();
}

}  // namespace ostium::python
