#include "calib/solve/stereo_problem.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>
#include <glog/logging.h>

#include <Eigen/Geometry>
#include <array>
#include <mutex>

#include "core/error.h"

namespace ringhook {
namespace {

constexpr int kLensSize = 12;  // fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6
constexpr int kPoseSize = 6;   // rotation vector [rad], translation [m]
using LensBlock = std::array<double, kLensSize>;
using PoseBlock = std::array<double, kPoseSize>;

template <class T>
void transform(const T* pose, const T* point, T* moved) {
  ceres::AngleAxisRotatePoint(pose, point, moved);
  for (int i = 0; i < 3; ++i) {
    moved[i] += pose[3 + i];
  }
}

// The law of rig/camera_model.h, here for automatic derivatives.
template <class T>
void project(const T* lens, const T* point_c, T* pixel) {
  const T x = point_c[0] / point_c[2];
  const T y = point_c[1] / point_c[2];
  const T r2 = x * x + y * y;
  const T* k = lens + 4;
  const T s =
      (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) / (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  const T xd = s * x + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x);
  const T yd = s * y + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y;
  pixel[0] = lens[0] * xd + lens[2];
  pixel[1] = lens[1] * yd + lens[3];
}

// Each residual comes with the board's point given, and with the point as one more unknown.
struct LeftResidual {
  Eigen::Vector3d point_t;
  Eigen::Vector2d seen;

  template <class T>
  bool operator()(const T* left, const T* c1Mt, const T* point, T* residual) const {
    std::array<T, 3> point_c1;
    transform(c1Mt, point, point_c1.data());
    project(left, point_c1.data(), residual);
    residual[0] -= seen.x();
    residual[1] -= seen.y();
    return true;
  }
  template <class T>
  bool operator()(const T* left, const T* c1Mt, T* residual) const {
    const std::array<T, 3> point{T(point_t.x()), T(point_t.y()), T(point_t.z())};
    return (*this)(left, c1Mt, point.data(), residual);
  }
};

struct RightResidual {
  Eigen::Vector3d point_t;
  Eigen::Vector2d seen;

  template <class T>
  bool operator()(const T* right, const T* c2Mc1, const T* c1Mt, const T* point,
                  T* residual) const {
    std::array<T, 3> point_c1;
    std::array<T, 3> point_c2;
    transform(c1Mt, point, point_c1.data());
    transform(c2Mc1, point_c1.data(), point_c2.data());
    project(right, point_c2.data(), residual);
    residual[0] -= seen.x();
    residual[1] -= seen.y();
    return true;
  }
  template <class T>
  bool operator()(const T* right, const T* c2Mc1, const T* c1Mt, T* residual) const {
    const std::array<T, 3> point{T(point_t.x()), T(point_t.y()), T(point_t.z())};
    return (*this)(right, c2Mc1, c1Mt, point.data(), residual);
  }
};

// A point of the print lies where it should within `sigma` [m]; that weighs as much as a residual
// of a tenth of a pixel.
struct PrintPrior {
  Eigen::Vector3d printed_t;
  Eigen::Vector3d sigma;

  template <class T>
  bool operator()(const T* point, T* residual) const {
    for (int i = 0; i < 3; ++i) {
      residual[i] = (point[i] - printed_t[i]) * (0.1 / sigma[i]);
    }
    return true;
  }
};

// k4 k5 k6 can cancel k1 k2 k3 and grow without bound where the corners do not tell them apart. A
// weak prior, zero with a standard deviation of one, keeps the lens regular; one step of it weighs
// as much as one residual of a tenth of a pixel.
struct DenominatorPrior {
  template <class T>
  bool operator()(const T* lens, T* residual) const {
    for (int i = 0; i < 3; ++i) {
      residual[i] = 0.1 * lens[9 + i];
    }
    return true;
  }
};

// Ceres warns through glog of steps that it takes back by itself; its summary is what counts.
void silenceLog() {
  static std::once_flag once;
  std::call_once(once, [] { FLAGS_minloglevel = google::GLOG_FATAL; });
}

LensBlock blockOf(const CameraModel& model) {
  LensBlock block{model.K(0, 0), model.K(1, 1), model.K(0, 2), model.K(1, 2)};
  for (int i = 0; i < model.distortion.size(); ++i) {
    block[4U + static_cast<std::size_t>(i)] = model.distortion[i];
  }
  return block;
}

PoseBlock blockOf(const Pose& pose) {
  const Eigen::Vector3d r = thetaU(pose.linear());
  const Eigen::Vector3d t = pose.translation();
  return {r.x(), r.y(), r.z(), t.x(), t.y(), t.z()};
}

Pose poseOf(const PoseBlock& block) {
  return makePoseThetaU({block[3], block[4], block[5]}, {block[0], block[1], block[2]});
}

void readBlock(const LensBlock& block, LensTerms terms, CameraModel& model) {
  model.K << block[0], 0, block[2], 0, block[1], block[3], 0, 0, 1;
  model.distortion = Eigen::Map<const Eigen::VectorXd>(block.data() + 4, static_cast<int>(terms));
}

// The parameters and the residuals over them.
struct Bundle {
  LensBlock left;
  LensBlock right;
  PoseBlock c2Mc1;
  std::vector<PoseBlock> c1Mt;
  std::vector<Eigen::Vector3d> points;
  ceres::Problem problem;

