#include "app/angiography/cut_surface.h"

#include <gtest/gtest.h>

#include "fluoro/matter/tissue.h"
#include "fluoro/phantom/shapes.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::app {
namespace {

std::vector<Corners> triangles_in(const fluoro::Body& body) {
  std::vector<Corners> out;
  for (const auto& t : body.triangles->colwise()) out.push_back({t[0], t[1], t[2]});
  return out;
}

TEST(CutSurface, APartOfATubeIsClosedAndHoldsWhatItHeld) {
  const Eigen::Matrix3Xd line = fluoro::phantom::smooth_line({{-0.03, 0, 0}, {0.03, 0, 0}}, 0.0005);
  const fluoro::Body whole = fluoro::phantom::body(
      "tube", fluoro::phantom::tube(line, Eigen::VectorXd::Constant(line.cols(), 0.002), 32), fluoro::tissue::soft, {});
  const auto is_middle = [&](int v) { return std::abs(whole.p_P(0, v)) < 0.01f; };
  const CutSurface cut =
      cut_out(triangles_in(whole), static_cast<std::size_t>(whole.p_P.cols()),
              [&](const Corners& t) { return is_middle(t[0]) && is_middle(t[1]) && is_middle(t[2]); });
  ASSERT_EQ(cut.rims.size(), 2U);
  fluoro::Body part = whole;
  part.triangles = cut.triangles;
  take(cut, whole.p_P, part.p_P);
  EXPECT_NO_THROW(check(part));
  EXPECT_NEAR(part.p_P(1, part.p_P.cols() - 1), 0, 1e-6) << "a lid's middle lies on the axis";
  // Within, rays cross as much of the part as of the whole.
  fluoro::View view;
  view.field_m = 0.02;
  view.pixels = 128;
  fluoro::PathLengths of_whole(view.pixels), of_part(view.pixels);
  const auto renderer = fluoro::make_scanline_renderer();
  renderer->add(view, {&whole, 1}, of_whole);
  renderer->add(view, {&part, 1}, of_part);
  EXPECT_FALSE(find_leak(of_part));
  EXPECT_GT(of_part.soft_m().maxCoeff(), 3.9e-3f);
  EXPECT_EQ((of_part.soft_m() - of_whole.soft_m()).abs().maxCoeff(), 0);
}

}  // namespace
}  // namespace ostium::app
