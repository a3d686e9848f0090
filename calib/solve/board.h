#pragma once

/// \file
/// Calibration boards: what is printed, where its points lie in the board frame t, and the word
/// that describes it on a command line.
///
///   chessboard:9x6:25mm            COLUMNSxROWS inner corners : side of a square
///   charuco:8x6:30mm:22mm[:DICT]   COLUMNSxROWS squares : side of a square : side of a marker
///                                  : OpenCV's name of the dictionary (DICT_4X4_100 if left out)
///   circles:7x5:20mm[:8mm]         COLUMNSxROWS circles : distance of the centres : diameter
///   acircles:4x11:20mm[:8mm]       OpenCV's asymmetric grid, COLUMNSxROWS circles : distance of
///                                  the rows, which is half the distance within a row : diameter
///   apriltags:6x6:30mm:9mm[:FAMILY]  COLUMNSxROWS tags : side of a black square : gap between two
///                                  : tag36h11 if left out
/// Every length carries its unit (mm, cm, m). A diameter left out is 0.4 of the distance, as
/// OpenCV's gen_pattern.py draws it.
///
/// Frame t: origin at the first point, x along a row, y from the first row on, z = 0 on the print.
/// It looks into the board wherever rows are counted downwards as one reads the print; Kalibr's
/// sheets of AprilTags count upwards. Measured pixels put the centre of the first pixel at (0, 0).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/outcome.h"

namespace ringhook {

enum class BoardKind { kChessboard, kCharuco, kCircles, kAsymmetricCircles, kAprilTags };

struct Board {
  BoardKind kind = BoardKind::kChessboard;
  int columns = 0;        ///< along x_t: inner corners, squares (ChArUco), circles or tags
  int rows = 0;           ///< along y_t, the same
  double pitch_m = 0.0;   ///< side of a square, distance of circles, tag side and gap together [m]
  double marker_m = 0.0;  ///< ChArUco: side of a marker; circles: diameter; side of a tag [m]
  std::string family = {};  ///< ChArUco: dictionary; AprilTags: family; else empty

  /// Number of points.
  [[nodiscard]] std::size_t size() const;
  /// Positions in t [m], z = 0: corners or circle centres row by row; of AprilTags the four
  /// corners (0, 0), (s, 0), (s, s), (0, s) of each black square of side s, tag by tag.
  [[nodiscard]] std::vector<Eigen::Vector3d> points() const;
  /// Can a part of the board be told from another? True for ChArUco and AprilTags; of the other
  /// boards an image must show the whole.
  [[nodiscard]] bool coded() const;
  /// Does the print look the same after a half turn? Then views may count from either end.
  [[nodiscard]] bool ambiguous() const;
};

/// Reads the word above. Throws InputError saying what was expected; a length without unit and a
/// board larger than any that is printed get their own sentence.
Board parseBoard(const std::string& text);

/// The word that parseBoard reads, with lengths in millimetres and nothing left out.
std::string toString(const Board& board);

/// What one image shows of a board.
struct BoardSighting {
  std::vector<int> ids;                 ///< indices into Board::points(), ascending
  std::vector<Eigen::Vector2d> pixels;  ///< where each of them is seen [px]
};

/// Finds the board to a fraction of a pixel; fast enough for live images. Refuses, with a reason
/// for a table: an image that is black, white or without contrast, the board not seen (or another
/// size of board, where that can be told), squares too small, and pictures too blurred to measure.
/// Circles are found as the centroids of their images, which are not the images of their centres:
/// circle_grid.h.
Outcome<BoardSighting> findBoard(const GrayImage& image, const Board& board);

/// A board that looks the same after a half (or a quarter) turn leaves its order open: returns
/// `right` in the order whose rows and columns run as in `left`; other boards unchanged. Holds for
/// cameras rolled against each other by less than 90 degrees (45 for boards with columns = rows).
BoardSighting orderedLike(const BoardSighting& left, const BoardSighting& right,
                          const Board& board);

}  // namespace ringhook
