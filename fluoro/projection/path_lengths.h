#pragma once
/// How much of what each ray goes through: the sum of exit minus entry depths of every closed surface, per attenuator.
#include <memory>
#include <span>

#include "fluoro/base/plane.h"
#include "fluoro/matter/scene.h"
#include "fluoro/projection/c_arm.h"

namespace ostium::fluoro {

/// Where the picture is taken from, and on how many pixels.
struct View {
  CArm arm;
  double field_m = 0.2;  ///< side of the square that the detector shows
  int pixels = 512;      ///< along it
  bool operator==(const View&) const = default;
};

/// Length of the part of a pixel's ray between two planes parallel to the detector, over their distance; >= 1.
Plane ray_stretch(const View& view);

/// Along each pixel's ray, counted in depth, that is, projected on the direction from source to detector's middle: the
/// length of the ray is ray_stretch times that. The four numbers of a pixel lie side by side, so that a triangle
/// touches it once.
class PathLengths {
 public:
  using Pixels = Eigen::Array<float, 4, Eigen::Dynamic>;
  template <class Floats>
  using View = Eigen::Map<Floats, 0, Eigen::Stride<Eigen::Dynamic, 4>>;

  explicit PathLengths(int pixels = 0);  ///< along a side; all zero

  View<Plane> soft_m() { return plane<Plane>(*this, 0); }  ///< thickness of the two basis materials
  View<Plane> bone_m() { return plane<Plane>(*this, 1); }
  View<Plane> iodine_kg_m2() { return plane<Plane>(*this, 2); }  ///< iodine, by mass
  View<Plane> unmatched() { return plane<Plane>(*this, 3); }     ///< exits less entries: 0 in closed surfaces
  View<const Plane> soft_m() const { return plane<const Plane>(*this, 0); }
  View<const Plane> bone_m() const { return plane<const Plane>(*this, 1); }
  View<const Plane> iodine_kg_m2() const { return plane<const Plane>(*this, 2); }
  View<const Plane> unmatched() const { return plane<const Plane>(*this, 3); }

  int side() const { return side_; }
  Pixels& pixels() { return pixels_; }  ///< a column a pixel, row after row: soft, bone, iodine, unmatched
  const Pixels& pixels() const { return pixels_; }

 private:
  template <class Floats, class Self>
  static View<Floats> plane(Self& self, int component) {
    return {self.pixels_.data() + component, self.side_, self.side_, {4 * self.side_, 4}};
  }

  int side_;
  Pixels pixels_;
};

/// What a leak shows: an entry without exit, or less than nothing of something.
struct Leak {
  long pixels = 0;    ///< how many leak
  float worst_m = 0;  ///< the most negative depth (of iodine as a liquid of 350 kg/m3)
  explicit operator bool() const { return pixels > 0; }
};
inline constexpr float leak_iodine_kg_m3 = 350;
inline constexpr float leak_m = -1e-5f;  ///< a path below this is one: rounding stays 100 times smaller
Leak find_leak(const PathLengths& lengths);

/// One way of drawing. Hardware varies, so this is virtual; one is used by one thread at a time.
class PathLengthRenderer {
 public:
  virtual ~PathLengthRenderer() = default;
  /// Adds the bodies' path lengths to `out` (view.pixels square).
  virtual void add(const View& view, std::span<const Body> bodies, PathLengths& out) = 0;
  virtual const char* name() const = 0;
};

/// By OSMesa (llvmpipe), in the calling thread. Throws std::runtime_error where it cannot be had.
std::unique_ptr<PathLengthRenderer> make_osmesa_renderer();
/// By a scanline rasteriser of our own.
std::unique_ptr<PathLengthRenderer> make_scanline_renderer();

}  // namespace ostium::fluoro
