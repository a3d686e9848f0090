#pragma once

/// \file
/// `ringhook simulate --cell`: the whole simulated cell as devices on a network, and at the end
/// what physics says became of the rings.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "sim/rx60_mishaps.h"

namespace ringhook {

struct CellJob {
  std::string cell;           ///< cell file, with devices on a network
  std::string scenario;       ///< name beside the cell's own; empty for the cell's own
  std::uint64_t seed = 1;     ///< of everything random
  int hooks = 0;              ///< on the belt, with a ring each; 0: as the scenario says
  bool belt_parked = false;   ///< no hooks, nothing moves but the arm: for calibrating
  double lost_packets = 0.0;  ///< share of image packets that are not sent
  double seconds = 0.0;       ///< how long to serve once a client has come [s]
  std::string truth;          ///< folder for the truth; empty: none
  std::vector<Mishap> mishaps;
};

/// Serves until Ctrl-C or the end of its time; returns what it saw. Throws InputError for bad
/// files, DeviceError for an address that cannot be had.
nlohmann::ordered_json serveCell(const CellJob& job);

}  // namespace ringhook
