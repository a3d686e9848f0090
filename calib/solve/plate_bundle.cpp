#include "calib/solve/plate_bundle.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <glog/logging.h>

#include <array>
#include <cmath>

#include "core/error.h"

namespace ringhook {
namespace {

using Block = std::array<double, 6>;  // translation [m], rotation vector [rad]
constexpr double kHuberSigmas = 3.0;

template <class T>
void apply(const Pose& aMb, const T* b, T* a) {
  for (int i = 0; i < 3; ++i) {
    a[i] = aMb(i, 0) * b[0] + aMb(i, 1) * b[1] + aMb(i, 2) * b[2] + aMb(i, 3);
  }
}

template <class T>
void move(const T* twist, const T* point, T* moved) {
  ceres::AngleAxisRotatePoint(twist + 3, point, moved);
  for (int i = 0; i < 3; ++i) {
    moved[i] += twist[i];
  }
}

template <class T>
void moveBack(const T* twist, const T* point, T* moved) {
  const std::array<T, 3> from{point[0] - twist[0], point[1] - twist[1], point[2] - twist[2]};
  const std::array<T, 3> turn{-twist[3], -twist[4], -twist[5]};
  ceres::AngleAxisRotatePoint(turn.data(), from.data(), moved);
}

// A corner in one camera under camera * a, target * b, and the arm's error d of its view.
struct CornerResidual {
  Pose cMc1;
  Pose c1Mh;
  Pose hMt;  // hMj jMt
  PinholeView view;
  Eigen::Vector3d point_t;
  Eigen::Vector2d seen;
  double sigma_px;

  template <class T>
  bool operator()(const T* a, const T* b, const T* d, T* residual) const {
    const std::array<T, 3> point{T(point_t.x()), T(point_t.y()), T(point_t.z())};
    std::array<T, 3> p;
    std::array<T, 3> q;
    move(d, point.data(), p.data());
    move(b, p.data(), q.data());
    apply(hMt, q.data(), p.data());
    apply(c1Mh, p.data(), q.data());
    moveBack(a, q.data(), p.data());
    apply(cMc1, p.data(), q.data());
    residual[0] = (view.fx * q[0] / q[2] + view.cx - seen.x()) / sigma_px;
    residual[1] = (view.fy * q[1] / q[2] + view.cy - seen.y()) / sigma_px;
    return true;
  }
};

struct ArmResidual {
  PairNoise arm;

  template <class T>
  bool operator()(const T* d, T* residual) const {
    for (int i = 0; i < 3; ++i) {
      residual[i] = d[i] / arm.translation_m;
      residual[3 + i] = d[3 + i] / arm.rotation_rad;
    }
    return true;
  }
};

// Ceres warns through glog of steps that it takes back by itself; its summary is what counts.
class QuietLog {
 public:
  QuietLog() : level_(FLAGS_minloglevel) { FLAGS_minloglevel = google::GLOG_FATAL; }
  ~QuietLog() { FLAGS_minloglevel = level_; }
  QuietLog(const QuietLog&) = delete;
  QuietLog& operator=(const QuietLog&) = delete;

 private:
  int level_;
};

Pose increment(const Block& block) {
  return makePoseThetaU({block[0], block[1], block[2]}, {block[3], block[4], block[5]});
}

struct Bundle {
  Block a{};
  Block b{};
  std::vector<Block> d;
  ceres::Problem problem;

  Bundle(const std::vector<PlateView>& views, const std::vector<bool>& used, EyeSetup setup,
         const HandEye& start, double sigma_px, const PairNoise& arm)
      : d(views.size()) {
    problem.AddParameterBlock(a.data(), 6);
    problem.AddParameterBlock(b.data(), 6);
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (used[i]) {
        addView(views[i], setup, start, sigma_px, d[i].data());
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<ArmResidual, 6, 6>(new ArmResidual{arm}), nullptr,
            d[i].data());
      }
    }
  }

