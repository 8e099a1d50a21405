#pragma once
/// The twigs that hold contrast, as a body: the others cannot be seen.
#include <functional>
#include <memory>

#include "fluoro/matter/scene.h"
#include "vascular/twigs/twigs.h"

namespace ostium::app {

class TwigBody {
 public:
  explicit TwigBody(std::shared_ptr<const vascular::Twigs> twigs) : twigs_(std::move(twigs)) {}

  /// `iodine_at`: kg/m3 at the vertex of the lumen from which a twig comes; each is filled evenly.
  void fill(const std::function<float(int root)>& iodine_at);
  bool empty() const { return filled_.empty(); }  ///< none is filled
  /// Those that are filled, at a phase and a depth of breath; not if there are none. `aside_at`: how far the vertex
  /// from which a twig comes lies aside, and the twig with it; null: they all lie where they grew.
  fluoro::Body at(const vascular::MovingLumen& lumen, double phase, double breath,
                  const std::function<Eigen::Vector3d(int root)>& aside_at = {}) const;

 private:
  void join(const std::vector<std::size_t>& filled);

  std::shared_ptr<const vascular::Twigs> twigs_;
  std::vector<std::size_t> filled_;
  fluoro::Body body_;  ///< of those, not placed
};

}  // namespace ostium::app
