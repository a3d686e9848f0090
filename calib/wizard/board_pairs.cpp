#include "calib/wizard/board_pairs.h"

#include <algorithm>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kMostMisses = 12;      // simulated holds in a row without the board
constexpr double kUsualFocal = 1.2;  // per image width, where nothing better is known

enum class Wish { kTake, kSkip, kDone };

class BoardPairs {
 public:
  BoardPairs(WizardContext& context, const BoardPairsOptions& options)
      : context_(context),
        options_(options),
        folder_(context.session.file(options.part), false),
        place_(context.place(options.part)) {
    if (folder_.count() > 0) {
      views_ = findViews(folder_.allLeft(), folder_.allRight(), context.board,
                         context.progress("finding the board in " +
                                          std::to_string(folder_.count()) + " pairs kept"));
    }
    coverage_ = options.begin_from;
    for (const StereoView& view : views_.usable) {
      coverage_.add(appearanceOf(view, context.board, focal(view.width)));
    }
    if (!views_.usable.empty()) {
      say(std::to_string(views_.usable.size()) + " pairs are there already.");
    }
  }

  StereoViews take() {
    if (context_.stored()) {
      takeStored();
    } else if (place_.canHoldBoard()) {
      takeHeld();
    } else {
      takeAsked();
    }
    return std::move(views_);
  }

 private:
  void say(const std::string& text) const { context_.console.say(text); }

  [[nodiscard]] double focal(int width) const {
    return context_.rough.right ? context_.rough.left.K(0, 0) : kUsualFocal * width;
  }
  [[nodiscard]] bool enough() const {
    return static_cast<int>(views_.usable.size()) >= options_.goal &&
           (!options_.coverage || coverage_.lacking().empty());
  }

  void takeStored() {
    const std::size_t had = folder_.count();
    for (std::size_t i = 0; auto frame = place_.takePair(); ++i) {
      if (i >= had) {
        (void)keep(*frame, true);
      }
    }
  }

  void takeHeld() {
    int misses = 0;
    for (int turn = 0; !enough() && turn < 3 * options_.goal; ++turn) {
      const Hold hold = nextHold(coverage_);
      place_.holdBoard(context_.rough.fMc1.value() *
                       heldPose(hold, context_.rough, context_.board));
      const auto frame = place_.takePair();
      if (frame && keep(*frame, false)) {
        misses = 0;
        continue;
      }
      ++coverage_.centres.at(static_cast<std::size_t>(hold.third));  // on to the next place
      ++misses;
      if (misses > kMostMisses) {
        throw Error(
            "the board is not seen wherever it is held: does the cell file's rig say where "
            "the cameras stand?");
      }
    }
    place_.holdBoard(std::nullopt);
  }

  void takeAsked() {
    while (true) {
      if (enough()) {
        say("That is enough; more pairs do no harm.");
      }
      const Wish wish = asked();
      if (wish == Wish::kDone) {
        return;
      }
      if (wish == Wish::kTake) {
        const auto frame = place_.takePair();
        if (frame && keep(*frame, false) && options_.coverage) {
          say(coverage_.drawing());
        }
      } else {
        ++coverage_.centres.at(static_cast<std::size_t>(nextHold(coverage_).third));
      }
    }
  }

  Wish asked() {
    say("Pair " + std::to_string(views_.usable.size() + 1) + ": hold the board in the " +
        words(nextHold(coverage_)) + ".");
    const std::string answer = context_.console.ask(
        "Enter: take the pair; s: another place; d: done; q: leave and go on later", "take",
        [](const std::string& text) -> std::string {
          return text == "take" || text == "s" || text == "d" || text == "q"
                     ? ""
                     : "Please press Enter, or answer s, d or q.";
        });
    if (answer == "q") {
      throw Interrupted("left; the same command goes on from here");
    }
    const std::string missing = coverage_.lacking();
    if (answer == "d" && options_.coverage && !missing.empty() &&
        !context_.console.confirm("Still missing: " + missing + ". Go on without?", false)) {
      return Wish::kSkip;
    }
    return answer == "take" ? Wish::kTake : answer == "s" ? Wish::kSkip : Wish::kDone;
  }

  /// True if the board was found in both pictures. \param whatever keeps also pairs without it.
  bool keep(const StereoFrame& frame, bool whatever) {
    StereoView view;
    view.left_name = folder_.left(folder_.count()).filename().string();
    view.right_name = view.left_name;
    view.width = frame.left.width;
    view.height = frame.left.height;
    const auto left = findBoard(frame.left, context_.board);
    const auto right = findBoard(frame.right, context_.board);
    context_.view.show(frame, left ? left->pixels : std::vector<Eigen::Vector2d>{},
                       right ? right->pixels : std::vector<Eigen::Vector2d>{});
    if (!left || !right) {
      const std::string reason =
          !left ? "left picture: " + left.reason() : "right picture: " + right.reason();
      say("not used, " + reason);
      if (whatever) {
        folder_.add(frame.left, frame.right);
        views_.rejected.push_back({view.left_name, view.right_name, reason});
      }
      return false;
    }
    view.left = *left;
    view.right = orderedLike(*left, *right, context_.board);
    folder_.add(frame.left, frame.right);
    coverage_.add(appearanceOf(view, context_.board, focal(view.width)));
    say("pair " + std::to_string(views_.usable.size() + 1) + ": " +
        std::to_string(view.left.ids.size()) + " points on the left, " +
        std::to_string(view.right.ids.size()) + " on the right");
    views_.usable.push_back(std::move(view));
    return true;
  }

  WizardContext& context_;
  BoardPairsOptions options_;
  ShotFolder folder_;
  CalibrationPlace& place_;
  StereoViews views_;
  Coverage coverage_;
};

}  // namespace

Coverage coverageOf(const StereoViews& views, const WizardContext& context) {
  Coverage coverage;
  for (const StereoView& view : views.usable) {
    const double focal =
        context.rough.right ? context.rough.left.K(0, 0) : kUsualFocal * view.width;
    coverage.add(appearanceOf(view, context.board, focal));
  }
  return coverage;
}

StereoViews takeBoardPairs(WizardContext& context, const BoardPairsOptions& options) {
  return BoardPairs(context, options).take();
}

}  // namespace ringhook
