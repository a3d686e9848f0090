#include "tracking/edge_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/angle.h"
#include "core/error.h"
#include "tracking/edge_site.h"
#include "tracking/visp_edges.h"

namespace ringhook {
namespace {

constexpr int kReachPx = 3;             // ViSP's sites are whole pixels off the edge at most.
constexpr double kLeastContrast = 2.0;  // Fainter than this is image noise [grey levels / px].
constexpr double kSmallestSigma = 0.1;  // Neighbouring sites share their errors [px].
constexpr double kTukey = 4.6851;       // 95 % efficiency for Gaussian noise.

/// Largest shift of a model point's image between two poses [px]; infinite if one lies behind.
double largestShift(const std::vector<PinholeView>& cameras,
                    const std::vector<Eigen::Vector3d>& points_o, const Pose& a, const Pose& b) {
  double largest = 0.0;
  for (const PinholeView& camera : cameras) {
    for (const Eigen::Vector3d& p : points_o) {
      const auto in_a = camera.project(a * p);
      const auto in_b = camera.project(b * p);
      if (!in_a || !in_b) {
        return std::numeric_limits<double>::infinity();
      }
      largest = std::max(largest, (*in_a - *in_b).norm());
    }
  }
  return largest;
}

struct Judged {
  CameraFeatures features;
  double square_sum = 0.0;        ///< of the residuals of the features [px^2]
  double direction_sum = 0.0;     ///< of the refined sites [rad]
  std::vector<double> residuals;  ///< of the refined sites [px]
};

/// Places one camera's sites with sub-pixel accuracy and keeps those that agree with the pose.
Judged judge(const RectifiedView& view, const std::vector<EdgeSite>& sites, const Pose& c1Mo) {
  Judged judged;
  judged.features.camera = view.camera;
  std::vector<EdgeFeature> refined;
  std::vector<double>& residuals = judged.residuals;
  for (const EdgeSite& site : sites) {
    const auto line = projectEdge(view.camera, c1Mo, site.start_o, site.end_o);
    if (!line) {
      continue;
    }
    const auto fine =
        refineAcross(view.image, view.window, site.pixel, line->normal, kReachPx, kLeastContrast);
    if (!fine) {
      continue;
    }
    judged.direction_sum += fine->direction;
    refined.push_back({site.start_o, site.end_o, fine->pixel, 0.0});
    residuals.push_back(line->distance(fine->pixel));
  }
  const double sigma = std::max(kSmallestSigma, robustSigma(residuals));
  for (std::size_t i = 0; i < refined.size(); ++i) {
    if (std::abs(residuals[i]) < kTukey * sigma) {
      refined[i].sigma_px = sigma;
      judged.features.edges.push_back(refined[i]);
      judged.square_sum += residuals[i] * residuals[i];
    }
  }
  return judged;
}

bool sameCamera(const PinholeView& a, const PinholeView& b) {
  return a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy && a.width == b.width &&
         a.height == b.height && a.cMc1.matrix() == b.cMc1.matrix();
}

std::vector<PinholeView> camerasOf(const RectifiedFrame& frame) {
  std::vector<PinholeView> cameras;
  for (const RectifiedView& view : frame.views) {
    cameras.push_back(view.camera);
  }
  return cameras;
}

std::vector<WindowPixels> windowsOf(const RectifiedFrame& frame) {
  std::vector<WindowPixels> windows;
  for (const RectifiedView& view : frame.views) {
    windows.push_back({view.image.pixels.data(), view.window.x, view.window.y, view.image.width,
                       view.image.height});
  }
  return windows;
}

}  // namespace

struct EdgeTracker::Impl {
  Impl(std::vector<EdgeModelFile> m, const EdgeTrackerOptions& o)
      : models(std::move(m)), options(o) {
    checkEdgeSettings(options);
    if (models.empty()) {
      throw InputError("edge tracker: at least one model file expected");
    }
    // Loading once shows a broken file before the first image.
    points_o = VispEdges(models, options, {PinholeView{}}).modelPoints();
  }

