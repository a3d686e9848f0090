#include "calib/solve/board.h"

#include <array>
#include <cstdio>
#include <optional>
#include <sstream>

#include "calib/solve/charuco.h"
#include "core/error.h"
#include "tracking/tag_plate.h"

namespace ringhook {
namespace {

constexpr double kSmallestLength_m = 1e-4;
constexpr double kLargestLength_m = 1.0;
constexpr double kUsualDiameter = 0.4;  // of the distance of the centres
constexpr int kMostAcross = 200;

struct KindName {
  BoardKind kind;
  const char* word;
  const char* form;
  int lengths;  // that must be given
};

constexpr std::array<KindName, 5> kKinds{
    KindName{BoardKind::kChessboard, "chessboard", "chessboard:9x6:25mm (inner corners, square)",
             1},
    KindName{BoardKind::kCharuco, "charuco",
             "charuco:8x6:30mm:22mm[:DICT_4X4_100] (squares, square, marker, dictionary)", 2},
    KindName{BoardKind::kCircles, "circles", "circles:7x5:20mm[:8mm] (circles, distance, diameter)",
             1},
    KindName{BoardKind::kAsymmetricCircles, "acircles",
             "acircles:4x11:20mm[:8mm] (circles, distance of the rows, diameter)", 1},
    KindName{BoardKind::kAprilTags, "apriltags",
             "apriltags:6x6:30mm:9mm[:tag36h11] (tags, side of a tag, gap, family)", 2}};

const KindName& nameOf(BoardKind kind) {
  for (const KindName& name : kKinds) {
    if (name.kind == kind) {
      return name;
    }
  }
  return kKinds.front();
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError("--board: '" + text + "' " + why);
}

std::vector<std::string> fieldsOf(const std::string& text) {
  std::vector<std::string> fields(1);
  for (const char c : text) {
    if (c == ':') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

const KindName& kindOf(const std::string& text, const std::string& word) {
  for (const KindName& name : kKinds) {
    if (word == name.word) {
      return name;
    }
  }
  std::string known;
  for (const KindName& name : kKinds) {
    known += (known.empty() ? "" : ", ") + std::string(name.word);
  }
  throw InputError("--board: unknown board kind '" + word + "' in '" + text + "', known are " +
                   known + " (as in chessboard:9x6:25mm)");
}

// A whole number of at most three digits.
std::optional<int> countOf(const std::string& word) {
  if (word.empty() || word.size() > 3 ||
      word.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  return std::stoi(word);
}

// Digits with at most one point among them.
std::optional<double> numberOf(const std::string& word) {
  const std::size_t point = word.find('.');
  const bool plain = word.find_first_not_of("0123456789.") == std::string::npos &&
                     word.find_first_of("0123456789") != std::string::npos;
  if (!plain || word.size() > 18 ||
      (point != std::string::npos && word.find('.', point + 1) != std::string::npos)) {
    return std::nullopt;
  }
  std::istringstream in(word);
  in.imbue(std::locale::classic());
  double value = 0.0;
  in >> value;
  return value;
}

// A length in metres of a word such as 25mm.
double lengthOf(const std::string& text, const KindName& kind, const std::string& word) {
  if (numberOf(word)) {
    refuse(text, "has a length without unit: expected " + word + "mm, " + word + "cm or " + word +
                     "m for " + word);
  }
  struct Unit {
    const char* name;
    double metres;
  };
  for (const Unit& unit : {Unit{"mm", 1e-3}, Unit{"cm", 1e-2}, Unit{"m", 1.0}}) {
    const std::string suffix = unit.name;
    if (word.size() <= suffix.size() || !word.ends_with(suffix)) {
      continue;
    }
    const std::string digits = word.substr(0, word.size() - suffix.size());
    if (const auto number = numberOf(digits)) {
      const double length = *number * unit.metres;
      if (length > kLargestLength_m) {
        refuse(text, "has a length of " + word + ", which no printed board has: expected at most " +
                         "1 m (is it " + digits + "mm?)");
      }
      if (!(length >= kSmallestLength_m)) {
        refuse(text, "has a length of " + word + ", expected 0.1 mm to 1 m");
      }
      return length;
    }
  }
  refuse(text, "is not of the form " + std::string(kind.form) + ": '" + word +
                   "' is no length in mm, cm or m");
}

void readCounts(const std::string& text, const KindName& kind, const std::string& word,
                Board& board) {
  const std::size_t cross = word.find('x');
  const auto columns = countOf(word.substr(0, cross));
  const auto rows = cross == std::string::npos ? std::nullopt : countOf(word.substr(cross + 1));
  if (!columns || !rows) {
    refuse(text,
           "is not of the form " + std::string(kind.form) + ": '" + word + "' is not COLUMNSxROWS");
  }
  const int fewest = kind.kind == BoardKind::kAprilTags ? 2 : 3;
  if (*columns < fewest || *rows < fewest || *columns > kMostAcross || *rows > kMostAcross) {
    refuse(text, "has " + word + " points or fields, expected at least " + std::to_string(fewest) +
                     "x" + std::to_string(fewest) + " and at most 200 across");
  }
  board.columns = *columns;
  board.rows = *rows;
}

// The second length, and what follows from both.
void readMarker(const std::string& text, const KindName& kind,
                const std::vector<std::string>& fields, Board& board) {
  switch (board.kind) {
    case BoardKind::kChessboard:
      return;
    case BoardKind::kCharuco:
      board.marker_m = lengthOf(text, kind, fields[3]);
      board.family = fields.size() > 4 ? fields[4] : "DICT_4X4_100";
      break;
    case BoardKind::kCircles:
    case BoardKind::kAsymmetricCircles:
      board.marker_m =
          fields.size() > 3 ? lengthOf(text, kind, fields[3]) : kUsualDiameter * board.pitch_m;
      break;
    case BoardKind::kAprilTags:
      board.marker_m = board.pitch_m;
      board.pitch_m += lengthOf(text, kind, fields[3]);
      board.family = fields.size() > 4 ? fields[4] : "tag36h11";
      break;
  }
  if (!(board.marker_m < board.pitch_m)) {
    refuse(text, "has a marker or circle as large as the square or distance that holds it");
  }
}

// Codes that the board needs against codes that its family has.
void checkFamily(const std::string& text, const Board& board) {
  int needed = 0;
  int there = 0;
  if (board.kind == BoardKind::kCharuco) {
    needed = board.columns * board.rows / 2;
    there = charucoDictionarySize(board.family);
    if (there == 0) {
      refuse(text, "has the unknown dictionary '" + board.family +
                       "', expected one of OpenCV's names, as DICT_4X4_100 or DICT_6X6_250");
    }
  } else if (board.kind == BoardKind::kAprilTags) {
    needed = board.columns * board.rows;
    there = tagFamilySize(board.family);
    if (there == 0) {
      refuse(text, "has the unknown family '" + board.family +
                       "', expected tag36h11, tag25h9 or tag16h5");
    }
  }
  if (needed > there) {
    refuse(text, "needs " + std::to_string(needed) + " codes, of which " + board.family +
                     " has only " + std::to_string(there));
  }
}

std::string lengthText(double metres) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), ":%.6gmm", 1e3 * metres);
  return text.data();
}

}  // namespace

Board parseBoard(const std::string& text) {
  const std::vector<std::string> fields = fieldsOf(text);
  const KindName& kind = kindOf(text, fields[0]);
  const std::size_t fewest = 2 + static_cast<std::size_t>(kind.lengths);
  const std::size_t most = kind.kind == BoardKind::kChessboard ? 3 : kind.lengths == 2 ? 5 : 4;
  if (fields.size() < fewest || fields.size() > most) {
    refuse(text, "is not of the form " + std::string(kind.form));
  }
  Board board;
  board.kind = kind.kind;
  readCounts(text, kind, fields[1], board);
  board.pitch_m = lengthOf(text, kind, fields[2]);
  readMarker(text, kind, fields, board);
  checkFamily(text, board);
  return board;
}

std::string toString(const Board& board) {
  std::string text = std::string(nameOf(board.kind).word) + ":" + std::to_string(board.columns) +
                     "x" + std::to_string(board.rows);
  switch (board.kind) {
    case BoardKind::kChessboard:
      return text + lengthText(board.pitch_m);
    case BoardKind::kCircles:
    case BoardKind::kAsymmetricCircles:
      return text + lengthText(board.pitch_m) + lengthText(board.marker_m);
    case BoardKind::kCharuco:
      return text + lengthText(board.pitch_m) + lengthText(board.marker_m) + ":" + board.family;
    case BoardKind::kAprilTags:
      break;
  }
  return text + lengthText(board.marker_m) + lengthText(board.pitch_m - board.marker_m) + ":" +
         board.family;
}

std::size_t Board::size() const {
  const auto c = static_cast<std::size_t>(columns);
  const auto r = static_cast<std::size_t>(rows);
  return kind == BoardKind::kCharuco     ? (c - 1) * (r - 1)
         : kind == BoardKind::kAprilTags ? 4 * c * r
                                         : c * r;
}

std::vector<Eigen::Vector3d> Board::points() const {
  const int less = kind == BoardKind::kCharuco ? 1 : 0;
  std::vector<Eigen::Vector3d> result;
  for (int r = 0; r < rows - less; ++r) {
    for (int c = 0; c < columns - less; ++c) {
      const double x =
          kind == BoardKind::kAsymmetricCircles ? pitch_m * (2 * c + r % 2) : pitch_m * c;
      const Eigen::Vector3d first(x, pitch_m * r, 0.0);
      result.push_back(first);
      if (kind == BoardKind::kAprilTags) {
        result.push_back(first + Eigen::Vector3d(marker_m, 0.0, 0.0));
        result.push_back(first + Eigen::Vector3d(marker_m, marker_m, 0.0));
        result.push_back(first + Eigen::Vector3d(0.0, marker_m, 0.0));
      }
    }
  }
  return result;
}

bool Board::coded() const { return kind == BoardKind::kCharuco || kind == BoardKind::kAprilTags; }

bool Board::ambiguous() const {
  switch (kind) {
    case BoardKind::kChessboard:
      return (columns + rows) % 2 == 0;
    case BoardKind::kCircles:
      return true;
    case BoardKind::kAsymmetricCircles:
      return rows % 2 == 0;
    case BoardKind::kCharuco:
    case BoardKind::kAprilTags:
      break;
  }
  return false;
}

}  // namespace ringhook
