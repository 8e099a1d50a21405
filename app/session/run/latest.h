#pragma once
/// The newest of what one thread makes, for one other that looks when it can: three places, handed over without a lock.
/// What nobody looked at in time is lost, and only that.
#include <array>
#include <atomic>

namespace ostium::app {

template <class T>
class Latest {
 public:
  explicit Latest(const T& like) : places_{like, like, like} {}

  // --- of the thread that makes
  T& to_fill() { return places_[making_]; }
  void publish() { making_ = middle_.exchange(making_ | is_new, std::memory_order_acq_rel) & which; }

  // --- of the one that looks
  /// Whether there is a newer one than at the last call; then `seen` is that.
  bool look() {
    if (!(middle_.load(std::memory_order_relaxed) & is_new)) return false;
    looking_ = middle_.exchange(looking_, std::memory_order_acq_rel) & which;
    return true;
  }
  const T& seen() const { return places_[looking_]; }

 private:
  static constexpr unsigned which = 3, is_new = 4;
  std::array<T, 3> places_;
  unsigned making_ = 0, looking_ = 2;
  std::atomic<unsigned> middle_{1};
};

}  // namespace ostium::app
