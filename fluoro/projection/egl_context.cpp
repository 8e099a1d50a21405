/// Extensions: EGL_EXT_device_enumeration, EGL_EXT_platform_device, EGL_MESA_platform_surfaceless,
/// EGL_KHR_surfaceless_context (registry.khronos.org/EGL). libEGL.so.1 is libglvnd's, which finds the vendors' own, or
/// a vendor's.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "fluoro/projection/gl_context.h"

namespace ostium::fluoro {

namespace {

/// A whole word of the list that EGL keeps of its extensions.
bool lists(const char* extensions, std::string_view name) {
  if (!extensions) return false;
  return (" " + std::string(extensions) + " ").find(" " + std::string(name) + " ") != std::string::npos;
}

/// libEGL, and the display on which contexts are made.
class Egl {
 public:
  Egl() {
    void* const library = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);  // stays loaded
    if (!library) throw std::runtime_error(std::string("X-ray rendering by EGL: ") + dlerror() + "; install libegl1");
    function_ = reinterpret_cast<decltype(function_)>(dlsym(library, "eglGetProcAddress"));
    if (!function_) throw std::runtime_error("X-ray rendering: this libEGL has no eglGetProcAddress");
    const auto find = [&]<class Pointer>(const char* name, Pointer& pointer) {
      pointer = reinterpret_cast<Pointer>(dlsym(library, name));
      if (!pointer) throw std::runtime_error(std::string("X-ray rendering: this libEGL has no ") + name);
    };
    find("eglQueryString", query_string_);
    find("eglInitialize", initialize_);
    find("eglBindAPI", bind_api_);
    find("eglChooseConfig", choose_config_);
    find("eglCreateContext", create_context_);
    find("eglDestroyContext", destroy_context_);
    find("eglMakeCurrent", make_current_);
    for (const EGLDisplay display : displays())
      if (works(display)) return;
    throw std::runtime_error(
        "X-ray rendering: EGL has no device that gives an OpenGL context; install the graphics card's driver, or "
        "libegl-mesa0 and libgl1-mesa-dri");
  }

  EGLContext make_context() const {
    bind_api_(EGL_OPENGL_API);
    return create_context_(display_, config_, EGL_NO_CONTEXT, nullptr);
  }
  void destroy(EGLContext context) const { destroy_context_(display_, context); }
  bool make_current(EGLContext context) const {
    // The API that is bound is the thread's own, and says which of its contexts goes where there is none.
    return bind_api_(EGL_OPENGL_API) && make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context);
  }
  void* function(const char* name) const { return reinterpret_cast<void*>(function_(name)); }

 private:
  /// Those of graphics cards, those of software, Mesa's that needs no device: none is initialised yet.
  std::vector<EGLDisplay> displays() const {
    const char* const known = query_string_(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto display_of = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(function_("eglGetPlatformDisplayEXT"));
    std::vector<EGLDisplay> out;
    if (!display_of || !lists(known, "EGL_EXT_platform_base")) return out;
    const auto devices_of = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(function_("eglQueryDevicesEXT"));
    const auto text_of = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(function_("eglQueryDeviceStringEXT"));
    if (devices_of && text_of && lists(known, "EGL_EXT_platform_device")) {
      EGLint count = 0;
      std::vector<EGLDeviceEXT> devices;
      if (devices_of(0, nullptr, &count)) devices.resize(static_cast<std::size_t>(count));
      if (!devices_of(count, devices.data(), &count)) count = 0;
      devices.resize(static_cast<std::size_t>(count));
      std::ranges::stable_partition(devices, [&](EGLDeviceEXT device) {
        return !lists(text_of(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
      });
      for (const EGLDeviceEXT device : devices) out.push_back(display_of(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
    }
    if (lists(known, "EGL_MESA_platform_surfaceless"))
      out.push_back(display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    return out;
  }

  /// Takes a display if a context can be made on it, and used without a surface. One that cannot stays initialised:
  /// others in this process may have it, too.
  bool works(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || !initialize_(display, nullptr, nullptr)) return false;
    if (!lists(query_string_(display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context")) return false;
    constexpr EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (!choose_config_(display, wanted, &config_, 1, &count) || count < 1) return false;
    display_ = display;
    const EGLContext context = make_context();
    if (context == EGL_NO_CONTEXT) return false;
    const bool good = make_current(context);
    make_current(EGL_NO_CONTEXT);
    destroy(context);
    return good;
  }

  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLConfig config_ = nullptr;
  decltype(&::eglGetProcAddress) function_ = nullptr;
  decltype(&::eglQueryString) query_string_ = nullptr;
  decltype(&::eglInitialize) initialize_ = nullptr;
  decltype(&::eglBindAPI) bind_api_ = nullptr;
  decltype(&::eglChooseConfig) choose_config_ = nullptr;
  decltype(&::eglCreateContext) create_context_ = nullptr;
  decltype(&::eglDestroyContext) destroy_context_ = nullptr;
  decltype(&::eglMakeCurrent) make_current_ = nullptr;
};

/// One display for all contexts: EGL counts no users of it, so it is never given back.
const Egl& egl() {
  static const Egl only;
  return only;
}

class EglGlContext final : public GlContext {
 public:
  EglGlContext() : context_(egl().make_context()) {
    if (context_ == EGL_NO_CONTEXT) throw std::runtime_error("X-ray rendering: EGL gives no more contexts");
  }
  ~EglGlContext() override { egl().destroy(context_); }

  const char* name() const override { return "egl"; }
  void enter() override {
    if (!egl().make_current(context_))
      throw std::runtime_error("X-ray rendering: EGL's context cannot be made current");
  }
  void leave() noexcept override { egl().make_current(EGL_NO_CONTEXT); }
  void* function(const char* name) override { return egl().function(name); }

 private:
  EGLContext context_;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_context() { return std::make_unique<EglGlContext>(); }

}  // namespace ostium::fluoro
