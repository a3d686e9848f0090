#include "sim/renderer.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "sim/egl_context.h"
#include "sim/gl_canvas.h"
#include "sim/scene_programs.h"
#include "sim/solid_batches.h"

namespace ringhook {
namespace {

constexpr double kNear = 0.10;  // [m]
constexpr double kFar = 8.0;    // [m]
constexpr double kBiasTexels = 2.0;
constexpr int kSmallestMap = 16;  // shadow map where none is wanted [px]
// What the lamps' shadows have to cover, in f [m].
const Eigen::Vector3d kShadowFrom(-1.0, -1.3, 0.0);
const Eigen::Vector3d kShadowTo(1.1, 1.3, 1.40);

/// Clip coordinates of points in f that are given from the camera's place. Rows go downwards on
/// the canvas, from the plane's first one.
Eigen::Matrix4d clipFromEye(const Pinhole& eye, const Window& plane) {
  const double f = eye.focal_px;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Zero();
  clip(0, 0) = 2.0 * f / plane.width;
  clip(0, 2) = -2.0 * (plane.x - 0.5) / plane.width - 1.0;
  clip(1, 1) = 2.0 * f / plane.height;
  clip(1, 2) = -2.0 * (plane.y - 0.5) / plane.height - 1.0;
  clip(2, 2) = (kFar + kNear) / (kFar - kNear);
  clip(2, 3) = -2.0 * kFar * kNear / (kFar - kNear);
  clip(3, 2) = 1.0;
  Eigen::Matrix4d turn = Eigen::Matrix4d::Identity();
  turn.topLeftCorner<3, 3>() = eye.fMc.linear().transpose();
  return clip * turn;
}

/// Clip coordinates of points in f as the key lamp sees them: a box around the cell, -1 to 1.
Eigen::Matrix4d clipFromKey(const Eigen::Vector3d& towards_key) {
  const Eigen::Vector3d z = -towards_key;
  const Eigen::Vector3d x = z.unitOrthogonal();
  Eigen::Matrix3d turn;
  turn << x.transpose(), z.cross(x).transpose(), z.transpose();
  const Eigen::Vector3d middle = turn * (0.5 * (kShadowFrom + kShadowTo));
  const Eigen::Vector3d half = turn.cwiseAbs() * (0.5 * (kShadowTo - kShadowFrom));
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity();
  clip.topLeftCorner<3, 3>() = half.cwiseInverse().asDiagonal() * turn;
  clip.topRightCorner<3, 1>() = -middle.cwiseQuotient(half);
  return clip;
}

}  // namespace

struct Renderer::Impl {
  Impl(const mjModel_& model, const SceneLight& lamps, int width, int height);
  ~Impl();
  void drawShadows(const std::vector<SeenPart>& seen);
  [[nodiscard]] ScenePrograms::View viewOf(const Pinhole& eye, const Window& plane) const;
  void chooseVisible(const Pinhole& eye, const Window& part);
  void drawPart(const GlCanvas& canvas, const Pinhole& eye, const Window& plane, const Window& part,
                bool colour);

  /// Ends what needs the context while it is current.
  struct Resources {
    Resources(const mjModel_& model, const SceneLight& light, int width, int height)
        : canvas(width, height, GL_R16),
          shadows(std::max(kSmallestMap, light.shadow_map_px)),
          batches(model),
          programs(light) {}
    GlCanvas canvas;
    GlDepthMap shadows;
    SolidBatches batches;
    ScenePrograms programs;
  };

  EglContext egl;
  SceneLight light;
  Eigen::Matrix4d key_clip;
  std::optional<Resources> gl;
  std::vector<Solid> solids;
  std::vector<char> wanted;
};

Renderer::Impl::Impl(const mjModel_& model, const SceneLight& lamps, int width, int height)
    : light(lamps), key_clip(clipFromKey(lamps.towards_key)) {
  const EglContext::Current current(egl);
  gl.emplace(model, light, width, height);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
}

Renderer::Impl::~Impl() {
  const EglContext::Current current(egl);
  gl.reset();
}

void Renderer::Impl::drawShadows(const std::vector<SeenPart>& seen) {
  const ShadowBox box{key_clip, gl->shadows.side()};
  const Window texels = shadowTexels(box, solids, seen);
  if (texels.empty()) {
    return;
  }
  gl->shadows.begin(texels.x, texels.y, texels.width, texels.height);
  gl->programs.useDepth(key_clip.cast<float>());
  glDisable(GL_CULL_FACE);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2.0F, 8.0F);
  wanted.resize(solids.size());
  std::transform(solids.begin(), solids.end(), wanted.begin(), [&](const Solid& solid) {
    return static_cast<char>(!solid.isSheet() && throwsInto(solid, box, texels) ? 1 : 0);
  });
  gl->batches.draw(solids, wanted, Eigen::Vector3d::Zero(), [](TextureKind, bool) {});
  glDisable(GL_POLYGON_OFFSET_FILL);
  glEnable(GL_CULL_FACE);
}

