#include "calib/solve/board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::HasSubstr;

std::string refusalOf(const std::string& text) {
  try {
    (void)parseBoard(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(Board, ReadsItsDescriptionInEveryUnit) {
  for (const char* text :
       {"chessboard:9x6:25mm", "chessboard:9x6:2.5cm", "chessboard:9x6:0.025m"}) {
    const Board board = parseBoard(text);
    EXPECT_EQ(board.kind, BoardKind::kChessboard);
    EXPECT_EQ(board.columns, 9);
    EXPECT_EQ(board.rows, 6);
    EXPECT_NEAR(board.pitch_m, 0.025, 1e-15);
    EXPECT_EQ(toString(board), "chessboard:9x6:25mm");
  }
}

TEST(Board, WritesWhatItReadsForEveryKind) {
  for (const char* text :
       {"chessboard:9x6:25mm", "charuco:8x6:30mm:22mm:DICT_5X5_100", "circles:7x5:20mm:9mm",
        "acircles:4x11:20mm:12.5mm", "apriltags:6x6:30mm:9mm:tag36h11"}) {
    EXPECT_EQ(toString(parseBoard(text)), text);
  }
}

TEST(Board, FillsInWhatMayBeLeftOut) {
  EXPECT_EQ(toString(parseBoard("charuco:8x6:3cm:22mm")), "charuco:8x6:30mm:22mm:DICT_4X4_100");
  EXPECT_EQ(toString(parseBoard("circles:7x5:20mm")), "circles:7x5:20mm:8mm");
  EXPECT_EQ(toString(parseBoard("acircles:4x11:20mm")), "acircles:4x11:20mm:8mm");
  EXPECT_EQ(toString(parseBoard("apriltags:6x6:30mm:9mm")), "apriltags:6x6:30mm:9mm:tag36h11");
}

TEST(Board, PutsItsPointsWhereThePrintHasThem) {
  EXPECT_EQ(parseBoard("charuco:8x6:30mm:22mm").points().size(), 35U);
  const auto staggered = parseBoard("acircles:4x11:20mm").points();
  ASSERT_EQ(staggered.size(), 44U);
  EXPECT_TRUE(staggered[4].isApprox(Eigen::Vector3d(0.02, 0.02, 0.0)));
  EXPECT_TRUE(staggered[3].isApprox(Eigen::Vector3d(0.12, 0.0, 0.0)));
  const Board tags = parseBoard("apriltags:3x2:30mm:9mm");
  const auto corners = tags.points();
  ASSERT_EQ(corners.size(), tags.size());
  EXPECT_TRUE(corners[4].isApprox(Eigen::Vector3d(0.039, 0.0, 0.0)));
  EXPECT_TRUE(corners[4 * 3 + 2].isApprox(Eigen::Vector3d(0.03, 0.069, 0.0)));
}

TEST(Board, RefusesAnUnknownKindNamingTheKnownOnes) {
  EXPECT_THAT(refusalOf("checkers:9x6:25mm"), HasSubstr("known are chessboard, charuco, circles"));
  EXPECT_THAT(refusalOf("aprilgrid"), HasSubstr("'aprilgrid'"));
  EXPECT_THAT(refusalOf(""), HasSubstr("unknown board kind"));
}

TEST(Board, RefusesALengthWithoutUnit) {
  EXPECT_THAT(refusalOf("chessboard:9x6:25"),
              HasSubstr("without unit: expected 25mm, 25cm or 25m"));
  EXPECT_THAT(refusalOf("charuco:8x6:30mm:22"), HasSubstr("expected 22mm"));
}

TEST(Board, RefusesMillimetresWrittenAsMetres) {
  EXPECT_THAT(refusalOf("chessboard:9x6:25m"), HasSubstr("is it 25mm?"));
  EXPECT_THAT(refusalOf("chessboard:9x6:0.001mm"), HasSubstr("expected 0.1 mm to 1 m"));
}

TEST(Board, RefusesADescriptionOfAnotherForm) {
  for (const char* text :
       {"chessboard:9x6", "chessboard:9:25mm", "chessboard:-9x6:25mm", "chessboard:9x6:25mm ",
        "chessboard:9x6:25in", "chessboard:9x6:25mm:3mm", "charuco:8x6:30mm",
        "circles:7x5:20mm:8mm:red", "chessboard:9x6:2.5.1cm", "chessboard:9x6:.mm"}) {
    EXPECT_THAT(refusalOf(text), HasSubstr("is not of the form")) << text;
  }
  EXPECT_THAT(refusalOf("chessboard:2x6:25mm"), HasSubstr("3x3"));
}

TEST(Board, RefusesMarkersThatCannotBePrinted) {
  EXPECT_THAT(refusalOf("charuco:8x6:30mm:30mm"), HasSubstr("as large as the square"));
  EXPECT_THAT(refusalOf("charuco:8x6:30mm:22mm:DICT_9X9"), HasSubstr("unknown dictionary"));
  EXPECT_THAT(refusalOf("charuco:12x10:30mm:22mm:DICT_4X4_50"),
              HasSubstr("needs 60 codes, of which DICT_4X4_50 has only 50"));
  EXPECT_THAT(refusalOf("apriltags:6x6:30mm:9mm:tag16h5"), HasSubstr("needs 36 codes"));
  EXPECT_THAT(refusalOf("apriltags:6x6:30mm:9mm:tagX"), HasSubstr("unknown family"));
}

TEST(Board, SurvivesAnyWord) {
  std::mt19937 random(7);
  const std::string letters = "chessboardcirclesapriltags:::xxx0123456789..mm-m \n\xff";
  std::uniform_int_distribution<std::size_t> letter(0, letters.size() - 1);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = i % 2 == 0 ? "chessboard:9x6:25mm" : "apriltags:6x6:30mm:9mm:tag36h11";
    for (int change = 0; change < 1 + i % 6; ++change) {
      text[random() % text.size()] = letters[letter(random)];
    }
    if (refusalOf(text) == "accepted") {
      const Board board = parseBoard(text);
      EXPECT_EQ(board.points().size(), board.size());
      ++accepted;
    }
  }
  EXPECT_GT(accepted, 100);  // a changed digit is still a board
}

}  // namespace
}  // namespace ringhook
