// First values for the joint refinement: Zhang's closed form and OpenCV's refinement of each
// camera alone, then one pose between the cameras out of all that the views propose.

#include <Eigen/Geometry>
#include <algorithm>
#include <opencv2/calib3d.hpp>

#include "calib/solve/stereo_problem.h"
#include "core/error.h"

namespace ringhook {
namespace {

struct OneCamera {
  CameraModel model;
  std::vector<Pose> cMt;
};

Eigen::Vector3d vectorOf(const cv::Mat& m) {
  return {m.at<double>(0), m.at<double>(1), m.at<double>(2)};
}

CameraModel modelOf(const cv::Mat& K, const cv::Mat& distortion, const cv::Size& size,
                    LensTerms terms) {
  CameraModel model;
  model.width = size.width;
  model.height = size.height;
  model.K << K.at<double>(0, 0), 0, K.at<double>(0, 2), 0, K.at<double>(1, 1), K.at<double>(1, 2),
      0, 0, 1;
  model.distortion = Eigen::VectorXd::Zero(static_cast<int>(terms));
  for (int i = 0; i < std::min(5, static_cast<int>(terms)); ++i) {
    model.distortion[i] = distortion.at<double>(i);
  }
  return model;
}

// The eight-term lens starts as one of five terms: its fraction is then refined jointly.
int calibrationFlags(LensTerms terms) {
  return terms == LensTerms::kNone
             ? cv::CALIB_ZERO_TANGENT_DIST + cv::CALIB_FIX_K1 + cv::CALIB_FIX_K2 + cv::CALIB_FIX_K3
             : 0;
}

OneCamera calibrateAlone(const std::vector<std::vector<cv::Point3f>>& points,
                         const std::vector<std::vector<cv::Point2f>>& pixels, const cv::Size& size,
                         LensTerms terms) {
  cv::Mat K;
  cv::Mat distortion;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::calibrateCamera(points, pixels, size, K, distortion, rotations, translations,
                      calibrationFlags(terms));
  OneCamera camera{modelOf(K, distortion, size, terms), {}};
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    camera.cMt.push_back(makePoseThetaU(vectorOf(translations[i]), vectorOf(rotations[i])));
  }
  return camera;
}

// The proposal that is closest to all others; outlying views do not move it.
Pose medianPose(const std::vector<Pose>& proposals) {
  const auto distance = [](const Pose& a, const Pose& b) {
    return (a.matrix() - b.matrix()).lpNorm<1>();
  };
  const auto total = [&](const Pose& a) {
    double sum = 0.0;
    for (const Pose& b : proposals) {
      sum += distance(a, b);
    }
    return sum;
  };
  return *std::min_element(proposals.begin(), proposals.end(),
                           [&](const Pose& a, const Pose& b) { return total(a) < total(b); });
}

std::vector<cv::Point2f> pixelsOf(const BoardSighting& sighting) {
  std::vector<cv::Point2f> result;
  for (const Eigen::Vector2d& p : sighting.pixels) {
    result.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  return result;
}

std::vector<cv::Point3f> pointsOf(const BoardSighting& sighting,
                                  const std::vector<Eigen::Vector3d>& points) {
  std::vector<cv::Point3f> result;
  for (const int id : sighting.ids) {
    const Eigen::Vector3d& p = points[static_cast<std::size_t>(id)];
    result.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()), 0.0F);
  }
  return result;
}

}  // namespace

StereoSolution startSolution(const std::vector<StereoView>& views, const Board& board,
                             LensTerms terms) {
  const std::vector<Eigen::Vector3d> points = board.points();
  std::vector<std::vector<cv::Point3f>> left_points;
  std::vector<std::vector<cv::Point3f>> right_points;
  std::vector<std::vector<cv::Point2f>> left;
  std::vector<std::vector<cv::Point2f>> right;
  for (const StereoView& view : views) {
    left_points.push_back(pointsOf(view.left, points));
    right_points.push_back(pointsOf(view.right, points));
    left.push_back(pixelsOf(view.left));
    right.push_back(pixelsOf(view.right));
  }
  const cv::Size size(views.front().width, views.front().height);
  try {
    const OneCamera first = calibrateAlone(left_points, left, size, terms);
    const OneCamera second = calibrateAlone(right_points, right, size, terms);
    std::vector<Pose> proposals;
    for (std::size_t i = 0; i < views.size(); ++i) {
      proposals.push_back(second.cMt[i] * first.cMt[i].inverse());
    }
    StereoSolution solution;
    solution.rig.left = first.model;
    solution.rig.right = second.model;
    solution.rig.c2Mc1 = medianPose(proposals);
    solution.c1Mt = first.cMt;
    return solution;
  } catch (const cv::Exception& e) {
    throw Error("the views do not determine the cameras (" + e.err +
                "): take pictures with the board tilted in different directions");
  }
}

}  // namespace ringhook
