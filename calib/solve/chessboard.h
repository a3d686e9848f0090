#pragma once

/// \file
/// A chessboard as calibration target: its description, its points in the board frame t, and its
/// inner corners found in an image to a fraction of a pixel.
///
/// Law of the refinement (Foerstner's corner, as in OpenCV's cornerSubPix): every gradient in a
/// window belongs to one of the two straight edges through the corner q, so that
/// g(p) . (q - p) = 0 for all p in the window. The window must therefore see these two edges and
/// nothing else, and it must be as large as that allows, because noise falls with its size.
/// A square window of half side w reaches w * sqrt(2). On a real board the nearest foreign edge is
/// not the next grid line, one square away, but the rim of the board, where printed boards are
/// often cut within half a square of the outer corners. Hence w = 0.3 d, with d the smallest
/// perpendicular distance from this corner to its neighbouring grid lines in this image:
/// 0.3 * sqrt(2) = 0.42 squares, which leaves the rest of the half square to blur and to the
/// error of the start. Each corner has a window of its own, since perspective makes squares differ.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/outcome.h"

namespace ringhook {

/// Inner corners, row by row: index = row * columns + column.
using Corners = std::vector<Eigen::Vector2d>;  ///< [px], centre of the first pixel at (0, 0)

struct Chessboard {
  int columns = 0;        ///< inner corners along x_t
  int rows = 0;           ///< inner corners along y_t
  double square_m = 0.0;  ///< side of a square [m]

  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  }
  /// Corner positions in the board frame t, z = 0 [m].
  [[nodiscard]] std::vector<Eigen::Vector3d> points() const;
};

/// Reads `chessboard:COLUMNSxROWS:SQUARE(mm|cm|m)`, inner corners counted, as in
/// chessboard:9x6:25mm. Throws InputError saying what was expected.
Chessboard parseBoard(const std::string& text);

/// The description that parseBoard reads, with the square in millimetres.
std::string toString(const Chessboard& board);

/// Finds all inner corners. The order is right-handed as one looks at the print (z_t into the
/// board), and where the print allows it (columns + rows odd) the first square, between the first
/// two rows and columns, is a dark one, so that the order does not depend on the camera.
/// Refuses, with a reason, an image without contrast, without the whole board, or with squares
/// too small to be measured.
Outcome<Corners> findChessboard(const GrayImage& image, const Chessboard& board);

/// Half side of the refinement window [px] of every corner by the law above; `rough` to one or
/// two pixels.
std::vector<int> refinementWindows(const Corners& rough, const Chessboard& board);

/// A board that looks the same turned by a half (or a quarter) turn leaves its order open: returns
/// `right` in the order whose rows and columns run as in `left`. Holds for cameras rolled against
/// each other by less than 90 degrees (45 for boards with columns = rows).
Corners orderedLike(const Corners& left, const Corners& right, const Chessboard& board);

}  // namespace ringhook
