#pragma once

/// \file
/// A tracked frame as a picture: the left rectified image with the model edges that were used, the
/// places where features were seen, and the axes of the hook frame, as a PNG. OpenCV stays behind
/// this fence.

#include <string>

#include "evaluation/sequence_evaluation.h"

namespace ringhook {

/// Bytes of a PNG, at most `largest_width` [px] wide.
[[nodiscard]] std::string overlayPng(const Snapshot& snapshot, int largest_width);

/// Base64 (RFC 4648) of bytes.
[[nodiscard]] std::string base64(const std::string& bytes);

}  // namespace ringhook
