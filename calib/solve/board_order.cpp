// Boards that look the same after a turn: one order in both images.

#include <algorithm>

#include "calib/solve/board_grid.h"

namespace ringhook {
namespace {

using Grid = std::vector<Eigen::Vector2d>;

// Mean image directions of a board's columns (first) and rows (second) [px].
Eigen::Matrix2d directions(const Grid& grid, const Board& board) {
  Eigen::Matrix2d d = Eigen::Matrix2d::Zero();
  for (int r = 0; r < board.rows; ++r) {
    d.col(0) += grid[gridIndex(board, r, board.columns - 1)] - grid[gridIndex(board, r, 0)];
  }
  for (int c = 0; c < board.columns; ++c) {
    d.col(1) += grid[gridIndex(board, board.rows - 1, c)] - grid[gridIndex(board, 0, c)];
  }
  d.colwise().normalize();
  return d;
}

// A quarter turn of a chessboard swaps its colours if the count across is odd.
bool quarterAmbiguous(const Board& board) {
  if (board.columns != board.rows) {
    return false;
  }
  return board.kind == BoardKind::kCircles ||
         (board.kind == BoardKind::kChessboard && board.columns % 2 == 0);
}

}  // namespace

BoardSighting orderedLike(const BoardSighting& left, const BoardSighting& right,
                          const Board& board) {
  if (!board.ambiguous() || left.ids.size() != board.size() || right.ids.size() != board.size()) {
    return right;
  }
  std::vector<Grid> candidates{right.pixels, Grid(right.pixels.rbegin(), right.pixels.rend())};
  if (quarterAmbiguous(board)) {
    candidates.push_back(quarterTurned(right.pixels, board));
    candidates.emplace_back(candidates.back().rbegin(), candidates.back().rend());
  }
  const Eigen::Matrix2d wanted = directions(left.pixels, board);
  const auto agreement = [&](const Grid& grid) {
    return directions(grid, board).cwiseProduct(wanted).sum();
  };
  const auto best =
      std::max_element(candidates.begin(), candidates.end(),
                       [&](const Grid& a, const Grid& b) { return agreement(a) < agreement(b); });
  return {right.ids, *best};
}

}  // namespace ringhook
