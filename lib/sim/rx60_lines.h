#pragma once

/// \file
/// The wires between a simulated controller and its client, one pair for each TCP port, where
/// faults are put: the same for the port in virtual time (controller_port.h) and for the server on
/// real sockets (rx60_server.h).

#include "sim/line_faults.h"
#include "sim/rx60_controller.h"

namespace ringhook {

class Rx60Lines {
 public:
  Rx60Lines() = default;
  Rx60Lines(const Rx60Lines&) = delete;
  Rx60Lines& operator=(const Rx60Lines&) = delete;

  [[nodiscard]] virtual FaultyLine& toClient(Rx60Socket socket) = 0;
  [[nodiscard]] virtual FaultyLine& toController(Rx60Socket socket) = 0;
  /// The controller closes a connection; nothing if there is none.
  virtual void cut(Rx60Socket socket) = 0;

 protected:
  ~Rx60Lines() = default;
};

}  // namespace ringhook
