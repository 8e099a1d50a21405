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
    std::string over;              ///< as in SessionTool
  };
  std::vector<Tool> tools;  ///< outermost first
  struct DrugFile {
    std::string file, text;
  };
  std::vector<DrugFile> drugs;  ///< those of the catalogue, as `ostium run` has them
  app::SessionOptions options;  ///< but for the drugs
};

class ModelHandle : public MadeByInit {
 public:
  /// Throws LoadError.
  explicit ModelHandle(ModelRecipe from);
  const ModelRecipe recipe;
  const std::shared_ptr<const app::FreeRunModel> model;
  /// Of all that a state depends on: a whole number below 2^53.
  const double fingerprint;

  /// The tool of a name. Throws ValueError naming all.
  int tool(const std::string& name) const;
  /// A state outside begins with the model's fingerprint and a checksum: the engine trusts what it is given, and
  /// numbers that somebody changed might lead it anywhere.
  static constexpr std::size_t head = 2;
  std::size_t state_size() const { return head + model->state_count(); }
  /// `numbers`: state_size.
  void put_state(const app::SessionState& state, double* numbers) const;
  /// The numbers after the head. Throws ValueError for the state of another model, or one that was changed.
  const double* state_of(const double* numbers, std::size_t count) const;
};

}  // namespace ostium::python
