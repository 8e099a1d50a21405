#include "fluoro/projection/open_gl.h"

#include <cstdlib>
#include <stdexcept>

namespace ostium::fluoro {

namespace {

const char* letters(const GLubyte* text) { return text ? reinterpret_cast<const char*>(text) : ""; }

}  // namespace

OpenGl::OpenGl(Maker make) {
  // Of Mesa's software renderer: threads of its own would take the core of the simulation, and cost short frames more
  // than they save.
  setenv("LP_NUM_THREADS", "0", /*overwrite=*/0);
  context_ = make();
  const Entered entered(*this);
  const auto find = [&]<class Pointer>(const char* function, Pointer& pointer) {
    pointer = reinterpret_cast<Pointer>(context_->function(function));
    if (!pointer) throw std::runtime_error(std::string("X-ray rendering: ") + name() + " has no " + function);
  };
#define OSTIUM_GL_FIND(function) find(#function, function);
  OSTIUM_GL_FUNCTIONS(OSTIUM_GL_FIND)
#undef OSTIUM_GL_FIND
  device_ = letters(glGetString(GL_RENDERER));
  if (std::atof(letters(glGetString(GL_VERSION))) < 3.0)
    throw std::runtime_error(std::string("X-ray rendering: ") + name() + " must be OpenGL 3.0 or newer");
  glGenFramebuffers(1, &framebuffer_);
  glGenTextures(1, &texture_);
}

GLuint OpenGl::compiled(GLenum kind, const char* text) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) return shader;
  char log[500] = {};
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  throw std::runtime_error(std::string("X-ray rendering: ") + name() + " refuses a shader: " + log);
}

GLuint OpenGl::linked(const char* vertex_shader, const char* fragment_shader,
                      std::initializer_list<const char*> attributes) {
  const GLuint program = glCreateProgram();
  glAttachShader(program, compiled(GL_VERTEX_SHADER, vertex_shader));
  glAttachShader(program, compiled(GL_FRAGMENT_SHADER, fragment_shader));
  GLuint location = 0;
  for (const char* attribute : attributes) glBindAttribLocation(program, location++, attribute);
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (!good) throw std::runtime_error(std::string("X-ray rendering: ") + name() + " does not link the shaders");
  return program;
}

void OpenGl::draw_to(int pixels, GLint format) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  if (pixels_ != pixels) {
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexImage2D(GL_TEXTURE_2D, 0, format, pixels, pixels, 0, GL_RGBA, GL_FLOAT, nullptr);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture_, 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw std::runtime_error(std::string("X-ray rendering: ") + name() + " has no framebuffer of " +
                               std::to_string(pixels) + " pixels");
    pixels_ = pixels;
  }
  glViewport(0, 0, pixels, pixels);
}

}  // namespace ostium::fluoro
