#pragma once

/// \file
/// Keeps Aravis's fake cameras in time. Between two pictures their thread polls its sockets for
/// what is left until the next one, an unsigned difference: looked at a microsecond after the
/// picture was due it is huge, is cut to 100 ms, and five pictures at 50 Hz are left out (Aravis
/// 0.8.26, arvgvfakecamera.c; measured: intervals of 120 ms, one in a hundred). A packet on the
/// control port ends that poll, so each camera is asked for its first register every few
/// milliseconds (READREG of GigE Vision's control protocol, permitted to everybody).

#include <string>
#include <thread>
#include <vector>

#include "sim/tcp_listener.h"

namespace ringhook {

class CameraWaker {
 public:
  /// \param addresses numeric IPv4 addresses of the cameras. Throws DeviceError naming the one that
  /// no packet can be sent to.
  explicit CameraWaker(const std::vector<std::string>& addresses);
  ~CameraWaker();
  CameraWaker(const CameraWaker&) = delete;
  CameraWaker& operator=(const CameraWaker&) = delete;

 private:
  void run();

  std::vector<FileDescriptor> sockets_;
  FileDescriptor end_;  ///< an eventfd that ends the thread
  std::thread thread_;
};

}  // namespace ringhook
