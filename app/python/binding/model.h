#pragma once
/// A model with what it was made from.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/python/binding/vessel.h"
#include "app/session/run/free_run.h"

namespace ostium::python {

struct ModelRecipe {
  std::shared_ptr<const VesselHandle> vessel;
  struct Tool {
    std::string name, file, text;  ///< the instrument's file, and what it held
  };
  std::vector<Tool> tools;  ///< outermost first
  app::SessionOptions options;
};

class ModelHandle {
 public:
  /// Throws LoadError.
  explicit ModelHandle(ModelRecipe from);
  const ModelRecipe recipe;
  const std::shared_ptr<const app::FreeRunModel> model;
  /// Of all that a state depends on: a whole number below 2^53, the first number of a state outside.
  const double fingerprint;

  /// The tool of a name. Throws ValueError naming all.
  int tool(const std::string& name) const;
  std::size_t state_size() const { return 1 + model->state_count(); }
  /// `numbers`: state_size.
  void put_state(const app::SessionState& state, double* numbers) const;
  /// Throws ValueError for the state of another model.
  const double* state_of(const double* numbers, std::size_t count) const;
};

}  // namespace ostium::python
