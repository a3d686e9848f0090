// Boards that look the same after a turn: one order in both images.

#include <algorithm>

#include "calib/solve/board.h"

namespace ringhook {
namespace {

using Grid = std::vector<Eigen::Vector2d>;

std::size_t at(const Board& board, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(board.columns) +
         static_cast<std::size_t>(column);
}

// Mean image directions of a board's columns (first) and rows (second) [px].
Eigen::Matrix2d directions(const Grid& grid, const Board& board) {
  Eigen::Matrix2d d = Eigen::Matrix2d::Zero();
  for (int r = 0; r < board.rows; ++r) {
    d.col(0) += grid[at(board, r, board.columns - 1)] - grid[at(board, r, 0)];
  }
  for (int c = 0; c < board.columns; ++c) {
    d.col(1) += grid[at(board, board.rows - 1, c)] - grid[at(board, 0, c)];
  }
  d.colwise().normalize();
  return d;
}

Grid quarterTurned(const Grid& grid, const Board& board) {
  Grid turned(grid.size());
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      turned[at(board, r, c)] = grid[at(board, c, board.columns - 1 - r)];
    }
  }
  return turned;
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
