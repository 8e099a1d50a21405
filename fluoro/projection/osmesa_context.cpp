#define GL_GLEXT_PROTOTYPES  // as all sources that are compiled as one with this want it
#include <GL/osmesa.h>
#include <dlfcn.h>

#include <stdexcept>
#include <string>

#include "fluoro/projection/gl_context.h"

namespace ostium::fluoro {

namespace {

class OSMesaGlContext final : public GlContext {
 public:
  OSMesaGlContext() {
    library_ = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);  // stays loaded
    if (!library_)
      throw std::runtime_error(std::string("X-ray rendering by OSMesa: ") + dlerror() + "; install libosmesa6");
    const auto create = find<decltype(&::OSMesaCreateContextExt)>("OSMesaCreateContextExt");
    make_current_ = find<decltype(&::OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    destroy_ = find<decltype(&::OSMesaDestroyContext)>("OSMesaDestroyContext");
    context_ = create(OSMESA_RGBA, 0, 0, 0, nullptr);
    if (!context_) throw std::runtime_error("X-ray rendering: OSMesa gives no context; is libosmesa6 installed?");
  }
  ~OSMesaGlContext() override { destroy_(context_); }

  const char* name() const override { return "osmesa"; }
  void enter() override {
    if (!make_current_(context_, window_, GL_UNSIGNED_BYTE, 1, 1))
      throw std::runtime_error("X-ray rendering: OSMesa's context cannot be made current");
  }
  void leave() noexcept override {}  // a context of OSMesa may be current in several threads
  void* function(const char* name) override { return dlsym(library_, name); }

 private:
  template <class Pointer>
  Pointer find(const char* name) {
    void* const found = function(name);
    if (!found) throw std::runtime_error(std::string("X-ray rendering: this OSMesa has no ") + name);
    return reinterpret_cast<Pointer>(found);
  }

  void* library_ = nullptr;
  decltype(&::OSMesaMakeCurrent) make_current_ = nullptr;
  decltype(&::OSMesaDestroyContext) destroy_ = nullptr;
  OSMesaContext context_ = nullptr;
  GLubyte window_[4] = {};  // required by OSMesa; the picture is drawn to a texture
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() { return std::make_unique<OSMesaGlContext>(); }

}  // namespace ostium::fluoro
