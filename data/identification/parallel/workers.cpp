#include "data/identification/parallel/workers.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace ostium::data {

Workers::Workers(int threads, std::function<void()> before_each)
    : threads_(threads > 0 ? threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks())),
      before_each_(std::move(before_each)) {}

std::vector<std::vector<double>> Workers::map(std::size_t count, const Job& job) const {
  std::vector<std::vector<double>> results(count);
  const std::size_t first = rank(), step = ranks();
  std::atomic<std::size_t> next = 0;
  std::exception_ptr thrown;
  std::mutex throwing;
  const auto work = [&] {
    for (std::size_t k = next++; first + k * step < count; k = next++) try {
        if (before_each_) before_each_();
        results[first + k * step] = job(first + k * step);
      } catch (...) {
        const std::lock_guard lock(throwing);
        thrown = std::current_exception();
      }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t jobs = first < count ? (count - first + step - 1) / step : 0;
    for (std::size_t t = 1; t < std::min<std::size_t>(threads_, jobs); ++t) helpers.emplace_back(work);
    work();
  }
  if (step > 1) {
    const bool failed = thrown != nullptr, any = on_any_rank(failed);
    if (any && !failed) throw std::runtime_error("another rank failed; see its message");
    if (!any) share(results);
  }
  if (thrown) std::rethrow_exception(thrown);
  return results;
}

}  // namespace ostium::data
