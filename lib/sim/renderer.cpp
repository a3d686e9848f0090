#include "sim/renderer.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "core/error.h"
#include "sim/egl_context.h"

namespace ringhook {
namespace {

constexpr int kSmallSide = 640;   // buffer for search windows [px]
constexpr int kLargeSide = 1152;  // buffer for tiles of larger rectangles [px]
constexpr int kSamples = 4;
constexpr int kMaxGeoms = 4000;
constexpr double kNear = 0.05;  // [m]
constexpr double kFar = 8.0;    // [m]

void setVector(float* to, const Eigen::Vector3d& from) {
  for (int i = 0; i < 3; ++i) {
    to[i] = static_cast<float>(from[i]);
  }
}

/// MuJoCo gives the frustum the viewport's aspect about frustum_center: square pixels come out
/// exactly. A pixel reaches half a pixel to each side of its centre.
mjvGLCamera glCamera(const PlaneView& view) {
  const double scale = kNear / view.focal_px;
  const Window& w = view.window;
  mjvGLCamera camera{};
  setVector(camera.pos, view.wMc.translation());
  setVector(camera.forward, view.wMc.linear().col(2));
  setVector(camera.up, -view.wMc.linear().col(1));
  camera.frustum_center = static_cast<float>(scale * (w.x - 0.5 + 0.5 * w.width));
  camera.frustum_top = static_cast<float>(-scale * (w.y - 0.5));
  camera.frustum_bottom = static_cast<float>(-scale * (w.y - 0.5 + w.height));
  camera.frustum_near = static_cast<float>(kNear);
  camera.frustum_far = static_cast<float>(kFar);
  return camera;
}

GLuint attach(GLenum attachment, GLenum format, int samples, int side) {
  GLuint buffer = 0;
  glGenRenderbuffers(1, &buffer);
  glBindRenderbuffer(GL_RENDERBUFFER, buffer);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, side, side);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
  return buffer;
}

/// A multisampled canvas and the plain one it is resolved into. Used with its context current.
struct Canvas {
  int side = 0;
  GLuint drawn = 0;
  GLuint resolved = 0;
  std::array<GLuint, 3> buffers{};

  void create(int side_px) {
    side = side_px;
    glGenFramebuffers(1, &drawn);
    glBindFramebuffer(GL_FRAMEBUFFER, drawn);
    buffers[0] = attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, kSamples, side);
    buffers[1] = attach(GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, kSamples, side);
    glGenFramebuffers(1, &resolved);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved);
    buffers[2] = attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, 0, side);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      throw DeviceError("OpenGL refused a framebuffer of " + std::to_string(side) +
                        " px with multisampling");
    }
  }
  void destroy() {
    glDeleteFramebuffers(1, &drawn);
    glDeleteFramebuffers(1, &resolved);
    glDeleteRenderbuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  }
};

/// Whether a ball about the geom may reach into the view (planes always may).
bool mayShow(const mjvGeom& geom, const PlaneView& view) {
  if (geom.modelrbound <= 0.0F) {
    return true;
  }
  const Eigen::Vector3d centre_w =
      Eigen::Vector3f(geom.pos[0], geom.pos[1], geom.pos[2]).cast<double>();
  const Eigen::Vector3d p = view.wMc.inverse() * centre_w;
  const auto radius = static_cast<double>(geom.modelrbound);
  // Signed distance from the plane through the optical centre and an edge of the window.
  const auto inside = [&](double across, double edge_px, double sign) {
    const double slope = edge_px / view.focal_px;
    return sign * (across - slope * p.z()) / std::sqrt(1.0 + slope * slope) > -radius;
  };
  const Window& w = view.window;
  return inside(p.x(), w.x - 1, 1.0) && inside(p.x(), w.x + w.width, -1.0) &&
         inside(p.y(), w.y - 1, 1.0) && inside(p.y(), w.y + w.height, -1.0);
}

}  // namespace

struct Renderer::Impl {
  explicit Impl(const mjModel& m);
  ~Impl();
  /// Leaves in the scene only what the view may show.
  void cull(const PlaneView& view);
  void drawTile(const PlaneView& tile, int to_x, int to_y, ColourImage& image);

