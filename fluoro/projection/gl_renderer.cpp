/// Path lengths drawn by OpenGL: each triangle adds its depth where the ray exits and subtracts it where it enters
/// (additive blending of 32-bit floats).
#include "fluoro/projection/open_gl.h"
#include "fluoro/projection/path_lengths.h"

namespace ostium::fluoro {

namespace {

/// Depths are measured from the isocentre, so that floats keep them to a few hundredths of a micrometre. The third
/// component of `p_S` is the depth from the source; nothing is clipped by depth. llvmpipe decides which pixels a
/// triangle covers on a grid of 1/256 pixel, but computes slopes from the exact corners, so a steep triangle would
/// reach far beyond them. So the corners are rounded to that grid here.
constexpr const char* vertex_shader = R"(#version 130
uniform mat3 R_SP;         // patient to source frame: right, up, outwards
uniform vec3 p_PS;         // the source
uniform float magnification;  // SID over half the field
uniform float isocentre;   // depth of the isocentre
uniform float pixels;
in vec3 p_P;
in vec3 contrast;          // concentration, depth of its centreline from the isocentre, what is counted along that
out float depth;
out vec3 iodine;
void main() {
  vec3 p_S = R_SP * (p_P - p_PS);
  depth = p_S.z - isocentre;
  iodine = contrast;
  vec2 at = (0.5 + 0.5 * magnification * p_S.xy / p_S.z) * pixels;
  at = floor(at * 256.0 + 0.5) / 256.0;
  gl_Position = vec4((2.0 * at / pixels - 1.0) * p_S.z, 0.0, p_S.z);
})";

/// Image axes look at the patient from the detector, so triangles facing the source are clockwise in the picture.
constexpr const char* fragment_shader = R"(#version 130
uniform vec2 tissue;    // soft, bone
uniform float counted;  // 0 where the triangle is counted with its tissue, elsewhere
in float depth;
in vec3 iodine;
out vec4 lengths;
void main() {
  float leaves = gl_FrontFacing ? 1.0 : -1.0;
  lengths = leaves * vec4(depth * tissue, iodine.x * (depth - iodine.y) + iodine.z, counted);
})";

class GlRenderer final : public PathLengthRenderer, OpenGl {
 public:
  explicit GlRenderer(Maker make) : OpenGl(make) {
    const Entered entered(*this);
    program_ = linked(vertex_shader, fragment_shader, {"p_P", "contrast"});
  }

  void add(const View& view, std::span<const Body> bodies, PathLengths& out, Parts parts) override {
    const Entered entered(*this);
    aim(view);
    glClear(GL_COLOR_BUFFER_BIT);
    for (const Body& body : bodies) draw(view, body, parts);
    read_back(out);
  }

  const char* name() const override { return OpenGl::name(); }
  std::string device() const override { return OpenGl::device(); }

 private:
  void aim(const View& view) {
    pixels_ = view.pixels;
    draw_to(pixels_, GL_RGBA32F);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glClearColor(0, 0, 0, 0);
    glUseProgram(program_);
    const ImageAxes axes(view.arm);
    Eigen::Matrix3f R_SP;
    R_SP << axes.right.transpose().cast<float>(), axes.up.transpose().cast<float>(),
        axes.outwards.transpose().cast<float>();
    const Eigen::Vector3f p_PS = source(view.arm).cast<float>();
    glUniformMatrix3fv(uniform("R_SP"), 1, GL_FALSE, R_SP.data());
    glUniform3fv(uniform("p_PS"), 1, p_PS.data());
    glUniform1f(uniform("magnification"), static_cast<float>(2 * view.arm.source_to_detector_m / view.field_m));
    glUniform1f(uniform("isocentre"), static_cast<float>(view.arm.source_to_isocentre_m));
    glUniform1f(uniform("pixels"), static_cast<float>(pixels_));
    glEnableVertexAttribArray(0);
  }

  void draw(const View& view, const Body& body, Parts parts) {
    const Tissue net{body.tissue.soft - body.within.soft, body.tissue.bone - body.within.bone};
    const bool filled = parts != Parts::still && is_seen(body.contrast);
    if (net.soft == 0 && net.bone == 0 && !filled) return;
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, body.p_P.data());
    if (filled) {
      const Eigen::Vector3f outwards = towards_detector(view.arm).cast<float>();
      contrast_.resize(3, body.p_P.cols());
      contrast_.row(0) = body.contrast.iodine_kg_m3.transpose();
      contrast_.row(1) = outwards.transpose() * (body.contrast.p_PC.colwise() - view.arm.p_PI.cast<float>());
      if (body.contrast.along_kg_m2.size() > 0)
        contrast_.row(2) = outwards.transpose() * body.contrast.along_kg_m2;
      else
        contrast_.row(2).setZero();
      glEnableVertexAttribArray(1);
      glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, contrast_.data());
    } else {
      glDisableVertexAttribArray(1);
      glVertexAttrib3f(1, 0, 0, 0);
    }
    const auto triangles = [&](int from, int to, const Tissue& tissue, float counted) {
      glUniform2f(uniform("tissue"), tissue.soft, tissue.bone);
      glUniform1f(uniform("counted"), counted);
      glDrawElements(GL_TRIANGLES, 3 * (to - from), GL_UNSIGNED_INT, body.triangles->data() + 3 * from);
    };
    const auto all = static_cast<int>(body.triangles->cols());
    if (parts == Parts::still) return triangles(0, body.still, net, 1);
    const int first = parts == Parts::all ? 0 : body.still;
    if (filled && first > 0) triangles(0, first, {}, 0);
    triangles(first, all, net, 1);
  }

  void read_back(PathLengths& out) {
    rgba_.resize(4, Eigen::Index(pixels_) * pixels_);
    glReadPixels(0, 0, pixels_, pixels_, GL_RGBA, GL_FLOAT, rgba_.data());
    Plane* const planes[] = {&out.soft_m(), &out.bone_m(), &out.iodine_kg_m2(), &out.unmatched()};
    for (int row = 0; row < pixels_; ++row)  // GL counts rows from the bottom
      for (int i = 0; i < 4; ++i)
        planes[i]->row(row) += rgba_.row(i).segment(Eigen::Index(pixels_ - 1 - row) * pixels_, pixels_);
  }

  GLint uniform(const char* name) const { return glGetUniformLocation(program_, name); }

  GLuint program_ = 0;
  int pixels_ = 0;
  Eigen::Matrix3Xf contrast_;
  Eigen::Array<float, 4, Eigen::Dynamic> rgba_;
};

}  // namespace

std::unique_ptr<PathLengthRenderer> make_osmesa_renderer() { return std::make_unique<GlRenderer>(make_osmesa_context); }

std::unique_ptr<PathLengthRenderer> make_egl_renderer() { return std::make_unique<GlRenderer>(make_egl_context); }

}  // namespace ostium::fluoro
