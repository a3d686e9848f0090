#include "calib/wizard/context.h"

#include <utility>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

StereoRig roughRig(const CellConfig& cell) {
  StereoRig rig;
  if (isFile(cell.rig)) {
    rig = loadRig(cell.rig);
  }
  return rig;
}

}  // namespace

WizardContext::WizardContext(Console& its_console, const Session& its_session,
                             WizardAnswers its_answers, LiveView& its_view, HookMaker its_progress,
                             std::function<void()> check)
    : console(its_console),
      session(its_session),
      answers(std::move(its_answers)),
      view(its_view),
      progress(std::move(its_progress)),
      cell(loadCellConfig(answers.cell)),
      board(parseBoard(answers.board)),
      rough(roughRig(cell)),
      check_(std::move(check)) {}

bool WizardContext::has(const std::string& part) const {
  return !stored() || isFolder(answers.images / part);
}

CalibrationPlace& WizardContext::place(const std::string& part) {
  if (stored()) {
    if (part != part_) {
      place_ = openStoredPlace(answers.images / part);
    }
  } else if (!place_ && cell.devices.kind == DeviceKind::kSimulated) {
    SimulatedPlaceOptions options;
    options.seed = answers.seed;
    options.board = {board.columns, board.rows, board.pitch_m};
    place_ = openSimulatedPlace(cell, options);
  } else if (!place_) {
    place_ = openNetworkPlace(cell);
  }
  part_ = part;
  place_->onStep(check_);
  return *place_;
}

}  // namespace ringhook