  Bundle(const StereoSolution& start, const std::vector<StereoView>& views, const Board& board,
         const FitOptions& options)
      : left(blockOf(start.rig.left)),
        right(blockOf(start.rig.right.value())),
        c2Mc1(blockOf(start.rig.c2Mc1)),
        points(start.board_points.empty() ? board.points() : start.board_points) {
    for (const Pose& pose : start.c1Mt) {
      c1Mt.push_back(blockOf(pose));
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
      addLeft(views[i].left, options.board_shape, c1Mt[i].data());
      addRight(views[i].right, options.board_shape, c1Mt[i].data());
    }
    if (options.board_shape) {
      addPrintPrior(board);
    }
    if (options.terms == LensTerms::kEight) {
      addLensPrior(left.data());
      addLensPrior(right.data());
    }
    holdUnusedTerms(options.terms);
  }

  void addLensPrior(double* lens) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<DenominatorPrior, 3, kLensSize>(new DenominatorPrior),
        nullptr, lens);
  }

  void addPrintPrior(const Board& board) {
    const std::vector<Eigen::Vector3d> printed = board.points();
    const Eigen::Vector3d sigma = board.pitch_m * Eigen::Vector3d(0.005, 0.005, 0.02);
    for (std::size_t j = 0; j < printed.size(); ++j) {
      problem.AddResidualBlock(
          new ceres::AutoDiffCostFunction<PrintPrior, 3, 3>(new PrintPrior{printed[j], sigma}),
          nullptr, points[j].data());
    }
  }

  void addLeft(const BoardSighting& sighting, bool shape, double* view_pose) {
    for (std::size_t j = 0; j < sighting.ids.size(); ++j) {
      Eigen::Vector3d& point = points[static_cast<std::size_t>(sighting.ids[j])];
      auto* residual = new LeftResidual{point, sighting.pixels[j]};
      if (shape) {
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<LeftResidual, 2, kLensSize, kPoseSize, 3>(residual),
            nullptr, left.data(), view_pose, point.data());
      } else {
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<LeftResidual, 2, kLensSize, kPoseSize>(residual),
            nullptr, left.data(), view_pose);
      }
    }
  }

  void addRight(const BoardSighting& sighting, bool shape, double* view_pose) {
    for (std::size_t j = 0; j < sighting.ids.size(); ++j) {
      Eigen::Vector3d& point = points[static_cast<std::size_t>(sighting.ids[j])];
      auto* residual = new RightResidual{point, sighting.pixels[j]};
      if (shape) {
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<RightResidual, 2, kLensSize, kPoseSize, kPoseSize, 3>(
                residual),
            nullptr, right.data(), c2Mc1.data(), view_pose, point.data());
      } else {
        problem.AddResidualBlock(
            new ceres::AutoDiffCostFunction<RightResidual, 2, kLensSize, kPoseSize, kPoseSize>(
                residual),
            nullptr, right.data(), c2Mc1.data(), view_pose);
      }
    }
  }

  void holdUnusedTerms(LensTerms terms) {
    std::vector<int> held;
    for (int i = 4 + static_cast<int>(terms); i < kLensSize; ++i) {
      held.push_back(i);
    }
    if (!held.empty()) {
      problem.SetManifold(left.data(), new ceres::SubsetManifold(kLensSize, held));
      problem.SetManifold(right.data(), new ceres::SubsetManifold(kLensSize, held));
    }
  }
};

}  // namespace

StereoSolution refineSolution(const StereoSolution& start, const std::vector<StereoView>& views,
                              const Board& board, const FitOptions& fit) {
  silenceLog();
  Bundle bundle(start, views, board, fit);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 500;
  options.function_tolerance = 1e-12;
  options.parameter_tolerance = 1e-12;
  options.gradient_tolerance = 1e-12;
  options.logging_type = ceres::SILENT;
  options.num_threads = std::max(1, fit.threads);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &bundle.problem, &summary);
  if (summary.termination_type != ceres::CONVERGENCE) {
    throw Error("the stereo calibration does not converge (" + summary.message +
                "): take more pictures with the board tilted in different directions");
  }
  StereoSolution solution = start;
  readBlock(bundle.left, fit.terms, solution.rig.left);
  readBlock(bundle.right, fit.terms, *solution.rig.right);
  solution.rig.c2Mc1 = poseOf(bundle.c2Mc1);
  for (std::size_t i = 0; i < views.size(); ++i) {
    solution.c1Mt[i] = poseOf(bundle.c1Mt[i]);
  }
  if (fit.board_shape) {
    solution.board_points = bundle.points;
  }
  return solution;
}

std::optional<RigCovariance> rigCovariance(const StereoSolution& solution,
                                           const std::vector<StereoView>& views, const Board& board,
                                           const FitOptions& fit) {
  silenceLog();
  Bundle bundle(solution, views, board, fit);
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::SPARSE_QR;
  options.num_threads = std::max(1, fit.threads);
  ceres::Covariance covariance(options);
  const std::vector<const double*> blocks{bundle.left.data(), bundle.right.data(),
                                          bundle.c2Mc1.data()};
  if (!covariance.Compute(blocks, &bundle.problem)) {
    return std::nullopt;
  }
  Eigen::Matrix<double, 30, 30, Eigen::RowMajor> matrix;
  if (!covariance.GetCovarianceMatrix(blocks, matrix.data())) {
    return std::nullopt;
  }
  return RigCovariance(matrix);
}

}  // namespace ringhook
