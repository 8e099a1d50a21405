#include "app/python/binding/interpreter.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
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

namespace {

bool is_main_thread() {
  const pybind11::object main = pybind11::module_::import("threading").attr("main_thread")();
  return main.attr("ident").cast<unsigned long>() == PyThread_get_thread_ident();
}

}  // namespace

void run_until_interrupted(const std::function<void(const std::function<bool()>& stop)>& work) {
  using namespace std::chrono_literals;
  const bool is_told = is_main_thread();
  std::atomic<bool> stopped{false};
  std::exception_ptr failed;
  {
    const OthersRun others_run;
    std::future<void> done = std::async(std::launch::async, [&] { work([&] { return stopped.load(); }); });
    while (is_told && !stopped && done.wait_for(20ms) != std::future_status::ready) {
      if (Py_IsFinalizing()) continue;
      const pybind11::gil_scoped_acquire lock;
      stopped = PyErr_CheckSignals() != 0;
    }
    try {
      done.get();
    } catch (...) {
      failed = std::current_exception();
    }
  }
  if (PyErr_Occurred()) throw pybind11::error_already_set();
  if (failed) std::rethrow_exception(failed);
}

}  // namespace ostium::python
