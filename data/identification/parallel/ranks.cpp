#include "data/identification/parallel/ranks.h"

#include <mpi.h>

#include <cstdlib>
#include <exception>
#include <numeric>

namespace ostium::data {

namespace {

bool initialised() {
  int yes = 0, over = 0;
  MPI_Initialized(&yes);
  MPI_Finalized(&over);
  return yes && !over;
}

/// Gathers every rank's numbers, in the order of the ranks.
std::vector<double> gathered(const std::vector<double>& mine, std::vector<int>& counts) {
  counts.resize(ranks());
  const int count = static_cast<int>(mine.size());
  MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
  std::vector<int> begins(counts.size(), 0);
  std::partial_sum(counts.begin(), counts.end() - 1, begins.begin() + 1);
  std::vector<double> all(begins.back() + counts.back());
  MPI_Allgatherv(mine.data(), count, MPI_DOUBLE, all.data(), counts.data(), begins.data(), MPI_DOUBLE, MPI_COMM_WORLD);
  return all;
}

}  // namespace

int rank() {
  int r = 0;
  if (initialised()) MPI_Comm_rank(MPI_COMM_WORLD, &r);
  return r;
}

int ranks() {
  int n = 1;
  if (initialised()) MPI_Comm_size(MPI_COMM_WORLD, &n);
  return n;
}

Ranks::Ranks() {
  // Variables set by Open MPI and other launchers; without mpirun there is nothing to initialise.
  if (std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE")) {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  }
}
Ranks::~Ranks() {
  // After an exception do not wait for the other ranks: mpirun sees this one exit and stops them.
  if (initialised() && std::uncaught_exceptions() == 0) MPI_Finalize();
}

bool on_any_rank(bool here) {
  int mine = here, any = 0;
  MPI_Allreduce(&mine, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return any;
}

void share(std::vector<std::vector<double>>& results) {
  std::vector<double> mine;
  for (std::size_t i = rank(); i < results.size(); i += ranks()) {
    mine.push_back(static_cast<double>(i));
    mine.push_back(static_cast<double>(results[i].size()));
    mine.insert(mine.end(), results[i].begin(), results[i].end());
  }
  std::vector<int> counts;
  const std::vector<double> all = gathered(mine, counts);
  for (std::size_t at = 0; at < all.size();) {
    const auto index = static_cast<std::size_t>(all[at]), length = static_cast<std::size_t>(all[at + 1]);
    results[index].assign(all.begin() + at + 2, all.begin() + at + 2 + length);
    at += 2 + length;
  }
}

}  // namespace ostium::data
