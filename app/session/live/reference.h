#pragma once
/// The frozen picture beside the live one: what the operator chose, or else the frame of the last cine run in which
/// most contrast was seen. A run in which none could be seen leaves it as it was.
#include "app/session/coupling/coupling.h"
#include "fluoro/display/display.h"

namespace ostium::app {

class Reference {
 public:
  /// After each frame; `seen`: contrast behind the lesion, as a share of undiluted contrast; not a number: none.
  void take(const fluoro::Picture& picture, bool cine, double seen, double second) {
    if (cine && seen >= visible_share && seen > most_seen_) best_ = picture, most_seen_ = seen;
    if (cine || best_.grey.empty()) return;
    if (!chosen_) frozen_ = best_, frozen_s_ = second, ++changes_;
    best_ = {}, most_seen_ = 0;
  }
  /// By the operator, from now on.
  void freeze(const fluoro::Picture& picture, double second) {
    frozen_ = picture, frozen_s_ = second, chosen_ = true, ++changes_;
  }
  /// The run has gone back to that second: what was taken later is of a time that is given up.
  void forget_after(double second) {
    best_ = {}, most_seen_ = 0;
    if (frozen_s_ > second) frozen_ = {}, chosen_ = false, frozen_s_ = 0;
  }
  /// Null: there is none yet.
  const fluoro::Picture* picture() const { return frozen_.grey.empty() ? nullptr : &frozen_; }
  int changes() const { return changes_; }

 private:
  static constexpr double visible_share = visible_kg_m3 / undiluted_kg_m3;
  fluoro::Picture frozen_, best_;
  double most_seen_ = 0, frozen_s_ = 0;
  bool chosen_ = false;
  int changes_ = 0;
};

}  // namespace ostium::app
