#pragma once

/// \file
/// From the window that tracking asks for to the region that a camera can read. A GigE Vision
/// camera moves its region between two exposures, but keeps its size while it streams: the payload
/// is agreed when the stream starts, and a new size costs a stop and a start. So sizes are taken
/// from a short ladder, a region keeps its size as long as that is neither too small nor far too
/// large, and the asked window lies in its middle as far as the sensor's borders permit.

#include "core/image.h"

namespace ringhook {

/// What a camera permits along one axis [px].
struct RegionSteps {
  int smallest = 1;  ///< size
  int size = 1;      ///< sizes are multiples of it
  int offset = 1;    ///< offsets are multiples of it
};

/// What a camera permits.
struct RegionLimits {
  int sensor_width = 0;   ///< [px]
  int sensor_height = 0;  ///< [px]
  RegionSteps x;
  RegionSteps y;
};

/// The region to read for `asked`, which is clipped to the sensor first; an empty one means the
/// whole sensor. `current` is the region read now (empty: none yet): its size is kept where it
/// still holds the window and is not more than two rungs too large along an axis. The result lies
/// on the sensor, keeps the camera's steps, and holds the clipped window.
Window readoutRegion(const Window& asked, const Window& current, const RegionLimits& limits);

}  // namespace ringhook
