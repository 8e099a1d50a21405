#include "tests/bench/angle_opacity.h"

#include <Eigen/Geometry>
#include <numeric>

#include "fluoro/projection/open_gl.h"

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

struct AngleOpacity::Context : fluoro::OpenGl {
  explicit Context(std::vector<fluoro::Body> b) : OpenGl(fluoro::make_osmesa_context), bodies(std::move(b)) {
    for (const fluoro::Body& body : bodies) normals.push_back(normals_of(body));
    const Entered entered(*this);
    program = linked(vertex_shader, fragment_shader, {"p_P", "normal_P"});
  }
  double draw(const fluoro::View& view);

  std::vector<fluoro::Body> bodies;
  std::vector<Eigen::Matrix3Xf> normals;
  std::vector<GLubyte> grey;
  GLuint program = 0;
};

double AngleOpacity::Context::draw(const fluoro::View& view) {
  const Entered entered(*this);
  draw_to(view.pixels, GL_RGBA8);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glUseProgram(program);
  const fluoro::ImageAxes axes(view.arm);
  Eigen::Matrix3f R_SP;
  R_SP << axes.right.transpose().cast<float>(), axes.up.transpose().cast<float>(),
      axes.outwards.transpose().cast<float>();
  const Eigen::Vector3f p_PS = source(view.arm).cast<float>();
  const auto uniform = [&](const char* name) { return glGetUniformLocation(program, name); };
  glUniformMatrix3fv(uniform("R_SP"), 1, GL_FALSE, R_SP.data());
  glUniform3fv(uniform("p_PS"), 1, p_PS.data());
  glUniform1f(uniform("magnification"), float(2 * view.arm.source_to_detector_m / view.field_m));
  glUniform1f(uniform("opacity"), 0.5f);
  glEnableVertexAttribArray(0);
  glEnableVertexAttribArray(1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, bodies[i].p_P.data());
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, 0, normals[i].data());
    glDrawElements(GL_TRIANGLES, GLsizei(bodies[i].triangles->size()), GL_UNSIGNED_INT, bodies[i].triangles->data());
  }
  grey.resize(std::size_t(4 * view.pixels * view.pixels));
  glReadPixels(0, 0, view.pixels, view.pixels, GL_RGBA, GL_UNSIGNED_BYTE, grey.data());
  return std::accumulate(grey.begin(), grey.end(), 0.0) / double(grey.size());
}

AngleOpacity::AngleOpacity(std::vector<fluoro::Body> bodies) : context_(std::make_unique<Context>(std::move(bodies))) {}

AngleOpacity::~AngleOpacity() = default;

double AngleOpacity::draw(const fluoro::View& view) { return context_->draw(view); }

}  // namespace ostium::bench
