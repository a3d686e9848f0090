#pragma once

/// \file
/// A desktop OpenGL context without window or display server, as rendering on a headless machine
/// needs it: EGL on Mesa's surfaceless platform (EGL_MESA_platform_surfaceless,
/// EGL_KHR_surfaceless_context); software rendering does. A context belongs to one thread at a
/// time: whoever draws holds a Current for as long as it takes.

#include <memory>

namespace ringhook {

class EglContext {
 public:
  /// Throws DeviceError naming the EGL call that failed.
  EglContext();
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Makes the context current in this thread while it lives.
  class Current {
   public:
    explicit Current(const EglContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

   private:
    const EglContext& context_;
  };

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
};

}  // namespace ringhook
