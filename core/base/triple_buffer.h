#pragma once
/// The newest value from one thread to another, without a lock: a triple buffer. What is not taken in time is replaced.
#include <array>
#include <atomic>
#include <cstdint>

namespace ostium::core {

/// One thread writes, one reads; none of it allocates unless copying or filling a T does.
template <class T>
class TripleBuffer {
 public:
  explicit TripleBuffer(const T& first = {}) : slots_{first, first, first} {}

  // --- of the thread that writes
  /// To fill in place before `publish`; holds some older value.
  T& back() { return slots_[writing_]; }
  void publish() {
    writing_ = between_.exchange(static_cast<std::uint8_t>(writing_ | fresh), std::memory_order_acq_rel) & slot;
  }
  void put(const T& value) { back() = value, publish(); }

  // --- of the thread that reads
  /// True if there is a newer value than at the last call; `front` is that value then.
  bool update() {
    if (!(between_.load(std::memory_order_relaxed) & fresh)) return false;
    reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & slot;
    return true;
  }
  const T& front() const { return slots_[reading_]; }
  /// The newest value; the same again if there is none since.
  const T& take() { return update(), front(); }

 private:
  static constexpr std::uint8_t slot = 3, fresh = 4;
  std::array<T, 3> slots_;
  std::uint8_t writing_ = 0, reading_ = 1;
  std::atomic<std::uint8_t> between_{2};
};

}  // namespace ostium::core