  /// Prepares ViSP for the frame: same cameras or a new tracker, new images, start pose.
  std::optional<Refusal> prepare(const RectifiedFrame& frame,
                                 const std::optional<Pose>& c1Mo_predicted) {
    const std::vector<PinholeView> cameras = camerasOf(frame);
    if (!visp || !std::equal(cameras.begin(), cameras.end(), visp->cameras().begin(),
                             visp->cameras().end(), sameCamera)) {
      visp = std::make_unique<VispEdges>(models, options, cameras);
      started = false;
    }
    visp->setImages(windowsOf(frame));
    const bool near = last && c1Mo_predicted &&
                      largestShift(cameras, points_o, *last, *c1Mo_predicted) <= options.reset_px;
    if (last && (!c1Mo_predicted || near)) {
      return started ? std::nullopt : visp->start(*last);
    }
    return visp->start(*c1Mo_predicted);
  }

  Outcome<HookView> report(const RectifiedFrame& frame) {
    HookView seen;
    seen.time = frame.time;
    seen.c1Mo_start = visp->c1Mo();
    quality = EdgeQuality{};
    quality.sites = visp->searched();
    double squares = 0.0;
    double directions = 0.0;
    std::vector<double> residuals;
    for (std::size_t c = 0; c < frame.views.size(); ++c) {
      Judged judged = judge(frame.views[c], visp->sites()[c], seen.c1Mo_start);
      squares += judged.square_sum;
      directions += judged.direction_sum;
      residuals.insert(residuals.end(), judged.residuals.begin(), judged.residuals.end());
      quality.good_sites += static_cast<int>(judged.features.edges.size());
      if (!judged.features.edges.empty()) {
        seen.cameras.push_back(std::move(judged.features));
      }
    }
    quality.rms_px = std::sqrt(squares / std::max(1, quality.good_sites));
    const double refined = std::max<double>(1.0, static_cast<double>(residuals.size()));
    quality.spread_px = robustSigma(residuals);
    quality.direction_deg = directions / refined / kDegree;
    if (const auto doubt = disbelief()) {
      return *doubt;
    }
    return seen;
  }

  [[nodiscard]] std::optional<Refusal> disbelief() const {
    if (quality.good_sites < options.min_sites) {
      return Refusal{"too few edge sites"};
    }
    if (quality.good_sites < options.min_good_ratio * quality.sites) {
      return Refusal{"too many sites off the model"};
    }
    if (!(quality.spread_px <= options.max_spread_px)) {
      return Refusal{"edges too far from the model"};
    }
    if (!(quality.direction_deg <= options.max_direction_deg)) {
      return Refusal{"image gradients do not follow the model"};
    }
    return std::nullopt;
  }

  std::vector<EdgeModelFile> models;
  EdgeTrackerOptions options;
  std::vector<Eigen::Vector3d> points_o;
  std::unique_ptr<VispEdges> visp;
  std::optional<Pose> last;  ///< c1Mo of the last believed frame
  bool started = false;      ///< ViSP's sites belong to `last`
  EdgeQuality quality;
};

EdgeTracker::EdgeTracker(const std::filesystem::path& model, const EdgeTrackerOptions& options)
    : EdgeTracker(std::vector<EdgeModelFile>{{model, Pose::Identity()}}, options) {}

EdgeTracker::EdgeTracker(std::vector<EdgeModelFile> models, const EdgeTrackerOptions& options)
    : impl_(std::make_unique<Impl>(std::move(models), options)) {}

EdgeTracker::~EdgeTracker() = default;

const EdgeQuality& EdgeTracker::quality() const { return impl_->quality; }

Outcome<HookView> EdgeTracker::track(const RectifiedFrame& frame,
                                     const std::optional<Pose>& c1Mo_predicted) {
  if (frame.views.empty() || frame.views.size() > 2) {
    return Refusal{"one or two views expected"};
  }
  if (std::any_of(frame.views.begin(), frame.views.end(),
                  [](const RectifiedView& v) { return v.image.empty() || v.window.empty(); })) {
    return Refusal{"empty window"};
  }
  if (!impl_->last && !c1Mo_predicted) {
    return Refusal{"no start pose"};
  }
  std::optional<Refusal> trouble = impl_->prepare(frame, c1Mo_predicted);
  if (!trouble) {
    trouble = impl_->visp->step();
  }
  Outcome<HookView> seen = trouble ? Outcome<HookView>(*trouble) : impl_->report(frame);
  impl_->started = seen.hasValue();
  impl_->last = seen ? std::optional<Pose>(seen->c1Mo_start) : std::nullopt;
  return seen;
}

}  // namespace ringhook
