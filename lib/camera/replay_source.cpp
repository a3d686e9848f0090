#include "camera/replay_source.h"

#include <glob.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "camera/image_file.h"
#include "camera/replay_camera.h"
#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The run of digits at `at`, without leading zeros; moves `at` behind it.
std::string takeNumber(const std::string& text, std::size_t& at) {
  std::size_t end = at;
  while (end < text.size() && isDigit(text[end])) {
    ++end;
  }
  const std::size_t begin = std::min(text.find_first_not_of('0', at), end);
  at = end;
  return text.substr(begin, end - begin);
}

/// Compares runs of digits by their value, all else by character: image2 before image10.
bool naturallyBefore(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    if (!isDigit(a[i]) || !isDigit(b[j])) {
      if (a[i] != b[j]) {
        return a[i] < b[j];
      }
      ++i;
      ++j;
      continue;
    }
    const std::string left = takeNumber(a, i);
    const std::string right = takeNumber(b, j);
    if (left != right) {
      return left.size() != right.size() ? left.size() < right.size() : left < right;
    }
  }
  return a.size() - i < b.size() - j;
}

Sequence sequenceFromGlobs(const std::string& left, const std::string& right, double rate_hz) {
  const auto left_files = filesMatching(left);
  const auto right_files = filesMatching(right);
  if (left_files.empty() || (!right.empty() && right_files.empty())) {
    throw InputError("no file matches " + (left_files.empty() ? left : right) +
                     ": expected images or a video");
  }
  if (!right.empty() && left_files.size() != right_files.size()) {
    throw InputError(left + " matches " + std::to_string(left_files.size()) + " images and " +
                     right + " " + std::to_string(right_files.size()) +
                     ": expected as many on both sides");
  }
  Sequence sequence;
  sequence.rate_hz = rate_hz;
  for (std::size_t i = 0; i < left_files.size(); ++i) {
    SequenceFrame frame;
    frame.frame = i;
    frame.time = Time::fromSeconds(static_cast<double>(i) / rate_hz);
    frame.left = left_files[i];
    frame.right = right.empty() ? fs::path() : right_files[i];
    sequence.frames.push_back(std::move(frame));
  }
  return sequence;
}

class SequenceSource : public ReplaySource {
 public:
  explicit SequenceSource(Sequence sequence) : sequence_(std::move(sequence)) {}

  [[nodiscard]] std::optional<ReplayedFrame> next() override {
    if (finished()) {
      return std::nullopt;
    }
    const SequenceFrame& stored = sequence_.frames[next_++];
    ReplayedFrame read{{}, stored.placed, stored.left.string(), stored.right.string()};
    StereoFrame& frame = read.frame;
    frame.time = stored.time;
    frame.index = stored.frame;
    frame.left = readGrayImage(stored.left);
    frame.left_window = {stored.left_x_px, stored.left_y_px, frame.left.width, frame.left.height};
    if (!stored.right.empty()) {
      frame.right = readGrayImage(stored.right);
      frame.right_window = {stored.right_x_px, stored.right_y_px, frame.right.width,
                            frame.right.height};
    }
    return read;
  }
  [[nodiscard]] bool finished() const override { return next_ >= sequence_.frames.size(); }
  [[nodiscard]] std::size_t expectedFrames() const override { return sequence_.frames.size(); }

 private:
  Sequence sequence_;
  std::size_t next_ = 0;
};

class VideoSource : public ReplaySource {
 public:
  VideoSource(const std::string& left, const std::string& right, double rate_hz)
      : left_name_(left), right_name_(right), left_(left), rate_hz_(rate_hz) {
    if (!right.empty()) {
      right_.emplace(right);
    }
  }

  [[nodiscard]] std::optional<ReplayedFrame> next() override {
    auto left = left_.next();
    auto right = right_ && left ? right_->next() : std::nullopt;
    if (!left || (right_ && !right)) {
      finished_ = true;
      return std::nullopt;
    }
    ReplayedFrame read{{}, false, left_name_, right_name_};
    StereoFrame& frame = read.frame;
    frame.index = next_;
    frame.time = Time::fromSeconds(static_cast<double>(next_++) / rate_hz_);
    frame.left_window = {0, 0, left->width, left->height};
    frame.left = std::move(*left);
    if (right) {
      frame.right_window = {0, 0, right->width, right->height};
      frame.right = std::move(*right);
    }
    return read;
  }
  [[nodiscard]] bool finished() const override { return finished_; }
  [[nodiscard]] std::size_t expectedFrames() const override { return left_.expectedFrames(); }

 private:
  std::string left_name_;
  std::string right_name_;
  VideoReader left_;
  std::optional<VideoReader> right_;
  double rate_hz_;
  std::uint64_t next_ = 0;
  bool finished_ = false;
};

}  // namespace

std::vector<fs::path> filesMatching(const std::string& pattern) {
  std::vector<fs::path> files;
  glob_t found{};
  if (::glob(pattern.c_str(), 0, nullptr, &found) == 0) {
    for (std::size_t i = 0; i < found.gl_pathc; ++i) {
      if (isFile(found.gl_pathv[i])) {
        files.emplace_back(found.gl_pathv[i]);
      }
    }
  }
  ::globfree(&found);
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return naturallyBefore(a.string(), b.string());
  });
  return files;
}

std::unique_ptr<ReplaySource> sourceOfSequence(Sequence sequence) {
  return std::make_unique<SequenceSource>(std::move(sequence));
}

std::unique_ptr<ReplaySource> sourceOfFiles(const std::string& left, const std::string& right,
                                            double rate_hz) {
  if (!(rate_hz > 0.0)) {
    throw InputError("a replay of loose files needs a positive frame rate");
  }
  if (!right.empty() && isVideoName(left) != isVideoName(right)) {
    throw InputError(left + " and " + right + ": expected two videos or two globs of images");
  }
  if (isVideoName(left)) {
    return std::make_unique<VideoSource>(left, right, rate_hz);
  }
  return sourceOfSequence(sequenceFromGlobs(left, right, rate_hz));
}

}  // namespace ringhook
