#pragma once
/// Passes the newest value from one thread to another without a lock. A value that is not taken in time is overwritten.
#include <array>
#include <atomic>
#include <cstdint>

namespace ostium::core {

/// One writer, one reader. T is copied; put and take do not allocate if copying T does not.
template <class T>
class TripleBuffer {
 public:
  explicit TripleBuffer(const T& first = {}) : slots_{first, first, first} {}

  void put(const T& value) {
    slots_[writing_] = value;
    writing_ = between_.exchange(static_cast<std::uint8_t>(writing_ | fresh), std::memory_order_acq_rel) & place;
  }

  /// The newest value; the same again if there is no newer one.
  const T& take() {
    if (between_.load(std::memory_order_relaxed) & fresh)
      reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & place;
    return slots_[reading_];
  }

 private:
  static constexpr std::uint8_t place = 3, fresh = 4;
  std::array<T, 3> slots_;
  std::uint8_t writing_ = 0, reading_ = 1;
  std::atomic<std::uint8_t> between_{2};
};

}  // namespace ostium::core
