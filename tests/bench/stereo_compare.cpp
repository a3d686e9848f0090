// OpenCV's 13 stereo pairs, calibrated four ways: as OpenCV's sample program does, with OpenCV's
// functions at their best, and as ringhook does without and with the board's shape:
//   stereo_compare [--data DIR]

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "calib/solve/stereo_calibration.h"
#include "core/error.h"

namespace ringhook {
namespace {

using Pixels = std::vector<cv::Point2f>;

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// All views' corners in both images.
struct Shots {
  std::vector<Pixels> left;
  std::vector<Pixels> right;
  cv::Size size;
};

/// What OpenCV returns, as a rig.
struct Fit {
  double rms_px = 0.0;
  StereoRig rig;
};

using Calibrate = std::function<Fit(const Shots&)>;

Pixels cornersIn(const std::string& path, int window, cv::Size& size) {
  const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  Pixels corners;
  if (image.empty() ||
      !cv::findChessboardCorners(image, {9, 6}, corners,
                                 cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE)) {
    throw InputError(path + ": expected a picture with a chessboard of 9x6 corners");
  }
  size = image.size();
  cv::cornerSubPix(image, corners, {window, window}, {-1, -1},
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 0.01});
  return corners;
}

Shots shotsOf(const std::string& folder, int window) {
  Shots shots;
  for (int i = 1; i <= 14; ++i) {
    if (i == 10) {
      continue;  // there is no tenth pair
    }
    const std::string number = std::to_string(100 + i).substr(1) + ".jpg";
    shots.left.push_back(cornersIn(folder + "/left" + number, window, shots.size));
    shots.right.push_back(cornersIn(folder + "/right" + number, window, shots.size));
  }
  return shots;
}

std::vector<std::vector<cv::Point3f>> boardsFor(const Shots& shots) {
  std::vector<cv::Point3f> board;
  for (int i = 0; i < 54; ++i) {
    board.emplace_back(0.025F * static_cast<float>(i % 9), 0.025F * static_cast<float>(i / 9),
                       0.0F);
  }
  return {shots.left.size(), board};
}

CameraModel modelOf(const cv::Mat& K, const cv::Mat& D, const cv::Size& size) {
  CameraModel model;
  model.width = size.width;
  model.height = size.height;
  model.K << K.at<double>(0, 0), 0, K.at<double>(0, 2), 0, K.at<double>(1, 1), K.at<double>(1, 2),
      0, 0, 1;
  model.distortion = Eigen::VectorXd(D.total() > 5 ? 8 : 5);
  for (int i = 0; i < model.distortion.size(); ++i) {
    model.distortion[i] = D.at<double>(i);
  }
  return model;
}

Fit stereoCalibrate(const Shots& shots, cv::Mat K1, cv::Mat D1, cv::Mat K2, cv::Mat D2, int flags) {
  cv::Mat R;
  cv::Mat T;
  cv::Mat E;
  cv::Mat F;
  Fit fit;
  fit.rms_px = cv::stereoCalibrate(boardsFor(shots), shots.left, shots.right, K1, D1, K2, D2,
                                   shots.size, R, T, E, F, flags,
                                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 100, 1e-5});
  fit.rig.left = modelOf(K1, D1, shots.size);
  fit.rig.right = modelOf(K2, D2, shots.size);
  for (int i = 0; i < 9; ++i) {
    fit.rig.c2Mc1.linear()(i / 3, i % 3) = R.at<double>(i / 3, i % 3);
  }
  fit.rig.c2Mc1.translation() << T.at<double>(0), T.at<double>(1), T.at<double>(2);
  return fit;
}

// samples/cpp/stereo_calib.cpp: its start and its flags.
Fit asTheSample(const Shots& shots) {
  const cv::Mat K1 = cv::initCameraMatrix2D(boardsFor(shots), shots.left, shots.size, 0);
  const cv::Mat K2 = cv::initCameraMatrix2D(boardsFor(shots), shots.right, shots.size, 0);
  return stereoCalibrate(shots, K1, {}, K2, {},
                         cv::CALIB_FIX_ASPECT_RATIO + cv::CALIB_ZERO_TANGENT_DIST +
                             cv::CALIB_USE_INTRINSIC_GUESS + cv::CALIB_SAME_FOCAL_LENGTH +
                             cv::CALIB_RATIONAL_MODEL + cv::CALIB_FIX_K3 + cv::CALIB_FIX_K4 +
                             cv::CALIB_FIX_K5);
}

