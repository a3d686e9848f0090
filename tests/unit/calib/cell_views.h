#pragma once

/// \file
/// The simulated cell's cameras looking at a chessboard held in their workspace, and a bar measured
/// there: truth by geometry for a rig that was calibrated from rendered pictures.
///
/// The board is 14x10 corners of 30 mm: 0.45 x 0.33 m, the largest that a hand still tilts in front
/// of both cameras and a third of the field of view across, so that every view bends over a good
/// part of the lens. With n corners of noise s the focal length is known to a few s / sqrt(n) of
/// the tilt's foreshortening; 25 views x 140 corners x 2 give n = 7000.

#include <cstdint>
#include <functional>
#include <vector>

#include "calib/solve/board.h"
#include "core/stereo_frame.h"
#include "rig/stereo_rig.h"

namespace ringhook {

/// The board above.
Board workspaceBoard();

/// The simulated rig as it truly stands for a seed.
StereoRig trueCellRig(std::uint64_t seed);

/// Renders `count` pairs of full images with sensor noise, the board tilted up to 40 degrees in all
/// directions at seeded places 0.95 to 1.25 m away, clear of arm and hooks; each is handed to
/// `take` as it comes.
/// \param places_seed of where the board is held, apart from `seed` of cell and cameras.
void renderViews(const Board& board, int count, std::uint64_t seed, std::uint64_t places_seed,
                 const std::function<void(int, const StereoFrame&)>& take);

/// A bar as an integrator has it: `barBoard()`, 9x7 corners of 25 mm, whose rows are 200 mm long.
Board barBoard();

/// Errors of the lengths of `barBoard()`'s rows [m] in `count` pairs rendered anew, found in the
/// pictures and triangulated by `rig`; pairs in which the board is not found are left out.
std::vector<double> renderedBarErrors(const StereoRig& rig, int count, std::uint64_t seed);

/// Root mean square error [m] of the length of a 200 mm bar, triangulated by `rig` from its ends'
/// images in `truth`: 500 seeded places x_f 0.42 +- 0.1, y_f +- 0.3, z_f 0.6 to 1.0, directions all
/// over the sphere. \param sigma_px noise per axis of an end's image [px].
double barError(const StereoRig& rig, const StereoRig& truth, double sigma_px, std::uint64_t seed);

}  // namespace ringhook
