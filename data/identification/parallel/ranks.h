#pragma once
/// The processes that mpirun started together. Without MPI in the build (OSTIUM_MPI) there is always one.
#include <vector>

namespace ostium::data {

/// MPI for the lifetime of this object; a single rank without mpirun. Create one in main.
class Ranks {
 public:
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
};
int rank();
int ranks();
/// Whether it is so on any of them; all have to ask.
bool on_any_rank(bool here);
/// Sends the results that each rank has, every ranks()th from its own number on, to the others.
void share(std::vector<std::vector<double>>& results);

}  // namespace ostium::data
