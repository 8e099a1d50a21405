/// Path lengths drawn by OSMesa (llvmpipe): each triangle adds its depth where the ray exits and subtracts it where it
/// enters (additive blending of 32-bit floats). OSMesa ends with Mesa 25; only this file uses it, and loads it when it
/// is asked for: with LLVM behind it, it took a fifth of the time in which any command starts.
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

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

/// The functions that are used below, by their own names.
// clang-format off
#define OSTIUM_OSMESA_FUNCTIONS(X) \
  X(OSMesaCreateContextExt) X(OSMesaMakeCurrent) X(OSMesaDestroyContext) X(glAttachShader) \
  X(glBindAttribLocation) X(glBindFramebuffer) X(glBindTexture) X(glBlendFunc) X(glCheckFramebufferStatus) \
  X(glClear) X(glClearColor) X(glCompileShader) X(glCreateProgram) X(glCreateShader) X(glDisable) \
  X(glDisableVertexAttribArray) X(glDrawElements) X(glEnable) X(glEnableVertexAttribArray) \
  X(glFramebufferTexture2D) X(glGenFramebuffers) X(glGenTextures) X(glGetProgramiv) X(glGetShaderInfoLog) \
  X(glGetShaderiv) X(glGetString) X(glGetUniformLocation) X(glLinkProgram) X(glReadPixels) X(glShaderSource) \
  X(glTexImage2D) X(glUniform1f) X(glUniform2f) X(glUniform3fv) X(glUniformMatrix3fv) X(glUseProgram) \
  X(glVertexAttrib3f) X(glVertexAttribPointer) X(glViewport)
// clang-format on

struct OSMesa {
  OSMesa() {
    void* const library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);  // stays loaded
    if (!library)
      throw std::runtime_error(std::string("X-ray rendering by OSMesa: ") + dlerror() + "; install libosmesa6");
#define OSTIUM_OSMESA_FIND(name) find(library, #name, name);
    OSTIUM_OSMESA_FUNCTIONS(OSTIUM_OSMESA_FIND)
#undef OSTIUM_OSMESA_FIND
  }

#define OSTIUM_OSMESA_POINTER(name) decltype(&::name) name = nullptr;
  OSTIUM_OSMESA_FUNCTIONS(OSTIUM_OSMESA_POINTER)
#undef OSTIUM_OSMESA_POINTER

 private:
  template <class Function>
  static void find(void* library, const char* name, Function*& function) {
    function = reinterpret_cast<Function*>(dlsym(library, name));
    if (!function) throw std::runtime_error(std::string("X-ray rendering: this OSMesa has no ") + name);
  }
};

#undef OSTIUM_OSMESA_FUNCTIONS

class OSMesaRenderer final : public PathLengthRenderer, OSMesa {
 public:
  OSMesaRenderer() {
    // Threads of its own would take the core of the simulation, and cost short frames more than they save.
    setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
    context_ = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr);
    if (!context_) throw std::runtime_error("X-ray rendering: OSMesa gives no context; is libosmesa6 installed?");
    make_current();
    const GLubyte* version = glGetString(GL_VERSION);
    if (!version || std::atof(reinterpret_cast<const char*>(version)) < 3.0)
      throw std::runtime_error("X-ray rendering: OSMesa must be OpenGL 3.0 or newer");
    link_program();
    glGenFramebuffers(1, &framebuffer_);
    glGenTextures(1, &texture_);
  }
  ~OSMesaRenderer() override { OSMesaDestroyContext(context_); }

  void add(const View& view, std::span<const Body> bodies, PathLengths& out, Parts parts) override {
    make_current();
    aim(view);
    glClear(GL_COLOR_BUFFER_BIT);
    for (const Body& body : bodies) draw(view, body, parts);
    read_back(out);
  }

  const char* name() const override { return "osmesa"; }

 private:
  void make_current() {
    if (!OSMesaMakeCurrent(context_, window_, GL_UNSIGNED_BYTE, 1, 1))
      throw std::runtime_error("X-ray rendering: OSMesa's context cannot be made current");
  }

  GLuint compiled(GLenum kind, const char* text) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    char log[500] = {};
    glGetShaderInfoLog(shader, sizeof log, nullptr, log);
    throw std::runtime_error(std::string("X-ray rendering: OSMesa refuses a shader: ") + log);
  }

  void link_program() {
    program_ = glCreateProgram();
    glAttachShader(program_, compiled(GL_VERTEX_SHADER, vertex_shader));
    glAttachShader(program_, compiled(GL_FRAGMENT_SHADER, fragment_shader));
    glBindAttribLocation(program_, 0, "p_P");
    glBindAttribLocation(program_, 1, "contrast");
    glLinkProgram(program_);
    GLint good = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &good);
    if (!good) throw std::runtime_error("X-ray rendering: OSMesa does not link the shaders");
  }

  void aim(const View& view) {
    if (pixels_ != view.pixels) {
      pixels_ = view.pixels;
      glBindTexture(GL_TEXTURE_2D, texture_);
      glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, pixels_, pixels_, 0, GL_RGBA, GL_FLOAT, nullptr);
      glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
      if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw std::runtime_error("X-ray rendering: OSMesa has no framebuffer of " + std::to_string(pixels_) +
                                 " pixels");
    }
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
    glViewport(0, 0, pixels_, pixels_);
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
    for (int row = 0; row < pixels_; ++row)  // GL counts rows from the bottom
      out.pixels().middleCols(Eigen::Index(row) * pixels_, pixels_) +=
          rgba_.middleCols(Eigen::Index(pixels_ - 1 - row) * pixels_, pixels_);
  }

  GLint uniform(const char* name) const { return glGetUniformLocation(program_, name); }

  OSMesaContext context_ = nullptr;
  GLubyte window_[4] = {};  // required by OSMesa; the picture is drawn to the texture
  GLuint program_ = 0, framebuffer_ = 0, texture_ = 0;
  int pixels_ = 0;
  Eigen::Matrix3Xf contrast_;
  PathLengths::Pixels rgba_;
};

}  // namespace

std::unique_ptr<PathLengthRenderer> make_osmesa_renderer() { return std::make_unique<OSMesaRenderer>(); }

}  // namespace ostium::fluoro
