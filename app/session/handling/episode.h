#pragma once
/// Tracks how long a condition has held, and when it is a new error.

namespace ostium::app {

/// One event per episode: a recurrence within 3 s of the end belongs to the same episode.
class Episode {
 public:
  /// True when an episode begins.
  bool begins(bool holds, double time_s) {
    if (!holds) return false;
    const bool is_new = time_s - last_s_ > again_after_s;
    last_s_ = time_s;
    return is_new;
  }

 private:
  static constexpr double again_after_s = 3;
  double last_s_ = -1e9;
};

/// How long a condition has held without interruption.
class Held {
 public:
  double seconds(bool holds, double time_s) {
    if (!holds || since_s_ < 0) since_s_ = holds ? time_s : -1;
    return holds ? time_s - since_s_ : 0;
  }

 private:
  double since_s_ = -1;
};

/// An episode of a condition that has held for some time.
class HeldEpisode {
 public:
  bool begins(bool holds, double for_s, double time_s) {
    return episode_.begins(held_.seconds(holds, time_s) > for_s, time_s);
  }

 private:
  Held held_;
  Episode episode_;
};

}  // namespace ostium::app
