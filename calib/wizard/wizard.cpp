#include "calib/wizard/wizard.h"

#include <array>

#include "calib/wizard/board_pairs.h"
#include "calib/wizard/shot_folder.h"
#include "calib/wizard/steps.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

constexpr auto kUsualBoard = "chessboard:9x6:30mm";

/// The sentence of what `read` throws; empty if it is content.
template <class Read>
std::string faultOf(Read read) {
  try {
    read();
    return {};
  } catch (const InputError& e) {
    return e.what();
  }
}

std::string boardFault(const std::string& text) {
  return faultOf([&text] { (void)parseBoard(text); });
}

std::string cellFault(const std::string& text) {
  return faultOf([&text] { (void)loadCellConfig(text); });
}

WizardAnswers askedAnswers(const WizardOptions& options, Console& console) {
  WizardAnswers answers;
  answers.cell = options.cell ? *options.cell
                              : fs::path(console.ask("Which cell? Its cell file, please; what is "
                                                     "not known yet is filled in by this wizard.",
                                                     options.default_cell.string(), cellFault));
  answers.images = options.images.value_or(fs::path());
  answers.board = options.board ? *options.board
                                : console.ask(
                                      "Which board will you hold into view? Kind, inner corners, "
                                      "side of a square, as measured.",
                                      kUsualBoard, boardFault);
  answers.seed = options.seed.value_or(1);
  const Board board = parseBoard(answers.board);
  const CellConfig cell = loadCellConfig(answers.cell);
  if (answers.images.empty() && cell.devices.kind == DeviceKind::kSimulated &&
      board.kind != BoardKind::kChessboard) {
    throw InputError("--board " + answers.board +
                     ": in the simulated cell a chessboard is expected");
  }
  if (!answers.images.empty() && !isFolder(answers.images / "board")) {
    throw InputError(answers.images.string() +
                     ": expected a folder with board/left and board/right");
  }
  answers.cell = fs::absolute(answers.cell);
  if (!answers.images.empty()) {
    answers.images = fs::absolute(answers.images);
  }
  return answers;
}

/// A session is of one cell and one board: other words on the command line are a mistake.
void checkSame(const WizardOptions& options, const WizardAnswers& kept, const fs::path& folder) {
  const auto refuse = [&folder](const std::string& option, const std::string& was) {
    throw InputError(option + ": the session in " + folder.string() + " was begun with " + was +
                     "; take that, or another --session");
  };
  if (options.cell && fs::absolute(*options.cell) != kept.cell) {
    refuse("--cell", kept.cell.string());
  }
  if (options.board && toString(parseBoard(*options.board)) != toString(parseBoard(kept.board))) {
    refuse("--board", kept.board);
  }
  if (options.images && fs::absolute(*options.images) != kept.images) {
    refuse("--images", kept.images.empty() ? "the cell's cameras" : kept.images.string());
  }
  if (options.seed && *options.seed != kept.seed) {
    refuse("--seed", std::to_string(kept.seed));
  }
}

WizardAnswers answersFor(const WizardOptions& options, const Session& session, Console& console) {
  if (const auto kept = session.answers()) {
    checkSame(options, *kept, session.folder());
    console.say("Taking up the session in " + session.folder().string() + ": board " + kept->board +
                ", cell " + kept->cell.filename().string() + ".");
    return *kept;
  }
  const WizardAnswers answers = askedAnswers(options, console);
  session.keep(answers);
  return answers;
}

struct Step {
  const char* name;
  const char* pictures;  ///< folder; null: none
  void (*run)(WizardContext&);
};

constexpr std::array<Step, 4> kSteps = {{{"stereo", "board", stereoStep},
                                         {"robot", "arm", robotStep},
                                         {"time", nullptr, timeStep},
                                         {"check", "check", checkStep}}};

/// Takes back a step and all after it.
void forget(const Session& session, const std::string& first) {
  session.forgetFrom(first);
  bool from_here = false;
  for (const Step& step : kSteps) {
    from_here = from_here || first == step.name;
    if (from_here && step.pictures != nullptr) {
      ShotFolder(session.file(step.pictures), std::string(step.pictures) == "arm").clear();
    }
  }
}

/// True if the wizard may go on to the next step.
bool runStep(WizardContext& context, const Step& step, const WizardOptions& options) {
  if (context.session.rig(step.name)) {
    context.console.say("Done before: " + std::string(step.name) + " (rig-" + step.name +
                        ".yaml).");
  } else {
    step.run(context);
  }
  return !options.until || *options.until != step.name;
}

}  // namespace

const std::vector<std::string>& wizardSteps() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Step& step : kSteps) {
      all.emplace_back(step.name);
    }
    return all;
  }();
  return names;
}

StereoViews takeBoardPairs(const WizardOptions& options, Console& console,
                           const HookMaker& progress, const std::function<void()>& check) {
  const Session session(options.session);
  const WizardAnswers answers = answersFor(options, session, console);
  LiveView view(session.file("live.png"), options.window && LiveView::displayAtHand());
  WizardContext context(console, session, answers, view, progress, check);
  console.say("Every pair of pictures is kept in " + session.file("board").string() +
              " and shown in " + session.file("live.png").string() + ".");
  BoardPairsOptions pairs;
  pairs.part = "board";
  return takeBoardPairs(context, pairs);
}

void runWizard(const WizardOptions& options, Console& console, const HookMaker& progress,
               const std::function<void()>& check) {
  console.say(
      "This wizard sets up a cell: two cameras, an arm, and the delays between them. Leave "
      "it\nwhenever you like; what was done is kept in " +
      options.session.string() + ".");
  const Session session(options.session);
  const WizardAnswers answers = answersFor(options, session, console);
  if (options.again) {
    forget(session, *options.again);
  }
  LiveView view(session.file("live.png"), options.window && LiveView::displayAtHand());
  WizardContext context(console, session, answers, view, progress, check);
  console.say("Every pair of pictures is shown in " + session.file("live.png").string() + ".");
  for (const Step& step : kSteps) {
    if (!runStep(context, step, options)) {
      console.say(
          "That was the last step asked for; without --until the wizard goes on from here.");
      return;
    }
  }
  finishStep(context, options.accepted_rigs, options.date, options.version);
}

}  // namespace ringhook
