#include "sim/gige_server.h"

#include <arv.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <mutex>
#include <utility>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr double kTriggerLookHz = 200.0;  // how often a camera looks whether it was triggered
// Bootstrap register of GigE Vision: a client that is silent for longer loses control [ms]. A busy
// host draws pictures for seconds, in which the camera hears nothing.
constexpr guint32 kHeartbeatRegister = 0x0938;
constexpr guint32 kHeartbeat_ms = 30000;

ArvGvFakeCamera* newCamera(const std::string& address, int side, double lost_packets) {
  const char* serial = side == 0 ? "ringhook-left" : "ringhook-right";
  ArvGvFakeCamera* camera = arv_gv_fake_camera_new(address.c_str(), serial);
  if (camera == nullptr || !arv_gv_fake_camera_is_running(camera)) {
    g_clear_object(&camera);
    throw DeviceError("no camera can be served at " + address +
                      ", port 3956: expected a free address of this host's interfaces");
  }
  g_object_set(camera, "gvsp-lost-ratio", lost_packets, nullptr);
  return camera;
}

}  // namespace

struct GigeServer::Camera {
  Camera(const std::string& address, int which, double lost_packets, SharedTrigger& shared)
      : side(which), trigger(shared), device(newCamera(address, which, lost_packets)) {
    ArvFakeCamera* fake = arv_gv_fake_camera_get_fake_camera(device);
    arv_fake_camera_write_register(fake, kHeartbeatRegister, kHeartbeat_ms);
    arv_fake_camera_set_trigger_frequency(fake, kTriggerLookHz);
    arv_fake_camera_set_fill_pattern(fake, &Camera::fill, this);
  }
  ~Camera() { g_object_unref(device); }  // joins the camera's thread
  Camera(const Camera&) = delete;
  Camera& operator=(const Camera&) = delete;

  static void fill(ArvBuffer* buffer, void* self, guint32 exposure_us, guint32 /*gain*/,
                   ArvPixelFormat /*always Mono8*/) {
    static_cast<Camera*>(self)->expose(buffer, exposure_us);
  }

  /// Called from C: nothing may be thrown through it.
  void expose(ArvBuffer* buffer, guint32 exposure_us) noexcept {
    Window w;
    arv_buffer_get_image_region(buffer, &w.x, &w.y, &w.width, &w.height);
    // The size that Aravis tells is that of received images; this buffer holds its region.
    std::size_t received = 0;
    auto* pixels =
        static_cast<std::uint8_t*>(const_cast<void*>(arv_buffer_get_data(buffer, &received)));
    const auto size = static_cast<std::size_t>(w.width) * static_cast<std::size_t>(w.height);
    try {
      const std::optional<Exposed> exposed = trigger.expose(side, w, 1e-6 * exposure_us);
      if (exposed) {
        std::memcpy(pixels, exposed->image.pixels.data(),
                    std::min(size, exposed->image.pixels.size()));
        arv_buffer_set_timestamp(buffer, static_cast<guint64>(exposed->start_ns));
        ++sent;
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = std::current_exception();
    }
  }

  int side;
  SharedTrigger& trigger;
  ArvGvFakeCamera* device;
  std::atomic<std::int64_t> sent = 0;
  mutable std::mutex mutex;
  std::exception_ptr failure;  // guarded by mutex
};

GigeServer::GigeServer(const GigeServerOptions& options, PairSource source)
    : trigger_(std::move(source)) {
  cameras_[0] = std::make_unique<Camera>(options.left_address, 0, options.lost_packets, trigger_);
  cameras_[1] = std::make_unique<Camera>(options.right_address, 1, options.lost_packets, trigger_);
  waker_ = std::make_unique<CameraWaker>(
      std::vector<std::string>{options.left_address, options.right_address});
}

GigeServer::~GigeServer() { trigger_.close(); }

std::int64_t GigeServer::sent(int side) const { return cameras_[side]->sent; }

void GigeServer::rethrowFailure() const {
  for (const auto& camera : cameras_) {
    const std::lock_guard lock(camera->mutex);
    if (camera->failure) {
      std::rethrow_exception(camera->failure);
    }
  }
}

}  // namespace ringhook