  void addView(const PlateView& view, EyeSetup setup, const HandEye& start, double sigma_px,
               double* arm) {
    const Pose hMt =
        holderPose({"", view.fMe, Pose::Identity(), std::nullopt}, setup) * start.target;
    for (const CameraFeatures& camera : view.seen.cameras) {
      for (const CornerFeature& corner : camera.corners) {
        auto* residual =
            new CornerResidual{camera.camera.cMc1, start.camera.inverse(), hMt,     camera.camera,
                               corner.point_o,     corner.pixel,           sigma_px};
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<CornerResidual, 2, 6, 6, 6>(residual),
            new ceres::HuberLoss(kHuberSigmas), a.data(), b.data(), arm);
      }
    }
  }

  void solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.max_num_iterations = 200;
    options.function_tolerance = 1e-13;
    options.parameter_tolerance = 1e-13;
    options.gradient_tolerance = 1e-13;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (summary.termination_type != ceres::CONVERGENCE) {
      throw Error("the refinement on the plate's corners does not converge (" + summary.message +
                  "): more views with the flange turned are needed");
    }
  }

  [[nodiscard]] std::optional<Covariance12> covariance() {
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::SPARSE_QR;
    ceres::Covariance found(options);
    if (!found.Compute({{a.data(), a.data()}, {a.data(), b.data()}, {b.data(), b.data()}},
                       &problem)) {
      return std::nullopt;
    }
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> aa;
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> ab;
    Eigen::Matrix<double, 6, 6, Eigen::RowMajor> bb;
    found.GetCovarianceBlock(a.data(), a.data(), aa.data());
    found.GetCovarianceBlock(a.data(), b.data(), ab.data());
    found.GetCovarianceBlock(b.data(), b.data(), bb.data());
    Covariance12 all;
    all << aa, ab, ab.transpose(), bb;
    return all;
  }
};

}  // namespace

double cornerRms(const std::vector<PlateView>& views, const std::vector<bool>& used,
                 const std::vector<Pose>& c1Mt) {
  double sum = 0.0;
  double n = 0.0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!used[i]) {
      continue;
    }
    for (const CameraFeatures& camera : views[i].seen.cameras) {
      for (const CornerFeature& corner : camera.corners) {
        const auto pixel = camera.camera.project(c1Mt[i] * corner.point_o);
        sum += pixel ? (*pixel - corner.pixel).squaredNorm() : HUGE_VAL;
        n += 2.0;
      }
    }
  }
  return std::sqrt(sum / n);
}

std::vector<Pose> predictedPlates(const std::vector<PlateView>& views, EyeSetup setup,
                                  const HandEye& pose) {
  std::vector<Pose> c1Mt;
  for (const PlateView& view : views) {
    c1Mt.push_back(predictedTarget(pose, {"", view.fMe, Pose::Identity(), std::nullopt}, setup));
  }
  return c1Mt;
}

BundleResult refineOnPlates(const std::vector<PlateView>& views, const std::vector<bool>& used,
                            EyeSetup setup, const HandEye& start, double corner_sigma_px,
                            const PairNoise& arm) {
  const QuietLog quiet;
  BundleResult result;
  result.pose = start;
  // The second round starts at the minimum, so that increments and covariance are those of it.
  for (int round = 0; round < 2; ++round) {
    Bundle bundle(views, used, setup, result.pose, corner_sigma_px, arm);
    bundle.solve();
    result.pose.camera = result.pose.camera * increment(bundle.a);
    result.pose.target = result.pose.target * increment(bundle.b);
    result.covariance = bundle.covariance();
    std::vector<Pose> c1Mt = predictedPlates(views, setup, result.pose);
    for (std::size_t i = 0; i < c1Mt.size(); ++i) {
      c1Mt[i] = c1Mt[i] * increment(bundle.d[i]);
    }
    result.rms_px = cornerRms(views, used, c1Mt);
  }
  result.arm_rms_px = cornerRms(views, used, predictedPlates(views, setup, result.pose));
  return result;
}

}  // namespace ringhook
