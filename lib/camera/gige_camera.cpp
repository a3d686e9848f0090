#include "camera/gige_camera.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstring>
#include <utility>

#include "camera/arv_device.h"
#include "core/error.h"
#include "core/thread_priority.h"

namespace ringhook {
namespace {

std::int64_t steadyMinusReal_ns() {
  const auto steady = std::chrono::steady_clock::now().time_since_epoch();
  const auto real = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::nanoseconds(steady).count() - std::chrono::nanoseconds(real).count();
}

/// A free-running camera that sends nothing for longer is taken for gone [s].
constexpr std::int64_t kGone_s = 3;

std::int64_t steady_s() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::seconds(1);
}

/// On the thread that puts packets together: a full socket drops them.
void onStream(void* heard_s, ArvStreamCallbackType type, ArvBuffer* /*buffer*/) {
  if (type == ARV_STREAM_CALLBACK_TYPE_INIT) {
    thread_local const RaisedPriority raised(kCameraRank);
    static_cast<void>(raised.reached());
  }
  *static_cast<std::atomic<std::int64_t>*>(heard_s) = steady_s();
}

}  // namespace

struct GigeCamera::Impl {
  explicit Impl(const GigeCameraOptions& o);
  ~Impl();

  void setUp();
  void setTrigger();
  void require(ArvError& error, const std::string& what);
  void openStream();
  GigeImage imageOf(ArvBuffer* buffer);
  static void onControlLost(ArvDevice*, gpointer impl) {
    static_cast<Impl*>(impl)->control_lost = true;
  }

  GigeCameraOptions options;
  std::atomic<std::int64_t> heard_s = 0;  ///< last sign of its stream; host's steady clock [s]
  Owned<ArvDevice> device;
  Owned<ArvCamera> camera;
  Owned<ArvStream> stream;
  RegionLimits limits;
  Window region;
  double exposure_s = 0.0;
  bool streaming = false;
  gulong control_signal = 0;
  std::atomic<bool> control_lost = false;
  bool silent = false;  ///< a setting was not answered
  std::atomic<std::int64_t> images = 0;
  std::atomic<std::int64_t> broken = 0;
  std::atomic<std::int64_t> unwanted = -1;  ///< underruns before the first take(); -1: none yet
};

GigeCamera::Impl::Impl(const GigeCameraOptions& o) : options(o), device(openArvDevice(o.device)) {
  ArvError error(options.device);
  camera.reset(arv_camera_new_with_device(device.get(), error.out()));
  error.require("is no camera");
  if (!arv_gv_device_is_controller(ARV_GV_DEVICE(device.get()))) {
    throw DeviceError("camera " + options.device + ": another program controls it");
  }
  control_signal =
      g_signal_connect(device.get(), "control-lost", G_CALLBACK(&Impl::onControlLost), this);
  limits = regionLimits(camera.get(), options.device);
  setUp();
  openStream();
}

GigeCamera::Impl::~Impl() {
  g_signal_handler_disconnect(device.get(), control_signal);
  const bool sends = streaming && options.trigger == CameraTrigger::kFreeRun;
  silent = silent || (sends && steady_s() - heard_s > kGone_s);
  if (streaming && !control_lost && !silent) {
    ArvError error(options.device);
    arv_camera_stop_acquisition(camera.get(), error.out());
    silent = error.timedOut();
  }
  if (control_lost || silent) {
    // Giving control back means asking again and again, for seconds. The camera takes it back by
    // itself (heartbeat), so what is held of it is left to the program's end.
    static_cast<void>(camera.release());
    static_cast<void>(device.release());
  }
}

/// As ArvError's, and remembers a camera that does not answer.
void GigeCamera::Impl::require(ArvError& error, const std::string& what) {
  silent = silent || error.timedOut();
  error.require(what);
}