/// What the programs have to know to draw the plane from the canvas's first pixel on.
ScenePrograms::View Renderer::Impl::viewOf(const Pinhole& eye, const Window& plane) const {
  Eigen::Matrix4d from_eye = Eigen::Matrix4d::Identity();
  from_eye.topRightCorner<3, 1>() = eye.fMc.translation();
  Eigen::Matrix4d map_from_clip = 0.5 * Eigen::Matrix4d::Identity();
  map_from_clip.topRightCorner<3, 1>().setConstant(0.5);
  map_from_clip(3, 3) = 1.0;
  const double metres_per_texel = 2.0 / (key_clip.row(0).head<3>().norm() * gl->shadows.side());
  ScenePrograms::View view;
  view.to_clip = clipFromEye(eye, plane).cast<float>();
  view.to_shadow = (map_from_clip * key_clip * from_eye).cast<float>();
  view.shadow_bias = static_cast<float>(kBiasTexels * metres_per_texel);
  view.white = kWhite / 65535.0F;
  return view;
}

void Renderer::Impl::chooseVisible(const Pinhole& eye, const Window& part) {
  const PlaneBox limit{part.x - 1.0, part.y - 1.0, static_cast<double>(part.x + part.width),
                       static_cast<double>(part.y + part.height)};
  wanted.resize(solids.size());
  for (std::size_t i = 0; i < solids.size(); ++i) {
    const PlaneBox box = footprint(solids[i], eye, limit);
    const bool seen = box.left <= limit.right && box.right >= limit.left &&
                      box.top <= limit.bottom && box.bottom >= limit.top;
    wanted[i] = seen ? 1 : 0;
  }
}

void Renderer::Impl::drawPart(const GlCanvas& canvas, const Pinhole& eye, const Window& plane,
                              const Window& part, bool colour) {
  canvas.begin(part.x - plane.x, part.y - plane.y, part.width, part.height);
  glFrontFace(GL_CW);  // rows go downwards
  glActiveTexture(GL_TEXTURE1);
  glBindTexture(GL_TEXTURE_2D, gl->shadows.texture());
  ScenePrograms::View view = viewOf(eye, {plane.x, plane.y, canvas.width(), canvas.height()});
  view.colour = colour;
  gl->programs.setView(view);
  chooseVisible(eye, part);
  gl->batches.draw(
      solids, wanted, eye.fMc.translation(),
      [this](TextureKind texture, bool specular) { gl->programs.use(texture, specular); });
}

Renderer::Renderer(const mjModel_& model, const SceneLight& light, int width, int height)
    : impl_(std::make_unique<Impl>(model, light, width, height)) {}
Renderer::~Renderer() = default;

void Renderer::setScene(const std::vector<Solid>& solids, const std::vector<SeenPart>& seen) {
  const EglContext::Current current(impl_->egl);
  impl_->solids = solids;
  if (impl_->light.shadow_map_px > 0) {
    impl_->drawShadows(seen);
  }
}

void Renderer::drawGrey(const Pinhole& eye, const Window& plane, const Window& part,
                        std::vector<std::uint16_t>& grey) {
  const EglContext::Current current(impl_->egl);
  const GlCanvas& canvas = impl_->gl->canvas;
  impl_->drawPart(canvas, eye, plane, part, false);
  grey.resize(static_cast<std::size_t>(part.width) * static_cast<std::size_t>(part.height));
  canvas.read(part.x - plane.x, part.y - plane.y, part.width, part.height, GL_RED,
              GL_UNSIGNED_SHORT, grey.data());
}

void Renderer::drawColour(const Pinhole& eye, const Window& plane, ColourImage& image) {
  const EglContext::Current current(impl_->egl);
  const GlCanvas canvas(plane.width, plane.height, GL_RGBA8);
  impl_->drawPart(canvas, eye, plane, plane, true);
  image.width = plane.width;
  image.height = plane.height;
  image.pixels.resize(4U * static_cast<std::size_t>(plane.width) *
                      static_cast<std::size_t>(plane.height));
  canvas.read(0, 0, plane.width, plane.height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
}

}  // namespace ringhook
