#pragma once

/// \file
/// The simulated cell as robot-camera calibration meets it: the arm drives its gripper's tag plate
/// from pose to pose with its joint errors, both cameras take noisy pictures, and the truth is
/// known.

#include <cstdint>
#include <memory>
#include <random>
#include <vector>

#include "calib/solve/plate_views.h"
#include "calib/solve/point_fit.h"
#include "calib/wizard/place.h"
#include "rig/stereo_rig.h"

namespace ringhook {

class RenderedCell {
 public:
  explicit RenderedCell(std::uint64_t seed);

  /// Drives there and looks; nothing if the arm cannot go there or a camera sees no tag.
  std::optional<PlateView> look(const Pose& fMe);

  /// The flange looking at the cameras, turned by a rotation vector in e [rad].
  [[nodiscard]] static Pose facing(const Eigen::Vector3d& position_f,
                                   const Eigen::Vector3d& turn_e);

  /// The flange at the eight corners of a cube about (0.30, 0, 0.62) [m], never turned.
  std::vector<PlateView> cube(double side_m);
  /// `count` views at random places and turns up to 30 degrees about each axis.
  std::vector<PlateView> around(int count, std::uint64_t seed);

  /// Corner points for the report's way: the plate's middle as the arm says and as the cameras
  /// triangulate it.
  static std::vector<PointPair> pointsOf(const std::vector<PlateView>& views);

  [[nodiscard]] StereoRig trueRig() const;
  [[nodiscard]] Pose trueCamera() const;   ///< fMc1, where the left camera really stands
  [[nodiscard]] static Pose trueTarget();  ///< eMg by drawing
  [[nodiscard]] JointVector trueZeros() const;

  /// What a calibration is for: RMS distance [m] between where the arm says that a ring in the
  /// gripper is and where the cameras see it, both in f, over places where rings meet hooks. The
  /// cameras' rig is the one told to them, so what it sees wrongly is part of the error, as it is
  /// when the ring meets a hook.
  [[nodiscard]] double ringError(const Pose& fMc1, const JointVector& zeros_rad) const;

 private:
  std::uint64_t seed_;
  StereoRig told_;
  std::unique_ptr<CalibrationPlace> place_;
};

}  // namespace ringhook