void GigeCamera::Impl::setUp() {
  ArvError error(options.device);
  ArvCamera* c = camera.get();
  arv_camera_set_pixel_format(c, ARV_PIXEL_FORMAT_MONO_8, error.out());
  error.require("refuses grey images of 8 bits (PixelFormat Mono8)");
  arv_camera_set_acquisition_mode(c, ARV_ACQUISITION_MODE_CONTINUOUS, error.out());
  error.require("refuses to run continuously (AcquisitionMode)");
  if (arv_camera_is_exposure_auto_available(c, nullptr)) {
    arv_camera_set_exposure_time_auto(c, ARV_AUTO_OFF, error.out());
  }
  arv_camera_set_exposure_time(c, options.exposure_s * 1e6, error.out());
  error.require("refuses an exposure of " + std::to_string(options.exposure_s * 1e6) + " us");
  exposure_s = arv_camera_get_exposure_time(c, error.out()) * 1e-6;
  error.require("does not tell its exposure time");
  if (options.gain) {
    arv_camera_set_gain(c, *options.gain, error.out());
    error.require("refuses a gain of " + std::to_string(*options.gain));
  }
  setTrigger();
  for (const char* feature : {"PtpEnable", "GevIEEE1588"}) {  // SFNC 2.4 and before it
    if (options.follow_host_clock && arv_camera_is_feature_available(c, feature, nullptr)) {
      arv_camera_set_boolean(c, feature, TRUE, error.out());
      error.require(std::string("refuses to follow the host's clock (") + feature + ")");
    }
  }
  arv_camera_gv_set_packet_size_adjustment(c, ARV_GV_PACKET_SIZE_ADJUSTMENT_NEVER);
  arv_camera_gv_set_packet_size(c, options.packet_bytes, error.out());
  error.require("refuses packets of " + std::to_string(options.packet_bytes) + " bytes");
  region = {0, 0, limits.sensor_width / limits.x.size * limits.x.size,
            limits.sensor_height / limits.y.size * limits.y.size};
  arv_camera_set_region(c, 0, 0, region.width, region.height, error.out());
  error.require("refuses its full image as region");
}

void GigeCamera::Impl::setTrigger() {
  ArvError error(options.device);
  if (options.trigger == CameraTrigger::kFreeRun) {
    arv_camera_clear_triggers(camera.get(), error.out());
    error.require("refuses to run without trigger");
    return;
  }
  const bool software = options.trigger == CameraTrigger::kSoftware;
  const std::string source = software ? "Software" : options.line;
  arv_camera_set_trigger(camera.get(), source.c_str(), error.out());
  error.require("refuses the trigger source " + source);
}

/// Buffers hold a full image each: a change of the region's size needs no others.
void GigeCamera::Impl::openStream() {
  ArvError error(options.device);
  stream.reset(arv_camera_create_stream(camera.get(), &onStream, &heard_s, error.out()));
  error.require("opens no stream");
  const auto bytes = static_cast<std::size_t>(limits.sensor_width) *
                     static_cast<std::size_t>(limits.sensor_height);
  g_object_set(stream.get(), "socket-buffer", ARV_GV_STREAM_SOCKET_BUFFER_FIXED,
               "socket-buffer-size", static_cast<gint>(2 * bytes), nullptr);
  for (int i = 0; i < options.buffers; ++i) {
    arv_stream_push_buffer(stream.get(), arv_buffer_new_allocate(bytes));
  }
}

GigeImage GigeCamera::Impl::imageOf(ArvBuffer* buffer) {
  GigeImage result;
  Window& w = result.window;
  arv_buffer_get_image_region(buffer, &w.x, &w.y, &w.width, &w.height);
  std::size_t size = 0;
  const void* data = arv_buffer_get_data(buffer, &size);
  const auto expected = static_cast<std::size_t>(w.width) * static_cast<std::size_t>(w.height);
  const Window sensor{0, 0, limits.sensor_width, limits.sensor_height};
  if (arv_buffer_get_image_pixel_format(buffer) != ARV_PIXEL_FORMAT_MONO_8 || size < expected ||
      intersect(w, sensor) != w) {
    throw DeviceError("camera " + options.device + ": sent an image of " + std::to_string(w.width) +
                      " x " + std::to_string(w.height) + " in " + std::to_string(size) +
                      " bytes; expected 8-bit grey on its own sensor");
  }
  result.image = GrayImage(w.width, w.height);
  std::memcpy(result.image.pixels.data(), data, expected);
  result.stamp_ns = static_cast<std::int64_t>(arv_buffer_get_timestamp(buffer));
  const auto real_ns = static_cast<std::int64_t>(arv_buffer_get_system_timestamp(buffer));
  result.real_arrival = Time::fromNanoseconds(real_ns);
  result.arrival = Time::fromNanoseconds(real_ns + steadyMinusReal_ns());
  return result;
}

