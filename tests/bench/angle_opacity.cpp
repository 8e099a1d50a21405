#include "tests/bench/angle_opacity.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/osmesa.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

namespace ostium::bench {

namespace {

constexpr const char* vertex_shader = R"(#version 130
uniform mat3 R_SP;
uniform vec3 p_PS;
uniform float magnification;
in vec3 p_P;
in vec3 normal_P;
out vec3 ray, normal;
void main() {
  ray = R_SP * (p_P - p_PS);
  normal = R_SP * normal_P;
  gl_Position = vec4(ray.xy * magnification, 0.0, ray.z);
})";

constexpr const char* fragment_shader = R"(#version 130
uniform float opacity;
in vec3 ray, normal;
out vec4 colour;
void main() {
  float along = abs(dot(normalize(ray), normalize(normal)));
  colour = vec4(0.0, 0.0, 0.0, opacity * pow(1.0 - along, 2.0));
})";

GLuint compiled(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) throw std::runtime_error("angle-opacity yardstick: shader refused");
  return shader;
}

Eigen::Matrix3Xf normals_of(const fluoro::Body& body) {
  Eigen::Matrix3Xf out = Eigen::Matrix3Xf::Zero(3, body.p_P.cols());
  for (const auto& t : body.triangles->colwise()) {
    const Eigen::Vector3f a = body.p_P.col(t[0]), b = body.p_P.col(t[1]), c = body.p_P.col(t[2]);
    const Eigen::Vector3f area = (b - a).cross(c - a);
    for (int i = 0; i < 3; ++i) out.col(t[i]) += area;
  }
  out.colwise().normalize();
  return out;
}

}  // namespace

struct AngleOpacity::Context {
  OSMesaContext osmesa = nullptr;
  std::vector<fluoro::Body> bodies;
  std::vector<Eigen::Matrix3Xf> normals;
  std::vector<GLubyte> pixels;
  GLuint program = 0;
};

AngleOpacity::AngleOpacity(std::vector<fluoro::Body> bodies) : context_(std::make_unique<Context>()) {
  setenv("LP_NUM_THREADS", "0", 0);
  Context& c = *context_;
  c.bodies = std::move(bodies);
  for (const fluoro::Body& body : c.bodies) c.normals.push_back(normals_of(body));
  c.osmesa = OSMesaCreateContextExt(OSMESA_RGBA, 0, 0, 0, nullptr);
  c.pixels.resize(4);
  if (!c.osmesa || !OSMesaMakeCurrent(c.osmesa, c.pixels.data(), GL_UNSIGNED_BYTE, 1, 1))
    throw std::runtime_error("angle-opacity yardstick: no OSMesa");
  c.program = glCreateProgram();
  glAttachShader(c.program, compiled(GL_VERTEX_SHADER, vertex_shader));
  glAttachShader(c.program, compiled(GL_FRAGMENT_SHADER, fragment_shader));
  glBindAttribLocation(c.program, 0, "p_P");
  glBindAttribLocation(c.program, 1, "normal_P");
  glLinkProgram(c.program);
}

AngleOpacity::~AngleOpacity() { OSMesaDestroyContext(context_->osmesa); }

double AngleOpacity::draw(const fluoro::View& view) {
  Context& c = *context_;
  c.pixels.resize(std::size_t(4 * view.pixels * view.pixels));
  OSMesaMakeCurrent(c.osmesa, c.pixels.data(), GL_UNSIGNED_BYTE, view.pixels, view.pixels);
  glViewport(0, 0, view.pixels, view.pixels);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(c.program);
  const fluoro::ImageAxes axes(view.arm);
  Eigen::Matrix3f R_SP;
  R_SP << axes.right.transpose().cast<float>(), axes.up.transpose().cast<float>(),
      axes.outwards.transpose().cast<float>();
  const Eigen::Vector3f p_PS = source(view.arm).cast<float>();
  const auto uniform = [&](const char* name) { return glGetUniformLocation(c.program, name); };
  glUniformMatrix3fv(uniform("R_SP"), 1, GL_FALSE, R_SP.data());
  glUniform3fv(uniform("p_PS"), 1, p_PS.data());
  glUniform1f(uniform("magnification"), float(2 * view.arm.source_to_detector_m / view.field_m));
  glUniform1f(uniform("opacity"), 0.5f);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  for (std::size_t i = 0; i < c.bodies.size(); ++i) {
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, c.bodies[i].p_P.data());
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, c.normals[i].data());
    glDrawElements(GL_TRIANGLES, GLsizei(c.bodies[i].triangles->size()), GL_UNSIGNED_INT,
                   c.bodies[i].triangles->data());
  }
  glFinish();
  return std::accumulate(c.pixels.begin(), c.pixels.end(), 0.0) / double(c.pixels.size());
}

}  // namespace ostium::bench
