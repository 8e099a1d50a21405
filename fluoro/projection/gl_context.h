#pragma once
/// Ways to OpenGL without a screen. Their libraries are loaded when a context is asked for: with LLVM behind it, OSMesa
/// took a fifth of the time in which any command starts.
#include <memory>

namespace ostium::fluoro {

/// A context, and how its functions are found. One thread at a time uses it, between enter() and leave().
class GlContext {
 public:
  virtual ~GlContext() = default;
  virtual const char* name() const = 0;  ///< as `--renderer` calls it
  /// OpenGL's calls of this thread go to this context from here on. Throws std::runtime_error if they cannot.
  virtual void enter() = 0;
  /// Another thread may enter it, and this thread another one.
  virtual void leave() noexcept = 0;
  virtual void* function(const char* name) = 0;  ///< while entered; null: there is none of that name
};

/// Mesa's software renderer by itself; it ends with Mesa 25. Throws std::runtime_error, which names the package, if it
/// is not available.
std::unique_ptr<GlContext> make_osmesa_context();
/// On the first device of EGL's that gives a context: graphics cards first, software last. Throws as the other does.
std::unique_ptr<GlContext> make_egl_context();

}  // namespace ostium::fluoro
