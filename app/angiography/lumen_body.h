#pragma once
/// The parts of the lumen that hold contrast, as a body: the others cannot be seen.
#include "app/angiography/cut_surface.h"
#include "vascular/contrast/lumen_map.h"
#include "vascular/contrast/opacity.h"
#include "vascular/patient/patient.h"

namespace ostium::app {

class LumenBody {
 public:
  LumenBody(const vascular::Patient& patient, const vascular::LumenMap& map, const vascular::FlowModel& flow);

  /// (#vertices of the whole lumen), to be written before `fill`.
  vascular::Opacity opacity();
  const Eigen::VectorXf& iodine_kg_m3() const { return whole_.iodine_kg_m3; }
  /// Chooses the parts by that.
  void fill(const std::vector<Corners>& triangles);
  bool empty() const { return cut_.vertices.empty(); }  ///< none is filled
  /// Vertices of the whole lumen whose places `body` asks for.
  const std::vector<int>& vertices() const { return cut_.vertices; }
  Eigen::Matrix3Xf& p_P() { return p_P_; }  ///< (#vertices of the whole lumen)
  /// Those that are filled, where p_P has them; not if there are none.
  fluoro::Body body() const;

 private:
  std::vector<int> part_of_;  ///< (#vertices of the whole lumen): a branch, a stretch of the aorta, a sinus
  fluoro::Contrast whole_;
  Eigen::Matrix3Xf p_P_;
  std::vector<bool> filled_;  ///< (#parts)
  CutSurface cut_;
};

}  // namespace ostium::app