GigeCamera::GigeCamera(const GigeCameraOptions& options) : impl_(std::make_unique<Impl>(options)) {}
GigeCamera::~GigeCamera() = default;

const RegionLimits& GigeCamera::limits() const { return impl_->limits; }
double GigeCamera::exposure() const { return impl_->exposure_s; }
const Window& GigeCamera::region() const { return impl_->region; }

void GigeCamera::setRegion(const Window& region) {
  const Window& now = impl_->region;
  if (region == now) {
    return;
  }
  ArvError error(impl_->options.device);
  if (region.sameSize(now)) {
    ArvDevice* device = impl_->device.get();
    arv_device_set_integer_feature_value(device, "OffsetX", region.x, error.out());
    impl_->require(error, "refuses to move its region to column " + std::to_string(region.x));
    arv_device_set_integer_feature_value(device, "OffsetY", region.y, error.out());
    impl_->require(error, "refuses to move its region to row " + std::to_string(region.y));
  } else {
    const bool was_streaming = impl_->streaming;
    if (was_streaming) {
      stop();
    }
    ArvCamera* c = impl_->camera.get();
    arv_camera_set_region(c, region.x, region.y, region.width, region.height, error.out());
    impl_->require(error, "refuses a region of " + std::to_string(region.width) + " x " +
                              std::to_string(region.height));
    if (was_streaming) {
      start();
    }
  }
  impl_->region = region;
}

void GigeCamera::setFrameRate(double rate_hz) {
  if (impl_->options.trigger != CameraTrigger::kFreeRun) {
    return;  // what triggers it sets the rate
  }
  ArvError error(impl_->options.device);
  arv_camera_set_frame_rate(impl_->camera.get(), rate_hz, error.out());
  impl_->require(error, "refuses " + std::to_string(rate_hz) + " images a second");
}

void GigeCamera::start() {
  ArvError error(impl_->options.device);
  arv_camera_start_acquisition(impl_->camera.get(), error.out());
  impl_->require(error, "does not start");
  impl_->heard_s = steady_s();
  impl_->streaming = true;
}

void GigeCamera::stop() {
  ArvError error(impl_->options.device);
  arv_camera_stop_acquisition(impl_->camera.get(), error.out());
  impl_->require(error, "does not stop");
  impl_->streaming = false;
}

void GigeCamera::fire() {
  ArvError error(impl_->options.device);
  arv_camera_software_trigger(impl_->camera.get(), error.out());
  impl_->require(error, "does not take the software trigger");
}

std::optional<GigeImage> GigeCamera::take(double timeout_s) {
  const auto timeout_us = static_cast<std::uint64_t>(std::max(0.0, timeout_s) * 1e6);
  ArvStream* stream = impl_->stream.get();
  if (impl_->unwanted < 0) {
    impl_->unwanted = underrunsOf(impl_->stream.get());
  }
  ArvBuffer* buffer = timeout_us > 0 ? arv_stream_timeout_pop_buffer(stream, timeout_us)
                                     : arv_stream_try_pop_buffer(stream);
  if (buffer == nullptr) {
    if (impl_->control_lost) {
      throw DeviceError("camera " + impl_->options.device +
                        ": it no longer answers, or another program took control of it");
    }
    return std::nullopt;
  }
  // Back to the stream whatever happens.
  struct Giver {
    ArvStream* stream;
    ArvBuffer* buffer;
    ~Giver() { arv_stream_push_buffer(stream, buffer); }
  } const giver{stream, buffer};
  if (arv_buffer_get_status(buffer) != ARV_BUFFER_STATUS_SUCCESS) {
    ++impl_->broken;
    return std::nullopt;
  }
  ++impl_->images;
  return impl_->imageOf(buffer);
}

GigeCounts GigeCamera::counts() const {
  guint64 resent = 0;
  guint64 missing = 0;
  arv_gv_stream_get_statistics(ARV_GV_STREAM(impl_->stream.get()), &resent, &missing);
  GigeCounts counts;
  counts.images = impl_->images;
  counts.lost_images =
      impl_->broken +
      (impl_->unwanted < 0 ? 0 : underrunsOf(impl_->stream.get()) - impl_->unwanted);
  counts.resent_packets = static_cast<std::int64_t>(resent);
  counts.missing_packets = static_cast<std::int64_t>(missing);
  return counts;
}

}  // namespace ringhook
