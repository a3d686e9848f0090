// Is the link in time? In one run, over real TCP connections on loopback:
// 1. how many of the controller's ticks stay without a command while a 50 Hz vision target is
//    served, by our client (clocked by feedback) and by a free-running 50 Hz client, each with a
//    controller of its own, for the same 60 s;
// 2. how long it takes from the controller's feedback on the wire to the command on the wire,
//    beside a bare echo of as many bytes: the floor that system and scheduler leave.
//   rx60_link_bench --seconds 60 --cycles 15000

#include <CLI/CLI.hpp>

#include "missed_ticks.h"
#include "wake_ups.h"

int main(int argc, char** argv) {
  double seconds = 60.0;
  int cycles = 15000;
  CLI::App app{"Measures the RX60 link on this machine"};
  app.add_option("--seconds", seconds, "Of the comparison")->check(CLI::PositiveNumber);
  app.add_option("--cycles", cycles, "Wake-ups to time")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  ringhook::bench::compareMissedTicks(seconds);
  ringhook::bench::compareWakeUps(cycles);
  return 0;
}
