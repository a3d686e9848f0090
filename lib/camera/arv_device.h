#pragma once

/// \file
/// Aravis's objects with an owner, its errors as exceptions, and how a device is opened. Includes
/// Aravis: for the .cpp files of camera only.

#include <arv.h>

#include <cstdint>
#include <memory>
#include <string>

#include "camera/readout_region.h"

namespace ringhook {

template <class T>
struct Unref {
  void operator()(T* object) const { g_object_unref(object); }
};
template <class T>
using Owned = std::unique_ptr<T, Unref<T>>;

/// What Aravis says went wrong; to be passed where it takes a GError**, then looked at once.
class ArvError {
 public:
  /// \param device as the user named it; must outlive this.
  explicit ArvError(const std::string& device) : device_(device) {}
  ~ArvError() { g_clear_error(&error_); }
  ArvError(const ArvError&) = delete;
  ArvError& operator=(const ArvError&) = delete;

  GError** out() {
    g_clear_error(&error_);
    return &error_;
  }
  /// Throws DeviceError naming the device if the last call failed.
  void require(const std::string& what);
  [[nodiscard]] bool failed() const { return error_ != nullptr; }
  /// The device was asked several times and answered nothing.
  [[nodiscard]] bool timedOut() const {
    return g_error_matches(error_, ARV_DEVICE_ERROR, ARV_DEVICE_ERROR_TIMEOUT) != FALSE;
  }

 private:
  const std::string& device_;
  GError* error_ = nullptr;
};

/// By IPv4 address, or by serial number, which broadcasts. Throws DeviceError naming it.
Owned<ArvDevice> openArvDevice(const std::string& name);

/// Sensor and region as the camera tells them. Throws DeviceError naming `device`.
RegionLimits regionLimits(ArvCamera* camera, const std::string& device);

/// Images for which no buffer was free, since the stream was opened.
std::int64_t underrunsOf(ArvStream* stream);

}  // namespace ringhook
