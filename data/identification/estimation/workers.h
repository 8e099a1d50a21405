#pragma once
/// Independent jobs spread over the threads of a machine and, under mpirun, over ranks. Every rank runs the same fit
/// and has the same results, bit for bit; only the jobs are shared out.
#include <cstddef>
#include <functional>
#include <vector>

namespace ostium::data {

class Workers {
 public:
  using Job = std::function<std::vector<double>(std::size_t)>;

  /// `threads` per rank; 0: one for each core.
  explicit Workers(int threads = 0);

  /// job(0), ..., job(count - 1), in this order, whoever does them. What a job throws is thrown here.
  std::vector<std::vector<double>> map(std::size_t count, const Job& job) const;

  int threads() const { return threads_; }

 private:
  int threads_;
};

/// The ranks of mpirun, for as long as this lives: one without it. Made once, in main.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
};
int rank();
int ranks();

}  // namespace ostium::data
