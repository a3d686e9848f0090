#pragma once

/// \file
/// Two cameras on one trigger: neither exposes before the other is ready, and both expose at the
/// same instant. Each camera runs on a thread of its own and meets the other one here; the second
/// to come makes the pair for both. A camera whose partner does not come (it is not streaming)
/// exposes alone after a while.

#include <array>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "core/image.h"

namespace ringhook {

/// A pair of exposures that is about to be made.
struct ExposureRequest {
  std::array<Window, 2> regions;  ///< to be read, left and right [px]; empty: not this camera
  double exposure_s = 0.0;        ///< [s]
};

/// What came of it.
struct ExposedPair {
  std::int64_t start_ns = 0;        ///< start of the exposure, host's real time [ns]
  std::array<GrayImage, 2> images;  ///< pixels of the regions
};

/// May take its time; nothing means that no picture will come any more. Called on the cameras'
/// threads, by one at a time.
using PairSource = std::function<std::optional<ExposedPair>(const ExposureRequest&)>;

/// One camera's part of a pair.
struct Exposed {
  std::int64_t start_ns = 0;  ///< host's real time [ns]
  GrayImage image;
};

class SharedTrigger {
 public:
  /// \param patience_s how long a camera waits for its partner [s]; a quarter of a second is many
  /// periods of any camera that streams.
  explicit SharedTrigger(PairSource source, double patience_s = 0.25)
      : source_(std::move(source)), patience_s_(patience_s) {}

  /// The image of camera `side` (0 left, 1 right) for `region`; waits for the other camera. Nothing
  /// once closed or if the source has nothing. Throws what the source throws.
  [[nodiscard]] std::optional<Exposed> expose(int side, const Window& region, double exposure_s);

  /// Lets everyone go who waits, now and later.
  void close();

 private:
  using Lock = std::unique_lock<std::mutex>;

  std::optional<Exposed> makePair(Lock& lock, const ExposureRequest& request, std::size_t side);

  PairSource source_;
  double patience_s_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::array<std::optional<Window>, 2> ready_;   ///< cameras that wait for their partner
  std::array<std::optional<Exposed>, 2> given_;  ///< made by the partner, not yet fetched
  bool making_ = false;                          ///< somebody is in the source
  std::int64_t pairs_without_result_ = 0;
  bool closed_ = false;
};

}  // namespace ringhook
