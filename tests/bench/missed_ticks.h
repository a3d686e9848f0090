#pragma once

namespace ringhook::bench {

/// Serves a 50 Hz vision target for so long [s] with our client and, at the same time, with a
/// free-running 50 Hz client, each with a controller of its own over TCP on loopback; prints how
/// many of the controller's ticks stayed without a command.
void compareMissedTicks(double seconds);

}  // namespace ringhook::bench
