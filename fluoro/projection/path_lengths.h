#pragma once
/// How much of each attenuator a ray crosses: the sum of exit minus entry depths over all closed surfaces.
#include <array>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>

#include "fluoro/base/plane.h"
#include "fluoro/matter/scene.h"
#include "fluoro/projection/c_arm.h"

namespace ostium::fluoro {

/// The geometry of a picture, and its number of pixels.
struct View {
  CArm arm;
  double field_m = 0.2;  ///< side of the visible square field on the detector
  int pixels = 512;      ///< along a side
  bool operator==(const View&) const = default;
};

/// For each pixel, the length of its ray between two planes parallel to the detector, relative to their distance; >= 1.
Plane ray_stretch(const View& view);

/// Along each pixel's ray, measured in depth, that is, projected on the direction from the source to the detector's
/// middle; the length along the ray is ray_stretch times that.
class PathLengths {
 public:
  explicit PathLengths(int pixels = 0) {  ///< along a side; all zero
    for (Plane& plane : planes_) plane.setZero(pixels, pixels);
  }

  Plane& soft_m() { return planes_[0]; }  ///< thickness of the two basis materials
  Plane& bone_m() { return planes_[1]; }
  Plane& iodine_kg_m2() { return planes_[2]; }  ///< iodine, by mass
  Plane& unmatched() { return planes_[3]; }     ///< exits minus entries: 0 for closed surfaces
  const Plane& soft_m() const { return planes_[0]; }
  const Plane& bone_m() const { return planes_[1]; }
  const Plane& iodine_kg_m2() const { return planes_[2]; }
  const Plane& unmatched() const { return planes_[3]; }

  int side() const { return static_cast<int>(planes_[0].rows()); }

 private:
  std::array<Plane, 4> planes_;
};

/// Signs of a leak: an entry without an exit, or a negative amount.
struct Leak {
  long pixels = 0;    ///< number of leaking pixels
  float worst_m = 0;  ///< the most negative depth (for iodine, as a liquid of 350 kg/m3)
  explicit operator bool() const { return pixels > 0; }
};
inline constexpr float leak_iodine_kg_m3 = 350;
inline constexpr float leak_m = -1e-5f;  ///< a path below this is a leak: rounding errors are 100 times smaller
Leak find_leak(const PathLengths& lengths);

/// What of a body is drawn (Body::still): `still` and `moving` together are `all`.
enum class Parts {
  all,
  still,  ///< the tissue of the triangles that rest
  moving  ///< the tissue of the others, and all contrast
};

/// A drawing method. Virtual because hardware varies; each instance is used by one thread at a time.
class PathLengthRenderer {
 public:
  virtual ~PathLengthRenderer() = default;
  /// Adds the bodies' path lengths to `out` (view.pixels square).
  virtual void add(const View& view, std::span<const Body> bodies, PathLengths& out, Parts parts = Parts::all) = 0;
  virtual const char* name() const = 0;                 ///< of renderer_names
  virtual std::string device() const { return "CPU"; }  ///< what draws: OpenGL's own name of it
};

/// By OpenGL in OSMesa (llvmpipe), in the calling thread. Throws std::runtime_error if it is not available.
std::unique_ptr<PathLengthRenderer> make_osmesa_renderer();
/// By OpenGL in EGL: on a graphics card if there is one, for which the calling thread waits, else in Mesa's software.
/// Throws std::runtime_error if neither is available.
std::unique_ptr<PathLengthRenderer> make_egl_renderer();
/// By our own scanline rasteriser.
std::unique_ptr<PathLengthRenderer> make_scanline_renderer();

enum class Renderer { scanline, osmesa, egl };
inline constexpr std::initializer_list<const char*> renderer_names{"scanline", "osmesa", "egl"};  ///< in that order
/// Throws what the maker throws.
std::unique_ptr<PathLengthRenderer> make_renderer(Renderer which);

}  // namespace ostium::fluoro
