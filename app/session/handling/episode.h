#pragma once
/// How long something has held, and when it is a new error.

namespace ostium::app {

/// One event an episode: what comes again within 3 s of its end is the same one.
class Episode {
 public:
  /// True as one begins.
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

/// For how long something has held without a break.
class Held {
 public:
  double seconds(bool holds, double time_s) {
    if (!holds || since_s_ < 0) since_s_ = holds ? time_s : -1;
    return holds ? time_s - since_s_ : 0;
  }

 private:
  double since_s_ = -1;
};

/// An episode of what has held for some time.
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
