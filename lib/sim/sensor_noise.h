#pragma once

/// \file
/// What the sensor makes of the light: exposure, shot noise and read noise, gain, 8 bits. Photon
/// transfer (EMVA Standard 1288, release 3.1, section 2): of e electrons collected (at most the
/// full well) the variance is e + read_noise^2; the grey value is K (e + noise) + black level with
/// K = gain * 255 / full_well_e. So variance over mean is a line of slope K, and the offset is
/// K^2 read_noise^2 + 1/12 for the rounding to whole grey values. Brightness 255 fills the well in
/// the default exposure of 0.5 ms.
/// Each pixel's noise depends on seed, frame, side and its place in the full image alone: a window
/// sees exactly the noise that the full image has there.

#include <cstdint>
#include <vector>

namespace ringhook {

struct SensorOptions {
  /// Time during which the sensor collects light; moving things smear by their motion in it [s].
  double exposure_s = 0.0005;
  double gain = 1.0;             ///< amplifier, on collected electrons: brightens light and noise
  double full_well_e = 10000.0;  ///< electrons at grey value 255 with gain 1; more are lost
  double read_noise_e = 10.0;    ///< standard deviation [electrons]
  double black_level = 0.0;      ///< added to every grey value [grey values]
  bool noise = true;             ///< false: no shot and read noise
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

  /// Grey values from brightness (255 = full well in 0.5 ms) of pixels x0 .. x0 + count - 1 of row
  /// y of the full image; count is at most 8192.
  void expose(const ExposureKey& key, int x0, int y, const float* brightness, int count,
              std::uint8_t* grey) const;

  [[nodiscard]] const SensorOptions& options() const { return options_; }

 private:
  SensorOptions options_;
  std::vector<float> normals_;  // standard normal values
};

}  // namespace ringhook