  const mjModel& model;
  EglContext egl;
  mjvScene scene{};
  mjvOption option{};
  mjrContext context{};
  Canvas small;
  Canvas large;
  std::vector<mjvGeom> geoms;         // all that updateScene took over
  std::vector<std::uint8_t> readout;  // bottom row first
};

Renderer::Impl::Impl(const mjModel& m) : model(m) {
  const EglContext::Current current(egl);
  mjv_defaultScene(&scene);
  mjv_defaultOption(&option);
  mjr_defaultContext(&context);
  mjv_makeScene(&model, &scene, kMaxGeoms);
  mjr_makeContext(&model, &context, mjFONTSCALE_50);
  mjr_setBuffer(mjFB_OFFSCREEN, &context);
  small.create(kSmallSide);
  large.create(kLargeSide);
  for (mjtByte& flag : scene.flags) {
    flag = 0;
  }
  scene.flags[mjRND_CULL_FACE] = 1;
}

Renderer::Impl::~Impl() {
  const EglContext::Current current(egl);
  small.destroy();
  large.destroy();
  mjr_freeContext(&context);
  mjv_freeScene(&scene);
}

void Renderer::Impl::cull(const PlaneView& view) {
  scene.ngeom = 0;
  for (const mjvGeom& geom : geoms) {
    if (mayShow(geom, view)) {
      scene.geoms[scene.ngeom++] = geom;
    }
  }
}

void Renderer::Impl::drawTile(const PlaneView& tile, int to_x, int to_y, ColourImage& image) {
  const Window& w = tile.window;
  const Canvas& canvas = std::max(w.width, w.height) <= kSmallSide ? small : large;
  glBindFramebuffer(GL_FRAMEBUFFER, canvas.drawn);
  scene.camera[0] = glCamera(tile);
  scene.camera[1] = scene.camera[0];
  const mjrRect area{0, 0, w.width, w.height};
  cull(tile);
  mjr_render(area, &scene, &context);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas.drawn);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, canvas.resolved);
  glBlitFramebuffer(0, 0, w.width, w.height, 0, 0, w.width, w.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, canvas.resolved);
  const std::size_t row_bytes = 4U * static_cast<std::size_t>(w.width);
  readout.resize(row_bytes * static_cast<std::size_t>(w.height));
  glReadPixels(0, 0, w.width, w.height, GL_RGBA, GL_UNSIGNED_BYTE, readout.data());
  for (int y = 0; y < w.height; ++y) {
    const std::size_t from = row_bytes * static_cast<std::size_t>(w.height - 1 - y);
    const std::size_t to =
        4U * (static_cast<std::size_t>(to_y + y) * static_cast<std::size_t>(image.width) +
              static_cast<std::size_t>(to_x));
    std::memcpy(&image.pixels[to], &readout[from], row_bytes);
  }
}

Renderer::Renderer(const mjModel& model) : impl_(std::make_unique<Impl>(model)) {}
Renderer::~Renderer() = default;

void Renderer::updateScene(mjData& data) {
  mjvCamera any;
  mjv_defaultCamera(&any);
  mjv_updateScene(&impl_->model, &data, &impl_->option, nullptr, &any, mjCAT_ALL, &impl_->scene);
  impl_->geoms.assign(impl_->scene.geoms, impl_->scene.geoms + impl_->scene.ngeom);
}

void Renderer::draw(const PlaneView& view, ColourImage& image) {
  const EglContext::Current current(impl_->egl);
  const Window& w = view.window;
  image.width = w.width;
  image.height = w.height;
  image.pixels.resize(4U * static_cast<std::size_t>(w.width) * static_cast<std::size_t>(w.height));
  const int side = std::max(w.width, w.height) <= kSmallSide ? kSmallSide : kLargeSide;
  for (int y = 0; y < w.height; y += side) {
    for (int x = 0; x < w.width; x += side) {
      PlaneView tile = view;
      tile.window = {w.x + x, w.y + y, std::min(side, w.width - x), std::min(side, w.height - y)};
      impl_->drawTile(tile, x, y, image);
    }
  }
}

}  // namespace ringhook
