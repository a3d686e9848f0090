#pragma once

/// \file
/// What the sensor makes of the light: gain, shot noise and read noise, 8 bits. Photon transfer
/// (EMVA Standard 1288, release 3.1, section 2): with e electrons collected the variance is
/// e + read_noise^2; full scale (255) stands for the full well.
/// Each pixel's noise depends on seed, frame, side and its place in the full image alone: a window
/// sees exactly the noise that the full image has there.

#include <array>
#include <cstdint>
#include <vector>

namespace ringhook {

struct SensorOptions {
  double gain = 1.0;             ///< on the drawn brightness
  double full_well_e = 10000.0;  ///< electrons at grey value 255
  double read_noise_e = 10.0;    ///< standard deviation [electrons]
  bool noise = true;             ///< false: gain and rounding only
};

/// Which exposure a row of pixels belongs to.
struct ExposureKey {
  std::uint64_t seed = 0;
  std::uint64_t frame = 0;
  int side = 0;  ///< 0 left, 1 right
};

class SensorNoise {
 public:
  explicit SensorNoise(const SensorOptions& options);

  /// Grey values from brightness (255 = full scale before gain) of pixels x0 .. x0 + count - 1 of
  /// row y of the full image.
  void expose(const ExposureKey& key, int x0, int y, const float* brightness, int count,
              std::uint8_t* grey) const;

  /// Standard deviation of the noise at a grey value [grey values].
  [[nodiscard]] double sigma(double grey) const;

 private:
  SensorOptions options_;
  std::array<float, 256> sigma_{};  // by grey value
  std::vector<float> normals_;      // standard normal values
};

}  // namespace ringhook
