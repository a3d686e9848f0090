#pragma once

/// \file
/// From a stored sequence that shows a tag plate to the views that verify.h compares with a rig.

#include <vector>

#include "calib/solve/verify.h"
#include "camera/sequence.h"
#include "tracking/tag_plate.h"

namespace ringhook {

/// Corners of the plate's tags that both images of a frame show, of at most `most` frames spread
/// over the sequence; frames that show fewer than four are left out. Tags are located in the plate
/// frame: oMk is not looked at. Throws InputError for a sequence of one camera, unreadable images
/// and images that do not fit the rig's size.
std::vector<SightedView> sightPlate(const Sequence& sequence, const StereoRig& rig, TagPlate plate,
                                    std::size_t most, const StepHook& hook);

/// From the middle of one tag to that of another, by the plate. Throws InputError naming --bar for
/// an id that the plate does not have.
BarEnds barBetween(TagPlate plate, int id_a, int id_b);

}  // namespace ringhook
