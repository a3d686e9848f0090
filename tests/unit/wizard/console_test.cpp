#include "calib/wizard/console.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <array>

#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

/// Answers typed beforehand, and what the console says to them.
class Dialogue : public ::testing::Test {
 protected:
  Dialogue() {
    EXPECT_EQ(::pipe(in_.data()), 0);
    EXPECT_EQ(::pipe(out_.data()), 0);
  }
  ~Dialogue() override {
    for (const int end : {in_[0], in_[1], out_[0], out_[1]}) {
      ::close(end);
    }
  }
  void typed(const std::string& text) {
    EXPECT_EQ(::write(in_[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  void inputEnds() {
    ::close(in_[1]);
    in_[1] = -1;
  }
  std::string said() {
    std::array<char, 4096> bytes{};
    const ssize_t count = ::read(out_[0], bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(0, count))};
  }
  Console console(std::function<void()> step = [] {}) { return {in_[0], out_[1], std::move(step)}; }

  std::array<int, 2> in_{};
  std::array<int, 2> out_{};
};

TEST_F(Dialogue, EnterTakesTheProposal) {
  typed("\n");
  EXPECT_EQ(console().ask("Which board?", "chessboard:9x6:30mm"), "chessboard:9x6:30mm");
  EXPECT_EQ(said(), "Which board? [chessboard:9x6:30mm]\n");
}

TEST_F(Dialogue, AWrongAnswerGetsASentenceAndAnotherChance) {
  typed("  red \nblue\n");
  const auto check = [](const std::string& text) {
    return text == "blue" ? "" : "Only blue will do, not " + text + ".";
  };
  EXPECT_EQ(console().ask("Which colour?", "", check), "blue");
  EXPECT_THAT(said(), HasSubstr("Only blue will do, not red.\nWhich colour?\n"));
}

TEST_F(Dialogue, YesAndNoInAnyOfTheirForms) {
  typed("perhaps\nyes\nn\n\n");
  Console asked = console();
  EXPECT_TRUE(asked.confirm("Move?", false));
  EXPECT_FALSE(asked.confirm("Move?", true));
  EXPECT_FALSE(asked.confirm("Move?", false));
}

TEST_F(Dialogue, LinesThatComeAtOnceAreAnswersOneByOne) {
  typed("one\r\ntwo\nthr");
  typed("ee\n");
  Console asked = console();
  EXPECT_EQ(asked.ask("?", ""), "one");
  EXPECT_EQ(asked.ask("?", ""), "two");
  EXPECT_EQ(asked.ask("?", ""), "three");
}

TEST_F(Dialogue, TheEndOfTheInputIsNoAnswer) {
  typed("half a li");
  inputEnds();
  EXPECT_THROW((void)console().ask("?", "proposal"), Interrupted);
}

TEST_F(Dialogue, AStopIsHeardWhileNobodyAnswers) {
  int calls = 0;
  const auto step = [&calls] {
    if (++calls == 3) {
      throw Interrupted("stopped");
    }
  };
  EXPECT_THROW((void)console(step).ask("?", ""), Interrupted);
}

}  // namespace
}  // namespace ringhook