// Each camera alone, then both together with nothing held.
Fit withNothingHeld(const Shots& shots) {
  cv::Mat K1;
  cv::Mat D1;
  cv::Mat K2;
  cv::Mat D2;
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  cv::calibrateCamera(boardsFor(shots), shots.left, shots.size, K1, D1, rotations, translations);
  cv::calibrateCamera(boardsFor(shots), shots.right, shots.size, K2, D2, rotations, translations);
  return stereoCalibrate(shots, K1, D1, K2, D2, cv::CALIB_USE_INTRINSIC_GUESS);
}

StereoView viewOf(const Shots& shots, std::size_t i) {
  StereoView view;
  view.width = shots.size.width;
  view.height = shots.size.height;
  for (std::size_t j = 0; j < shots.left[i].size(); ++j) {
    view.left.ids.push_back(static_cast<int>(j));
    view.left.pixels.emplace_back(shots.left[i][j].x, shots.left[i][j].y);
    view.right.pixels.emplace_back(shots.right[i][j].x, shots.right[i][j].y);
  }
  view.right.ids = view.left.ids;
  return view;
}

// The same figure for everybody: rows of a view after a fit that left it out.
double heldOut(const Shots& shots, const Calibrate& calibrate) {
  std::vector<double> rows;
  for (std::size_t i = 0; i < shots.left.size(); ++i) {
    Shots training = shots;
    training.left.erase(training.left.begin() + static_cast<std::ptrdiff_t>(i));
    training.right.erase(training.right.begin() + static_cast<std::ptrdiff_t>(i));
    const auto view = rowDifferences(calibrate(training).rig, viewOf(shots, i));
    rows.insert(rows.end(), view.begin(), view.end());
  }
  return rootMeanSquare(rows);
}

void print(const char* name, double rms_px, double heldout_px, double cpu_s, double baseline_m) {
  std::printf("%-62s %8.4f %10.4f %9.3f %7.2f\n", name, rms_px, heldout_px, 1e3 * baseline_m,
              cpu_s);
}

void opencvRow(const char* name, const std::string& folder, int window, const Calibrate& way) {
  const double start = cpuSeconds();
  const Shots shots = shotsOf(folder, window);
  const Fit fit = way(shots);
  const double heldout = heldOut(shots, way);
  print(name, fit.rms_px, heldout, cpuSeconds() - start, baseline(fit.rig));
}

void ringhookRow(const char* name, const std::string& folder, const StereoOptions& options) {
  const StepHook silent = [](double, const std::string&) {};
  const double start = cpuSeconds();
  const Board board = parseBoard("chessboard:9x6:25mm");
  const StereoViews views = findViews(expandGlob(folder + "/left??.jpg", "--data"),
                                      expandGlob(folder + "/right??.jpg", "--data"), board, silent);
  const StereoCalibration c = calibrateStereo(views, board, options, silent);
  print(name, c.rms_px, c.heldout_vertical_disparity_px, cpuSeconds() - start, baseline(c.rig));
}

void compare(const std::string& folder) {
  std::printf("%-62s %8s %10s %9s %7s\n", "way (13 pairs, leave one out, square taken as 25 mm)",
              "RMS_px", "heldout_px", "base_mm", "cpu_s");
  opencvRow("OpenCV's sample: its flags, window 11", folder, 11, asTheSample);
  opencvRow("OpenCV, nothing held, window 11", folder, 11, withNothingHeld);
  opencvRow("OpenCV, nothing held, window 7", folder, 7, withNothingHeld);
  ringhookRow("ringhook: window from the square, lens model chosen", folder, {});
  ringhookRow("ringhook: five terms given", folder, {LensTerms::kFive});
  ringhookRow("ringhook --board-shape: lens model chosen", folder, {std::nullopt, true});
}

}  // namespace
}  // namespace ringhook

int main(int argc, char** argv) {
  CLI::App app("OpenCV's 13 stereo pairs, calibrated OpenCV's way and ringhook's");
  std::string folder = "/usr/share/doc/opencv-doc/examples/data";
  app.add_option("--data", folder, "folder with left01.jpg to right14.jpg")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    ringhook::compare(folder);
  } catch (const ringhook::Error& e) {
    std::cerr << "stereo_compare: " << e.what() << "\n";
    return e.exitCode();
  } catch (const cv::Exception& e) {
    std::cerr << "stereo_compare: OpenCV gave up: " << e.err << "\n";
    return 1;
  }
  return 0;
}
