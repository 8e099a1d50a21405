#pragma once
/// Loops over independent items on all cores. For loading; a step runs on one thread.
#include <algorithm>
#include <atomic>
#include <exception>
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

/// Calls work(i) for each i < n on at most `threads` threads, the next i whenever one is free: for items that take
/// different times. Throws the first exception once all threads have ended.
template <class Work>
void for_each_on(int threads, std::size_t n, Work&& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i; (i = next.fetch_add(1)) < n;) work(i);
  };
  std::vector<std::future<void>> others;
  for (std::size_t k = 1; k < std::min(static_cast<std::size_t>(std::max(threads, 1)), n); ++k)
    others.push_back(std::async(std::launch::async, take));
  std::exception_ptr failed;
  const auto guarded = [&](auto&& run) {
    try {
      run();
    } catch (...) {
      if (!failed) failed = std::current_exception();
    }
  };
  guarded(take);
  for (std::future<void>& other : others) guarded([&] { other.get(); });
  if (failed) std::rethrow_exception(failed);
}

}  // namespace ostium::core
