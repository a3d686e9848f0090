#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <iostream>

#include "core/error.h"
#include "sim/lens_map.h"
#include "sim/nominal_rig.h"
#include "sim/sensor_noise.h"

namespace ringhook {
namespace {

TEST(LensMap, SamplesWhereTheLensModelSeesTheRay) {
  const CameraModel camera = nominalRig().left;
  const LensMap map(camera);
  std::vector<LensMap::Sample> row(2048);
  double worst = 0.0;
  for (int y = 3; y < 2048; y += 68) {
    map.row(0, y, row);
    for (int x = 0; x < 2048; x += 13) {
      const LensMap::Sample& s = row[static_cast<std::size_t>(x)];
      const Eigen::Vector2d ray = Eigen::Vector2d(s.x, s.y) / map.focalPx();
      worst = std::max(worst, (projectNormalised(camera, ray) - Eigen::Vector2d(x, y)).norm());
    }
  }
  RecordProperty("worst_px", std::to_string(worst));
  EXPECT_LT(worst, 0.004);
}

TEST(LensMap, PlaneWindowHoldsEverySampleAndItsNeighbours) {
  const LensMap map(nominalRig().left);
  for (const Window& w :
       {Window{0, 0, 2048, 2048}, Window{1500, 3, 512, 400}, Window{7, 9, 1, 1}}) {
    const Window plane = map.planeWindow(w);
    std::vector<LensMap::Sample> row(static_cast<std::size_t>(w.width));
    for (int y = w.y; y < w.y + w.height; ++y) {
      map.row(w.x, y, row);
      for (const LensMap::Sample& s : row) {
        ASSERT_TRUE(plane.contains(std::floor(s.x), std::floor(s.y)));
        ASSERT_TRUE(plane.contains(std::floor(s.x) + 1, std::floor(s.y) + 1));
      }
    }
  }
}

TEST(LensMap, LightFallsWithTheFourthPowerOfTheCosine) {
  CameraModel pinhole = nominalRig().left;
  pinhole.distortion.setZero();
  std::vector<LensMap::Sample> row(1);
  LensMap(pinhole).row(2047, 2047, row);
  const Eigen::Vector3d ray((2047 - 1027.3) / 2500.0, (2047 - 1019.8) / 2500.0, 1.0);
  EXPECT_NEAR(double{row[0].light}, std::pow(ray.normalized().z(), 4), 1e-5);
}

TEST(LensMap, RefusesALensThatFoldsInsideTheImage) {
  CameraModel camera = nominalRig().left;
  camera.distortion = Eigen::Vector4d(-2.0, 0.0, 0.0, 0.0);
  EXPECT_THROW(LensMap{camera}, Error);
}

std::vector<std::uint8_t> exposed(const SensorNoise& sensor, const ExposureKey& key, int x0, int y,
                                  float brightness, int count) {
  const std::vector<float> light(static_cast<std::size_t>(count), brightness);
  std::vector<std::uint8_t> grey(light.size());
  sensor.expose(key, x0, y, light.data(), count, grey.data());
  return grey;
}

TEST(SensorNoise, HasTheMeanAndVarianceOfPhotonTransfer) {
  const SensorNoise sensor({});
  for (const float level : {20.0F, 100.0F, 200.0F}) {
    double sum = 0.0;
    double squares = 0.0;
    int count = 0;
    for (int y = 0; y < 200; ++y) {
      for (const std::uint8_t grey : exposed(sensor, {5, 1, 0}, 0, y, level, 500)) {
        sum += grey;
        squares += grey * grey;
        ++count;
      }
    }
    const double mean = sum / count;
    const double variance = squares / count - mean * mean;
    const double electrons = double{level} / 255.0 * 10000.0;
    const double expected = (electrons + 100.0) * std::pow(255.0 / 10000.0, 2) + 1.0 / 12.0;
    EXPECT_NEAR(mean, double{level}, 0.05);
    EXPECT_NEAR(variance / expected, 1.0, 0.05) << level;
  }
}

/// Mean and variance of grey values over a field of even light.
Eigen::Vector2d meanAndVariance(const SensorNoise& sensor, float level) {
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;
  for (int y = 0; y < 300; ++y) {
    for (const std::uint8_t grey : exposed(sensor, {5, 1, 0}, 0, y, level, 500)) {
      sum += grey;
      squares += grey * grey;
      ++count;
    }
  }
  const double mean = sum / count;
  return {mean, squares / count - mean * mean};
}

TEST(SensorNoise, VarianceOverMeanIsALineWithTheGainAsItsSlope) {
  for (const double gain : {1.0, 4.0}) {
    const SensorNoise sensor({.gain = gain, .black_level = 12.0});
    Eigen::Matrix<double, 9, 2> rows;
    Eigen::Matrix<double, 9, 1> variances;
    for (int i = 0; i < 9; ++i) {
      const auto light = static_cast<float>((15.0 + 22.0 * i) / gain);
      const Eigen::Vector2d seen = meanAndVariance(sensor, light);
      rows.row(i) << seen[0] - 12.0, 1.0;
      variances[i] = seen[1] - 1.0 / 12.0;
    }
    const Eigen::Vector2d line = rows.colPivHouseholderQr().solve(variances);
    const double slope = gain * 255.0 / 10000.0;  // EMVA 1288's overall system gain K
    std::cout << "gain " << gain << ": photon transfer slope " << line[0] << " (true " << slope
              << "), read noise " << std::sqrt(line[1]) / slope << " e (true 10)\n";
    EXPECT_NEAR(line[0] / slope, 1.0, 0.02);
    EXPECT_NEAR(std::sqrt(line[1]) / slope, 10.0, 2.0);
  }
}

TEST(SensorNoise, CollectsLightInProportionToTheExposureUntilTheWellIsFull) {
  const auto grey = [](double exposure_s) {
    const SensorNoise sensor({.exposure_s = exposure_s, .noise = false});
    return int{exposed(sensor, {1, 1, 0}, 0, 0, 100.0F, 1).front()};
  };
  EXPECT_EQ(grey(0.00025), 50);
  EXPECT_EQ(grey(0.0005), 100);
  EXPECT_EQ(grey(0.001), 200);
  EXPECT_EQ(grey(0.002), 255);
}

TEST(SensorNoise, DependsOnThePlaceNotOnTheWindow) {
  const SensorNoise sensor({});
  const auto whole = exposed(sensor, {9, 4, 1}, 0, 77, 120.0F, 400);
  const auto part = exposed(sensor, {9, 4, 1}, 150, 77, 120.0F, 100);
  EXPECT_TRUE(std::equal(part.begin(), part.end(), whole.begin() + 150));
}

TEST(SensorNoise, DiffersBySeedFrameSideAndRow) {
  const SensorNoise sensor({});
  const auto reference = exposed(sensor, {9, 4, 0}, 0, 77, 120.0F, 100);
  EXPECT_NE(reference, exposed(sensor, {8, 4, 0}, 0, 77, 120.0F, 100));
  EXPECT_NE(reference, exposed(sensor, {9, 5, 0}, 0, 77, 120.0F, 100));
  EXPECT_NE(reference, exposed(sensor, {9, 4, 1}, 0, 77, 120.0F, 100));
  EXPECT_NE(reference, exposed(sensor, {9, 4, 0}, 0, 78, 120.0F, 100));
}

TEST(SensorNoise, SwitchedOffOnlyScalesRoundsAndClips) {
  const SensorNoise sensor({.gain = 2.0, .noise = false});
  EXPECT_EQ(exposed(sensor, {1, 1, 0}, 0, 0, 60.3F, 1).front(), 121);
  EXPECT_EQ(exposed(sensor, {1, 1, 0}, 0, 0, 200.0F, 1).front(), 255);
}

}  // namespace
}  // namespace ringhook
