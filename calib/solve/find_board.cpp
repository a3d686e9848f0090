// One way into all finders, and what is asked of every sighting.

#include <algorithm>
#include <opencv2/core.hpp>
#include <set>

#include "calib/solve/board.h"
#include "calib/solve/charuco.h"
#include "calib/solve/chessboard.h"
#include "calib/solve/circle_grid.h"
#include "calib/solve/image_health.h"
#include "calib/solve/tag_board.h"

namespace ringhook {
namespace {

Outcome<BoardSighting> search(const GrayImage& image, const Board& board) {
  switch (board.kind) {
    case BoardKind::kChessboard:
      return findChessboard(image, board);
    case BoardKind::kCharuco:
      return findCharuco(image, board);
    case BoardKind::kCircles:
    case BoardKind::kAsymmetricCircles:
      return findCircles(image, board);
    case BoardKind::kAprilTags:
      break;
  }
  return findTagBoard(image, board);
}

// A part of a board that fixes a pose: two rows and two columns, at least six points.
bool enough(const BoardSighting& sighting, const Board& board) {
  const std::vector<Eigen::Vector3d> points = board.points();
  std::set<double> x;
  std::set<double> y;
  for (const int id : sighting.ids) {
    x.insert(points[static_cast<std::size_t>(id)].x());
    y.insert(points[static_cast<std::size_t>(id)].y());
  }
  return sighting.ids.size() >= 6 && x.size() >= 2 && y.size() >= 2;
}

}  // namespace

Outcome<BoardSighting> findBoard(const GrayImage& image, const Board& board) {
  const std::string fault = exposureFault(image);
  try {
    Outcome<BoardSighting> found = search(image, board);
    if (!found) {
      return fault.empty() ? found : Refusal{fault};
    }
    if (!enough(*found, board)) {
      return Refusal{"only " + std::to_string(found->ids.size()) +
                     " points of the board are seen, expected six or more in two rows and columns"};
    }
    return found;
  } catch (const cv::Exception& e) {
    return Refusal{"OpenCV could not search the image (" + e.err + ")"};
  }
}

}  // namespace ringhook
