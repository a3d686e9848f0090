#include "camera/arv_device.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr std::uint16_t kControlPort = 3956;  // GVCP, registered with IANA

bool isAddress(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

/// This host's address on the way to `device`, as the routing table has it: a datagram socket is
/// connected and asked, nothing is sent.
std::string localAddressTowards(const std::string& device) {
  sockaddr_in remote{};
  remote.sin_family = AF_INET;
  remote.sin_port = htons(kControlPort);
  inet_pton(AF_INET, device.c_str(), &remote.sin_addr);
  const int socket_number = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in local{};
  socklen_t size = sizeof local;
  const bool found =
      socket_number >= 0 &&
      connect(socket_number, reinterpret_cast<const sockaddr*>(&remote), sizeof remote) == 0 &&
      getsockname(socket_number, reinterpret_cast<sockaddr*>(&local), &size) == 0;
  if (socket_number >= 0) {
    close(socket_number);
  }
  if (!found) {
    throw DeviceError("camera " + device + ": this host has no way to that address");
  }
  char text[INET_ADDRSTRLEN] = {};
  inet_ntop(AF_INET, &local.sin_addr, text, sizeof text);
  return text;
}

}  // namespace

void ArvError::require(const std::string& what) {
  if (error_ != nullptr) {
    throw DeviceError("camera " + device_ + ": " + what + ": " + error_->message);
  }
}

Owned<ArvDevice> openArvDevice(const std::string& name) {
  ArvError error(name);
  if (!isAddress(name)) {
    arv_update_device_list();
    Owned<ArvDevice> device(arv_open_device(name.c_str(), error.out()));
    error.require("cannot be opened by its serial number");
    if (!device) {
      throw DeviceError("camera " + name + ": no camera with this serial number answers");
    }
    return device;
  }
  const Owned<GInetAddress> here(g_inet_address_new_from_string(localAddressTowards(name).c_str()));
  const Owned<GInetAddress> there(g_inet_address_new_from_string(name.c_str()));
  Owned<ArvDevice> device(arv_gv_device_new(here.get(), there.get(), error.out()));
  error.require("cannot be opened");
  return device;
}

RegionLimits regionLimits(ArvCamera* camera, const std::string& device) {
  ArvError error(device);
  RegionLimits limits;
  arv_camera_get_sensor_size(camera, &limits.sensor_width, &limits.sensor_height, error.out());
  error.require("does not tell its sensor's size");
  int largest = 0;
  arv_camera_get_width_bounds(camera, &limits.x.smallest, &largest, error.out());
  error.require("does not tell its smallest width");
  arv_camera_get_height_bounds(camera, &limits.y.smallest, &largest, error.out());
  error.require("does not tell its smallest height");
  const auto step = [&](gint (*get)(ArvCamera*, GError**)) {
    const int value = get(camera, error.out());
    return error.failed() || value < 1 ? 1 : value;
  };
  limits.x.size = step(&arv_camera_get_width_increment);
  limits.y.size = step(&arv_camera_get_height_increment);
  limits.x.offset = step(&arv_camera_get_x_offset_increment);
  limits.y.offset = step(&arv_camera_get_y_offset_increment);
  return limits;
}

std::int64_t underrunsOf(ArvStream* stream) {
  guint64 completed = 0;
  guint64 failures = 0;
  guint64 underruns = 0;
  arv_stream_get_statistics(stream, &completed, &failures, &underruns);
  return static_cast<std::int64_t>(underruns);
}

}  // namespace ringhook
