#pragma once

/// \file
/// What really happened in the simulated cell, as tables in a folder of their own, apart from what
/// the loop knew. Seconds of the world's clock come first, units are in the column names, poses are
/// in f, quaternions x y z w; every number reads back as the same bits.
///
///     hooks.csv     one row an instant and hook: pose, velocity, swing angles, pivot, belt speed
///     rings.csv     one row an instant and ring out of the magazine: pose, who holds it, forces
///     arm.csv       one row an instant: joints as they are and as reported, flange, gripper
///     contacts.csv  one row an instant and contact that pressed in the last physics step
///     cameras.yaml  the rig as it truly stands, in rig.yaml's format
///
/// Rows go to temporary names at once and get their final ones from commit(), or from the
/// destructor, so that an interrupted run keeps what it had. Touches that came and went between
/// two instants are not in contacts.csv, but the impulses of rings.csv hold them.

#include <filesystem>
#include <memory>

#include "rig/stereo_rig.h"

namespace ringhook {

class CellWorld;

class TruthLog {
 public:
  /// Makes the folder and opens the tables. Throws InputError if that cannot be done or if
  /// `true_rig` is no valid rig. The world must outlive the log.
  TruthLog(const std::filesystem::path& folder, const CellWorld& world, const StereoRig& true_rig);
  /// Commits what was not committed; a failure is then silent.
  ~TruthLog();
  TruthLog(const TruthLog&) = delete;
  TruthLog& operator=(const TruthLog&) = delete;

  /// Adds the rows of this very instant. Calls at an instant already logged do nothing.
  void sample();
  /// Gives the tables their names; nothing may be sampled afterwards. Throws Error (disk full).
  void commit();

 private:
  struct Tables;
  const CellWorld& world_;
  std::unique_ptr<Tables> tables_;  ///< null once committed
};

}  // namespace ringhook
