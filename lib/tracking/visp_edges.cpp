#include "tracking/visp_edges.h"

#include <visp3/mbt/vpMbGenericTracker.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iostream>
#include <sstream>

#include "core/error.h"

namespace ringhook {
namespace {

/// While alive, what ViSP's model loader prints goes nowhere.
class QuietStreams {
 public:
  QuietStreams()
      : out_(std::cout.rdbuf(nowhere_.rdbuf())), err_(std::cerr.rdbuf(nowhere_.rdbuf())) {}
  ~QuietStreams() {
    std::cout.rdbuf(out_);
    std::cerr.rdbuf(err_);
  }
  QuietStreams(const QuietStreams&) = delete;
  QuietStreams& operator=(const QuietStreams&) = delete;

 private:
  std::ostringstream nowhere_;
  std::streambuf* out_;
  std::streambuf* err_;
};

vpHomogeneousMatrix toVisp(const Pose& aMb) {
  vpHomogeneousMatrix M;
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 4; ++j) {
      M[i][j] = aMb.matrix()(i, j);
    }
  }
  return M;
}

Pose fromVisp(const vpHomogeneousMatrix& M) {
  Pose aMb = Pose::Identity();
  for (unsigned int i = 0; i < 3; ++i) {
    for (unsigned int j = 0; j < 4; ++j) {
      aMb.matrix()(i, j) = M[i][j];
    }
  }
  return aMb;
}

Eigen::Vector3d modelPoint(const vpPoint& p) { return {p.get_oX(), p.get_oY(), p.get_oZ()}; }

/// ViSP's tracker, with the sites read off between the pose estimation and the update of the sites
/// for the next image, which moves and replaces them.
class SiteReadingTracker final : public vpMbGenericTracker {
 public:
  explicit SiteReadingTracker(unsigned int cameras)
      : vpMbGenericTracker(cameras, vpMbGenericTracker::EDGE_TRACKER),
        sites(cameras),
        names(getCameraNames()) {}

  void testTracking() override {
    readSites();
    vpMbGenericTracker::testTracking();
  }

  void readSites() {
    searched = 0;
    for (std::size_t c = 0; c < sites.size(); ++c) {
      sites[c].clear();
      std::list<vpMbtDistanceLine*> lines;
      getLline(names[c], lines);
      for (const vpMbtDistanceLine* line : lines) {
        if (line->isTracked() && line->isVisible()) {
          readLine(*line, sites[c]);
        }
      }
    }
  }

  std::vector<std::vector<EdgeSite>> sites;  ///< by camera
  std::vector<std::string> names;            ///< of the cameras, left first
  int searched = 0;

 private:
  void readLine(const vpMbtDistanceLine& line, std::vector<EdgeSite>& out) {
    for (vpMbtMeLine* edge : line.meline) {
      for (const vpMeSite& site : edge->getMeList()) {
        ++searched;
        if (site.getState() == vpMeSite::NO_SUPPRESSION) {
          out.push_back({modelPoint(*line.p1), modelPoint(*line.p2), {site.jfloat, site.ifloat}});
        }
      }
    }
  }
};

/// A full-size image of which only one window holds data; the rest is black.
struct Canvas {
  vpImage<unsigned char> image;
  WindowPixels filled;  ///< only the place is used

  void put(const PinholeView& camera, const WindowPixels& window) {
    const auto rows = static_cast<unsigned int>(camera.height);
    const auto columns = static_cast<unsigned int>(camera.width);
    if (image.getHeight() != rows || image.getWidth() != columns) {
      image.resize(rows, columns, 0);
      filled = {};
    }
    for (int y = filled.y; y < filled.y + filled.height; ++y) {
      std::memset(at(filled.x, y), 0, static_cast<std::size_t>(filled.width));
    }
    filled.x = std::max(0, window.x);
    filled.y = std::max(0, window.y);
    filled.width = std::max(0, std::min(camera.width, window.x + window.width) - filled.x);
    filled.height = std::max(0, std::min(camera.height, window.y + window.height) - filled.y);
    for (int y = filled.y; y < filled.y + filled.height; ++y) {
      const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(y - window.y) * window.width;
      std::memcpy(at(filled.x, y), window.pixels + row + (filled.x - window.x),
                  static_cast<std::size_t>(filled.width));
    }
  }

  unsigned char* at(int x, int y) { return image[static_cast<unsigned int>(y)] + x; }
};

vpMe movingEdge(const EdgeTrackerOptions& o) {
  vpMe me;
  me.setMaskSize(static_cast<unsigned int>(o.mask_size));
  me.setMaskNumber(static_cast<unsigned int>(o.mask_number));
  me.setRange(static_cast<unsigned int>(o.range_px));
  me.setThreshold(o.threshold);
  me.setMu1(o.mu1);
  me.setMu2(o.mu2);
  me.setSampleStep(o.sample_step_px);
  return me;
}

}  // namespace

struct VispEdges::Impl {
  Impl(const std::vector<PinholeView>& views)
      : cameras(views), tracker(static_cast<unsigned int>(views.size())), canvases(views.size()) {}

