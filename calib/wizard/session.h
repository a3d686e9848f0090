#pragma once

/// \file
/// A calibration session on disk: what was answered and what was found, so that it can be left at
/// any moment (Ctrl-C, a lost terminal, a power cut) and taken up again at the same place. What is
/// done is what is there:
///
///   wizard.yaml                     the answers
///   board/ arm/ check/              pairs of pictures (shot_folder.h)
///   rig-stereo.yaml                 both cameras, accepted
///   rig-robot.yaml                  the same with fMc1
///   rig-time.yaml                   the same with the delays, or without if they stay unknown
///   rig.yaml cell.yaml              the end
///   report.json                     every step's figures
///   live.png                        the newest pair with what was found in it

#include <filesystem>
#include <optional>
#include <string>

#include "rig/stereo_rig.h"

namespace ringhook {

struct WizardAnswers {
  std::filesystem::path cell;    ///< cell file that names the devices, and the rest of the cell
  std::filesystem::path images;  ///< folder with board/ arm/ check/; empty: the cell's cameras
  std::string board;             ///< parseBoard's word
  std::uint64_t seed = 1;        ///< of a simulated cell
};

class Session {
 public:
  explicit Session(std::filesystem::path folder) : folder_(std::move(folder)) {}

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] std::filesystem::path file(const std::string& name) const { return folder_ / name; }

  /// Nothing if no session was begun here. Throws InputError naming file, line and field.
  [[nodiscard]] std::optional<WizardAnswers> answers() const;
  void keep(const WizardAnswers& answers) const;

  /// A rig that a step has left, or nothing. \param step stereo, robot or time.
  [[nodiscard]] std::optional<StereoRig> rig(const std::string& step) const;
  void keepRig(const std::string& step, const StereoRig& rig) const;
  /// Forgets the rigs of this step and of those that stand on it.
  void forgetFrom(const std::string& step) const;

  /// Puts figures (a JSON object as text) under `step` into report.json.
  void report(const std::string& step, const std::string& json) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace ringhook
