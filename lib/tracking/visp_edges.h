#pragma once

/// \file
/// ViSP's generic tracker with our images, cameras and poses. Private to lib/tracking; kept apart
/// from the decisions in edge_tracker.cpp so that only one source file sees ViSP's tracker.
/// ViSP 3.5's headers are not valid C++20: the source is compiled as C++17, and this header
/// therefore names no type that needs more.
/// ViSP's reference camera is the left rectified one; poses are converted to and from true c1.

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/outcome.h"
#include "core/pinhole_view.h"
#include "tracking/edge_settings.h"

namespace ringhook {

/// A piece of a model edge and a pixel believed to lie on its image.
struct EdgeSite {
  Eigen::Vector3d start_o;  ///< first end of the model edge [m]
  Eigen::Vector3d end_o;    ///< second end of the model edge [m]
  Eigen::Vector2d pixel;    ///< full image [px]
};

/// Pixels of one window of a camera's image; not owned, valid during the call.
struct WindowPixels {
  const std::uint8_t* pixels = nullptr;  ///< width * height values, row by row
  int x = 0;                             ///< first column in the full image [px]
  int y = 0;                             ///< first row in the full image [px]
  int width = 0;                         ///< [px]
  int height = 0;                        ///< [px]
};

class VispEdges {
 public:
  /// Loads the models; throws InputError. `cameras` has one or two entries, left first.
  VispEdges(const std::vector<EdgeModelFile>& models, const EdgeTrackerOptions& options,
            const std::vector<PinholeView>& cameras);
  ~VispEdges();
  VispEdges(const VispEdges&) = delete;
  VispEdges& operator=(const VispEdges&) = delete;

  /// The cameras it was built for.
  [[nodiscard]] const std::vector<PinholeView>& cameras() const;
  /// Copies the windows, one per camera, into the full-size images.
  void setImages(const std::vector<WindowPixels>& windows);
  /// Places the model anew: edges are searched around the pose in the present images. A reason if
  /// ViSP cannot.
  [[nodiscard]] std::optional<Refusal> start(const Pose& c1Mo);
  /// One tracking step from the last pose. A reason if ViSP lost the model.
  [[nodiscard]] std::optional<Refusal> step();

  [[nodiscard]] Pose c1Mo() const;
  /// Sites that the last step used, by camera [full image px].
  [[nodiscard]] const std::vector<std::vector<EdgeSite>>& sites() const;
  /// Sites that the last step searched, all cameras.
  [[nodiscard]] int searched() const;
  /// Ends of the model's lines in o [m].
  [[nodiscard]] std::vector<Eigen::Vector3d> modelPoints() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ringhook
