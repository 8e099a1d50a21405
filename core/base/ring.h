#pragma once
/// A queue from one thread to another, without a lock.
#include <array>
#include <atomic>
#include <optional>

namespace ostium::core {

/// One thread puts, one takes; neither waits, neither allocates unless copying a T does.
template <class T, unsigned room>
class Ring {
 public:
  /// False, and nothing is put, where room - 1 wait already.
  bool put(const T& value) {
    const unsigned at = put_.load(std::memory_order_relaxed);
    if (at - taken_.load(std::memory_order_acquire) >= room - 1) return false;
    queue_[at % room] = value;
    put_.store(at + 1, std::memory_order_release);
    return true;
  }
  std::optional<T> next() {
    const unsigned at = taken_.load(std::memory_order_relaxed);
    if (at == put_.load(std::memory_order_acquire)) return std::nullopt;
    const T value = queue_[at % room];
    taken_.store(at + 1, std::memory_order_release);
    return value;
  }

 private:
  static_assert((room & (room - 1)) == 0, "a power of two, so that counts may overflow");
  std::array<T, room> queue_{};
  std::atomic<unsigned> put_{0}, taken_{0};
};

}  // namespace ostium::core
