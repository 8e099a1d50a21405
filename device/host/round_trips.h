#pragma once
/// Time until the box acknowledges an OUT report: percentiles without storing every value.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "device/host/tracking_box.h"

namespace ostium::device {

class RoundTrips {
 public:
  /// Adds the newest round trip of a snapshot, once.
  void add(const RoundTrip& newest) {
    if (newest.count == counted_) return;
    counted_ = newest.count;
    const double bin = std::log(std::max(newest.last_s, least_s) / least_s) / step;
    ++bins_[static_cast<std::size_t>(std::min(bin, static_cast<double>(bins_.size() - 1)))];
    ++all_;
  }
  std::uint64_t count() const { return all_; }

  double percentile_s(double share) const {
    auto left = static_cast<std::int64_t>(share * static_cast<double>(all_));
    for (std::size_t b = 0; b < bins_.size() && all_; ++b)
      if ((left -= static_cast<std::int64_t>(bins_[b])) < 0)
        return least_s * std::exp((static_cast<double>(b) + 0.5) * step);
    return 0;
  }

 private:
  static constexpr double least_s = 1e-5, step = 0.02;  // bins of 2 %, up to 30 s
  std::array<std::uint64_t, 750> bins_{};
  std::uint64_t all_ = 0, counted_ = 0;
};

}  // namespace ostium::device
