#pragma once
/// The functions of OpenGL that are used, as a context gives them; for sources that draw (it includes OpenGL's header,
/// with its macros).
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>

#include <initializer_list>
#include <memory>
#include <string>

#include "fluoro/projection/gl_context.h"

namespace ostium::fluoro {

// clang-format off
#define OSTIUM_GL_FUNCTIONS(X) \
  X(glAttachShader) X(glBindAttribLocation) X(glBindFramebuffer) X(glBindTexture) X(glBlendFunc) \
  X(glCheckFramebufferStatus) X(glClear) X(glClearColor) X(glCompileShader) X(glCreateProgram) X(glCreateShader) \
  X(glDisable) X(glDisableVertexAttribArray) X(glDrawElements) X(glEnable) X(glEnableVertexAttribArray) \
  X(glFramebufferTexture2D) X(glGenFramebuffers) X(glGenTextures) X(glGetProgramiv) X(glGetShaderInfoLog) \
  X(glGetShaderiv) X(glGetString) X(glGetUniformLocation) X(glLinkProgram) X(glReadPixels) X(glShaderSource) \
  X(glTexImage2D) X(glUniform1f) X(glUniform2f) X(glUniform3fv) X(glUniformMatrix3fv) X(glUseProgram) \
  X(glVertexAttrib3f) X(glVertexAttribPointer) X(glViewport)
// clang-format on

/// A context, its functions by their own names, and a square picture to draw to. Whatever is made in it ends with it.
/// One thread at a time uses it.
class OpenGl {
 public:
  using Maker = std::unique_ptr<GlContext> (*)();
  /// Enters the context while it lives; functions and members are called only then.
  class Entered {
   public:
    explicit Entered(OpenGl& gl) : context_(*gl.context_) { context_.enter(); }
    ~Entered() { context_.leave(); }
    Entered(const Entered&) = delete;
    Entered& operator=(const Entered&) = delete;

   private:
    GlContext& context_;
  };

  /// Rethrows what the maker throws; std::runtime_error if the context is older than OpenGL 3.0.
  explicit OpenGl(Maker make);

  const char* name() const { return context_->name(); }
  const std::string& device() const { return device_; }  ///< GL_RENDERER

  /// Attributes get the locations 0, 1 and so on. Throws std::runtime_error with what is wrong.
  GLuint linked(const char* vertex_shader, const char* fragment_shader, std::initializer_list<const char*> attributes);
  /// From here on what is drawn goes to a picture of so many pixels along a side, GL_RGBA32F or GL_RGBA8. Throws
  /// std::runtime_error if there is none so large.
  void draw_to(int pixels, GLint format);

#define OSTIUM_GL_POINTER(name) decltype(&::name) name = nullptr;
  OSTIUM_GL_FUNCTIONS(OSTIUM_GL_POINTER)
#undef OSTIUM_GL_POINTER

 private:
  GLuint compiled(GLenum kind, const char* text);

  std::unique_ptr<GlContext> context_;
  std::string device_;
  GLuint framebuffer_ = 0, texture_ = 0;
  int pixels_ = 0;
};

}  // namespace ostium::fluoro
