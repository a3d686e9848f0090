#include "sim/egl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <sstream>

#include "core/error.h"

namespace ringhook {
namespace {

void require(bool succeeded, const char* call) {
  if (!succeeded) {
    std::ostringstream sentence;
    sentence << call << " failed (EGL error 0x" << std::hex << eglGetError()
             << "): rendering needs EGL with Mesa's surfaceless platform and desktop OpenGL";
    throw DeviceError(sentence.str());
  }
}

/// One display for the process: terminating it would end every context on it.
EGLDisplay surfacelessDisplay() {
  static EGLDisplay display = [] {
    EGLDisplay opened =
        eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    require(opened != EGL_NO_DISPLAY, "eglGetPlatformDisplay");
    require(eglInitialize(opened, nullptr, nullptr) == EGL_TRUE, "eglInitialize");
    return opened;
  }();
  return display;
}

}  // namespace

struct EglContext::Handles {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

EglContext::EglContext() : handles_(std::make_unique<Handles>()) {
  handles_->display = surfacelessDisplay();
  require(eglBindAPI(EGL_OPENGL_API) == EGL_TRUE, "eglBindAPI");
  constexpr std::array<EGLint, 5> kWanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                          EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  const EGLBoolean chosen = eglChooseConfig(handles_->display, kWanted.data(), &config, 1, &count);
  require(chosen == EGL_TRUE && count > 0, "eglChooseConfig");
  handles_->context = eglCreateContext(handles_->display, config, EGL_NO_CONTEXT, nullptr);
  require(handles_->context != EGL_NO_CONTEXT, "eglCreateContext");
}

EglContext::~EglContext() { eglDestroyContext(handles_->display, handles_->context); }

EglContext::Current::Current(const EglContext& context) : context_(context) {
  eglBindAPI(EGL_OPENGL_API);
  require(eglMakeCurrent(context.handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE,
                         context.handles_->context) == EGL_TRUE,
          "eglMakeCurrent");
}

EglContext::Current::~Current() {
  eglMakeCurrent(context_.handles_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace ringhook
