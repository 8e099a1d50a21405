#pragma once
/// Many sessions of one model, stepped side by side.
#include <functional>
#include <vector>

#include "app/python/binding/data.h"

namespace ostium::python {

class BatchHandle : public MadeByInit {
 public:
  BatchHandle(std::shared_ptr<const ModelHandle> of, std::size_t num, int most_threads);

  const std::shared_ptr<const ModelHandle> model;
  const int threads;
  std::vector<std::unique_ptr<app::FreeRun>> runs;
  // One block each, row by row: (num, ...).
  std::vector<double> inputs;
  std::vector<float> signals;
  std::vector<double> tips;                    ///< (num, tools, 3)
  std::vector<app::ToolForces> forces, peaks;  ///< (num, tools)
  std::vector<std::uint32_t> trouble;
  mutable std::atomic<bool> used{false};

  /// Throws std::invalid_argument, and steps none, if an input of one that is stepped is out of its range.
  /// After Ctrl-C some have come less far than others.
  void step(int count, const bool* mask, const std::function<bool()>& stop);
  void reset(std::size_t i, std::uint64_t seed);
  void set_state(std::size_t i, const double* numbers);

 private:
  void gather(std::size_t i);
};

}  // namespace ostium::python
