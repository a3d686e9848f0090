#pragma once

/// \file
/// Points of a whole board, row by row, as a grid.

#include <Eigen/Core>
#include <vector>

#include "calib/solve/board.h"

namespace ringhook {

inline std::size_t gridIndex(const Board& board, int row, int column) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(board.columns) +
         static_cast<std::size_t>(column);
}

/// The same points counted again from the corner that followed the first one. Precondition:
/// columns = rows.
inline std::vector<Eigen::Vector2d> quarterTurned(const std::vector<Eigen::Vector2d>& grid,
                                                  const Board& board) {
  std::vector<Eigen::Vector2d> turned(grid.size());
  for (int r = 0; r < board.rows; ++r) {
    for (int c = 0; c < board.columns; ++c) {
      turned[gridIndex(board, r, c)] = grid[gridIndex(board, c, board.columns - 1 - r)];
    }
  }
  return turned;
}

}  // namespace ringhook
