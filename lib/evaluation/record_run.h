#pragma once

/// \file
/// The job of `ringhook record`: frames, arm states and, in a simulated cell, the truth, from a
/// cell's devices into a sequence folder. The windows stay as they are told, or follow a hook as
/// the servo task's vision does; then frames are stored while the hook's estimate is fit to act
/// upon. Reads no clock: on simulated devices everything it writes is a function of the cell file,
/// the scenario, the seed and the job, byte by byte.

#include <array>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/image.h"
#include "cycle/hook_sight.h"
#include "evaluation/cell_devices.h"

namespace ringhook {

struct RecordJob {
  std::filesystem::path cell_file;
  CellChoice choice;
  std::filesystem::path out;                     ///< sequence folder to make
  bool overwrite = false;                        ///< it may hold an earlier recording
  int frames = 0;                                ///< stored pairs; 0 for no limit
  double seconds = 10.0;                         ///< from the first stored frame [s]
  std::optional<double> rate_hz;                 ///< instead of the cell's own [Hz]
  std::optional<std::array<Window, 2>> windows;  ///< left, right; the full images without
  std::optional<TrackerKind> follow;             ///< a hook, by these features
  double wait_s = 60.0;                          ///< for the hook that is to be followed [s]
  std::string image_format = "png";              ///< png or pgm
  std::string name;                              ///< of the sequence; empty for the cell's
  std::string notes;                             ///< added to those that tell how it was made
  std::string licence;
};

struct RecordReport {
  std::size_t frames = 0;         ///< whole on the disk
  std::size_t left_out = 0;       ///< since the disk was too slow
  std::size_t missed = 0;         ///< numbers that the camera left out
  std::size_t without_truth = 0;  ///< simulated frames that show no hook
  std::size_t before = 0;         ///< frames without a hook well tracked, not stored
  double duration_s = 0.0;        ///< from the first to the last stored frame
  std::string target;             ///< name of the target's file in the folder
  std::string scenario;           ///< empty for a real cell
  bool interrupted = false;
};

/// Told after every arm state: the part that is done, and a short state.
using RecordProgress = std::function<void(double fraction, const std::string& note)>;

/// Throws InputError for bad files and a folder in use, Error when the disk is full (what was whole
/// is kept, and the sentence says how much) or when no hook came, DeviceError when a device fails.
/// An interruption is no error here.
RecordReport runRecord(const RecordJob& job, const std::atomic<bool>& stop,
                       const RecordProgress& progress);

}  // namespace ringhook
