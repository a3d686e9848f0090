#pragma once

/// \file
/// What a simulated RX60 controller saw, for people and for programs.

#include <nlohmann/json_fwd.hpp>

#include "core/time.h"
#include "sim/rx60_controller.h"
#include "sim/rx60_server.h"

namespace ringhook {

/// A line of the log: time since the start [s], then what happened; to stderr.
void sayEvent(Time now, const std::string& what);
/// Where the controller listens; to stderr.
void sayWhere(const Rx60Server& server, const std::string& address);

nlohmann::ordered_json controllerJson(const Rx60Counts& counts, std::int64_t late_ticks);
void printController(const Rx60Counts& counts, std::int64_t late_ticks);
/// One row of that table.
void printCount(const std::string& what, std::int64_t count);

}  // namespace ringhook
