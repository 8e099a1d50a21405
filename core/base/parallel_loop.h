#pragma once
/// Loops over independent items on all cores. For loading; a step runs on one thread.
///
/// The caller waits instead of taking a part: Linux puts a new thread on its maker's core, and moves it to an idle one
/// only some milliseconds later if the maker goes on (10 ms of work on two cores took 13 to 17).
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
  if (parts == 1) return work(0, n);
  std::vector<std::future<void>> each;
  for (std::size_t k = 0; k < parts; ++k)
    each.push_back(std::async(std::launch::async, [&, k] { work(n * k / parts, n * (k + 1) / parts); }));
  for (std::future<void>& one : each) one.get();
}

/// Calls work(i) for each i < n on at most `threads` threads, the next i whenever one is free: for items that take
/// different times. Throws the first exception once all threads have ended.
template <class Work>
void for_each_on(int threads, std::size_t n, Work&& work) {
  std::atomic<std::size_t> next{0};
  const auto take = [&] {
    for (std::size_t i; (i = next.fetch_add(1)) < n;) work(i);
  };
  const std::size_t many = std::min(static_cast<std::size_t>(std::max(threads, 1)), n);
  if (many <= 1) return take();
  std::vector<std::future<void>> each;
  for (std::size_t k = 0; k < many; ++k) each.push_back(std::async(std::launch::async, take));
  std::exception_ptr failed;
  for (std::future<void>& one : each) {
    try {
      one.get();
    } catch (...) {
      if (!failed) failed = std::current_exception();
    }
  }
  if (failed) std::rethrow_exception(failed);
}

}  // namespace ostium::core
