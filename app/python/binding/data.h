#pragma once
/// One session of a model, for Python.
#include <atomic>
#include <functional>

#include "app/python/binding/model.h"

namespace ostium::python {

/// Marks an object as in use, for as long as this lives. Throws RuntimeError if another thread has it.
class InUse {
 public:
  InUse(std::atomic<bool>& mark, const char* what);
  ~InUse() { mark_ = false; }
  InUse(const InUse&) = delete;

 private:
  std::atomic<bool>& mark_;
};

struct DataHandle : MadeByInit {
  explicit DataHandle(std::shared_ptr<const ModelHandle> of) : model(std::move(of)), run(model->model) {}
  DataHandle(std::shared_ptr<const ModelHandle> of, const app::FreeRun& from) : model(std::move(of)), run(from) {}
  DataHandle(const DataHandle& other) : model(other.model), run(other.run) {}

  const std::shared_ptr<const ModelHandle> model;
  app::FreeRun run;
  mutable std::atomic<bool> used{false};
};

/// Nodes of a tool in the body, base to tip: a view of the state's own numbers.
pybind11::object nodes_of(const ModelHandle& model, app::SessionState& state, const std::string& tool,
                          const pybind11::object& owner);
/// Number of steps of a call: 1 to a day. Throws ValueError.
int require_steps(long long n);
/// work(stop) of `count` steps; Ctrl-C ends it (run_until_interrupted) where it is long enough for it to be asked for.
void run_steps(int count, const std::function<void(const std::function<bool()>& stop)>& work);

}  // namespace ostium::python
