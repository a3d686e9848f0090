#pragma once

/// \file
/// Switches an RX60's drives over the controller's system port: one request, one reply.

#include "robot/rx60/tcp_port.h"

namespace ringhook::rx60 {

/// Throws DeviceError if the controller cannot be reached, does not reply or refuses.
void setDrivePower(const ControllerAddress& address, bool on);

}  // namespace ringhook::rx60
