#pragma once
/// Distributes independent jobs over the machine's threads and, under mpirun, over ranks. Every rank runs the same fit
/// and has the same results, bit for bit; only the jobs are shared.
#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

#include "data/identification/parallel/ranks.h"

namespace ostium::data {

/// Thrown out of a fit that is not to go on: neither a mistake nor a model without shapes.
struct Ended : std::exception {
  const char* what() const noexcept override { return "ended before it was done"; }
};

class Workers {
 public:
  using Job = std::function<std::vector<double>(std::size_t)>;

  /// `threads` per rank; 0: one per core. `before_each`: called before each job, in its thread; may throw.
  explicit Workers(int threads = 0, std::function<void()> before_each = {});

  /// Results of job(0), ..., job(count - 1) in this order, wherever they ran. Rethrows a job's exception.
  std::vector<std::vector<double>> map(std::size_t count, const Job& job) const;

  int threads() const { return threads_; }

 private:
  int threads_;
  std::function<void()> before_each_;
};

}  // namespace ostium::data
