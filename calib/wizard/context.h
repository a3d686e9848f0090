#pragma once

/// \file
/// What the wizard's steps share: the dialogue, the session, the cell and where its pictures come
/// from. One step leads to the next through the session's files alone, so that each can be taken up
/// again by itself.

#include <functional>
#include <memory>
#include <string>

#include "calib/solve/board.h"
#include "calib/solve/stereo_problem.h"
#include "calib/wizard/console.h"
#include "calib/wizard/live_view.h"
#include "calib/wizard/place.h"
#include "calib/wizard/session.h"
#include "cycle/cell_config.h"

namespace ringhook {

/// Makes a hook that shows the progress of a long computation under this name.
using HookMaker = std::function<StepHook(const std::string& what)>;

class WizardContext {
 public:
  /// \param check called often; throws Interrupted when the operator asks to stop.
  WizardContext(Console& console, const Session& session, WizardAnswers answers, LiveView& view,
                HookMaker progress, std::function<void()> check);

  Console& console;
  const Session& session;
  const WizardAnswers answers;
  LiveView& view;
  const HookMaker progress;
  const CellConfig cell;
  const Board board;
  const StereoRig
      rough;  ///< about how the cameras stand, where the cell file names a rig; or empty

  /// Where the pictures of one part come from, board, arm or check: the cell, opened once, or that
  /// folder of the stored images. Throws what opening throws.
  CalibrationPlace& place(const std::string& part);
  /// Whether there are stored images for a part; true for a cell.
  [[nodiscard]] bool has(const std::string& part) const;
  [[nodiscard]] bool stored() const { return !answers.images.empty(); }

 private:
  std::function<void()> check_;
  std::unique_ptr<CalibrationPlace> place_;
  std::string part_;  ///< of the stored place that is open
};

}  // namespace ringhook
