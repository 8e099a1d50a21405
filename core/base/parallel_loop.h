#pragma once
/// Loops over independent items on all cores. For loading; a step runs on one thread.
#include <algorithm>
#include <future>
#include <thread>
#include <vector>

namespace ostium::core {

/// Calls work(begin, end) for parts of [0, n) in parallel and returns when all are done. The result does not depend on
/// the number of parts as long as no part touches what another one writes.
template <class Work>
void in_parallel(std::size_t n, Work&& work) {
  const std::size_t parts =
      std::clamp<std::size_t>(std::min<std::size_t>(std::thread::hardware_concurrency(), n), 1, 8);
  std::vector<std::future<void>> others;
  for (std::size_t k = 1; k < parts; ++k)
    others.push_back(std::async(std::launch::async, [&, k] { work(n * k / parts, n * (k + 1) / parts); }));
  work(0, n / parts);
  for (std::future<void>& other : others) other.get();
}

}  // namespace ostium::core