  void configure(const EdgeTrackerOptions& options) {
    std::map<std::string, vpCameraParameters> parameters;
    std::map<std::string, vpHomogeneousMatrix> transforms;
    for (std::size_t c = 0; c < cameras.size(); ++c) {
      vpCameraParameters K;
      K.initPersProjWithoutDistortion(cameras[c].fx, cameras[c].fy, cameras[c].cx, cameras[c].cy);
      parameters[tracker.names[c]] = K;
      transforms[tracker.names[c]] = toVisp(cameras[c].cMc1 * cameras[0].cMc1.inverse());
    }
    tracker.setCameraParameters(parameters);
    if (cameras.size() > 1) {
      tracker.setCameraTransformationMatrix(transforms);
    }
    tracker.setMovingEdge(movingEdge(options));
    tracker.setAngleAppear(options.angle_appear);
    tracker.setAngleDisappear(options.angle_disappear);
    tracker.setNearClippingDistance(options.near_m);
    tracker.setFarClippingDistance(options.far_m);
    tracker.setClipping(options.clip_to_image
                            ? vpPolygon3D::ALL_CLIPPING
                            : vpPolygon3D::NEAR_CLIPPING | vpPolygon3D::FAR_CLIPPING);
    tracker.setLod(false);
    tracker.setDisplayFeatures(false);
    tracker.setProjectionErrorComputation(false);
    // Parts of the hook outside the window are ordinary; edge_tracker.cpp judges the sites.
    tracker.setGoodMovingEdgesRatioThreshold(0.05);
  }

  void load(const EdgeModelFile& model) {
    const std::string name = model.path.string();
    if (!std::ifstream(model.path)) {
      throw InputError(name + ": cannot read this edge model (.cao expected)");
    }
    const std::size_t before = size();
    try {
      const QuietStreams quiet;
      tracker.loadModel(name, false, toVisp(model.oMmodel));
    } catch (const std::exception& e) {
      throw InputError(name + ": not an edge model that ViSP can read: " + e.what());
    }
    if (size() == before) {
      throw InputError(name + ": model with no face, line, cylinder or circle");
    }
  }

  std::size_t size() const {
    std::list<vpMbtDistanceLine*> lines;
    std::list<vpMbtDistanceCylinder*> cylinders;
    std::list<vpMbtDistanceCircle*> circles;
    tracker.getLline(tracker.names[0], lines);
    tracker.getLcylinder(tracker.names[0], cylinders);
    tracker.getLcircle(tracker.names[0], circles);
    return lines.size() + cylinders.size() + circles.size();
  }

  std::map<std::string, const vpImage<unsigned char>*> images() const {
    std::map<std::string, const vpImage<unsigned char>*> all;
    for (std::size_t c = 0; c < canvases.size(); ++c) {
      all[tracker.names[c]] = &canvases[c].image;
    }
    return all;
  }

  std::vector<PinholeView> cameras;
  SiteReadingTracker tracker;
  std::vector<Canvas> canvases;
};

VispEdges::VispEdges(const std::vector<EdgeModelFile>& models, const EdgeTrackerOptions& options,
                     const std::vector<PinholeView>& cameras)
    : impl_(std::make_unique<Impl>(cameras)) {
  try {
    impl_->configure(options);
  } catch (const vpException& e) {
    throw Error(std::string("edge tracker: ViSP refused its settings: ") + e.what());
  }
  for (const EdgeModelFile& model : models) {
    impl_->load(model);
  }
}

VispEdges::~VispEdges() = default;

const std::vector<PinholeView>& VispEdges::cameras() const { return impl_->cameras; }

void VispEdges::setImages(const std::vector<WindowPixels>& windows) {
  for (std::size_t c = 0; c < windows.size() && c < impl_->canvases.size(); ++c) {
    impl_->canvases[c].put(impl_->cameras[c], windows[c]);
  }
}

std::optional<Refusal> VispEdges::start(const Pose& c1Mo) {
  try {
    auto images = impl_->images();
    const std::map<std::string, vpHomogeneousMatrix> poses{
        {impl_->tracker.names[0], toVisp(impl_->cameras[0].cMc1 * c1Mo)}};
    impl_->tracker.initFromPose(images, poses);
  } catch (const vpException& e) {
    return Refusal{std::string("start pose not usable: ") + e.what()};
  }
  return std::nullopt;
}

std::optional<Refusal> VispEdges::step() {
  try {
    auto images = impl_->images();
    impl_->tracker.track(images);
  } catch (const vpException& e) {
    return Refusal{std::string("edges lost: ") + e.what()};
  }
  return std::nullopt;
}

Pose VispEdges::c1Mo() const {
  vpHomogeneousMatrix cMo;
  impl_->tracker.getPose(cMo);
  return impl_->cameras[0].cMc1.inverse() * fromVisp(cMo);
}

const std::vector<std::vector<EdgeSite>>& VispEdges::sites() const { return impl_->tracker.sites; }

int VispEdges::searched() const { return impl_->tracker.searched; }

std::vector<Eigen::Vector3d> VispEdges::modelPoints() const {
  std::list<vpMbtDistanceLine*> lines;
  impl_->tracker.getLline(impl_->tracker.names[0], lines);
  std::vector<Eigen::Vector3d> points;
  for (const vpMbtDistanceLine* line : lines) {
    points.push_back(modelPoint(*line->p1));
    points.push_back(modelPoint(*line->p2));
  }
  return points;
}

}  // namespace ringhook
