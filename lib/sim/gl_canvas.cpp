#include "sim/gl_canvas.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <string>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kSamples = 4;

GLuint attach(GLenum attachment, GLenum format, int samples, int width, int height) {
  GLuint buffer = 0;
  glGenRenderbuffers(1, &buffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  return buffer;
}

void requireComplete(int width, int height) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw DeviceError("OpenGL refused a framebuffer of " + std::to_string(width) + " x " +
                      std::to_string(height) + " px");
  }
}

}  // namespace

GlCanvas::GlCanvas(int width, int height, unsigned format) : width_(width), height_(height) {
  glGenFramebuffers(1, &drawn_);
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
  buffers_[0] = attach(GL_COLOR_ATTACHMENT0, format, kSamples, width, height);
  buffers_[1] = attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, kSamples, width, height);
  requireComplete(width, height);
  glGenFramebuffers(1, &resolved_);
  glBindFramebuffer(GL_FRAMEBUFFER, resolved_);
  buffers_[2] = attach(GL_COLOR_ATTACHMENT0, format, 0, width, height);
  requireComplete(width, height);
}

GlCanvas::~GlCanvas() {
  glDeleteFramebuffers(1, &drawn_);
  glDeleteFramebuffers(1, &resolved_);
  glDeleteRenderbuffers(3, buffers_);
}

void GlCanvas::begin(int x, int y, int width, int height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_);
  glViewport(0, 0, width_, height_);
  glEnable(GL_MULTISAMPLE);
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, width, height);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void GlCanvas::read(int x, int y, int width, int height, unsigned format, unsigned type,
                    void* to) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, drawn_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_);
  glBlitFramebuffer(x, y, x + width, y + height, x, y, x + width, y + height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, resolved_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(x, y, width, height, format, type, to);
}

GlDepthMap::GlDepthMap(int side) : side_(side) {
  glGenTextures(1, &texture_);
  glBindTexture(GL_TEXTURE_2D, texture_);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, side, side, 0, GL_DEPTH_COMPONENT,
               GL_UNSIGNED_INT, nullptr);
  constexpr float kFarthest[4] = {1.0F, 1.0F, 1.0F, 1.0F};
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, kFarthest);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glGenFramebuffers(1, &frame_);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  requireComplete(side, side);
}

GlDepthMap::~GlDepthMap() {
  glDeleteFramebuffers(1, &frame_);
  glDeleteTextures(1, &texture_);
}

void GlDepthMap::begin(int x, int y, int width, int height) const {
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glViewport(0, 0, side_, side_);
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, width, height);
  glClear(GL_DEPTH_BUFFER_BIT);
}

}  // namespace ringhook
