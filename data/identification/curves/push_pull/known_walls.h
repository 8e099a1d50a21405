#pragma once
/// Wall forces of a wire in its paths, remembered: a fit asks for the same again and again.
///
/// They depend on path, insertion, clearance and ratios of stiffness, and are proportional to the stiffness itself. A
/// wire of a ratio that is new begins from the touches that it had at the same insertion before.
#include <deque>
#include <map>
#include <unordered_map>

#include "data/identification/curves/push_pull/channel_beam.h"

namespace ostium::data::push_pull {

/// One place where it presses.
struct Press {
  double turned_rad = 0;     ///< by how much the path turns from the entrance to there
  double per_stiffness = 0;  ///< force over the stiffness of the last piece, 1/m2
};

/// From the entrance on.
struct Pressing {
  std::vector<Press> places;
  double turned_rad = 0;  ///< up to the tip
};

/// Angle by which bends turn from the entrance to a place.
double turned(const std::vector<Bend>& bends, double at_m);

class KnownWalls {
 public:
  /// What is known of one path, clearance and set of ratios. Valid until many others were asked for.
  class Shape {
   public:
    const Pressing& at(double inserted_m);

   private:
    friend class KnownWalls;
    KnownWalls* all;
    std::vector<double> key;
    std::size_t path;
    double clearance_m;
    std::vector<StiffPiece> stiffness;
    std::unordered_map<double, Pressing> pressing;  ///< by insertion
  };

  /// A path's number; one that has the same bends and clearance is the same. `clearance_m` is that declared, by which
  /// places where the wire may touch are spaced: a third of sqrt(R c) apart.
  std::size_t path(const std::vector<Bend>& bends, double clearance_m);
  double spacing_m(std::size_t path) const { return paths_[path].spacing_m; }
  Shape& shape(std::size_t path, double clearance_m, const std::vector<StiffPiece>& stiffness);

 private:
  struct Path {
    std::vector<Bend> bends;
    double clearance_m, spacing_m;
    ChannelBeam beam;
    std::map<double, std::vector<Touch>> touches;  ///< by insertion: those of the shape before
  };

  std::vector<Path> paths_;
  std::deque<Shape> shapes_;  ///< the last ones that were asked for
};

}  // namespace ostium::data::push_pull
