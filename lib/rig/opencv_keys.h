#pragma once

/// \file
/// Strict reading of the top-level keys of an OpenCV FileStorage file, for this folder's and
/// calib's sources: every failure is an InputError that names file, key and the expected shape.
/// This header shows OpenCV; no other public one includes it.

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace ringhook {

class OpenCvKeys {
 public:
  /// `root` of an open file, which must outlive this. \param file its name, for messages.
  OpenCvKeys(const cv::FileNode& root, std::string file) : root_(root), file_(std::move(file)) {}

  [[nodiscard]] bool has(const std::string& key) const { return !root_[key].empty(); }
  [[nodiscard]] int integer(const std::string& key) const;

  /// Absent if the key is.
  [[nodiscard]] std::optional<double> number(const std::string& key) const;
  [[nodiscard]] std::optional<std::string> text(const std::string& key) const;

  /// Matrix of exactly this shape.
  [[nodiscard]] Eigen::MatrixXd matrix(const std::string& key, int rows, int cols) const;

  /// Row or column of 0 to `most` numbers.
  [[nodiscard]] Eigen::VectorXd vector(const std::string& key, int most) const;

  [[noreturn]] void fail(const std::string& key, const std::string& expected) const;

 private:
  [[nodiscard]] Eigen::MatrixXd anyMatrix(const std::string& key, const std::string& shape) const;

  cv::FileNode root_;
  std::string file_;
};

}  // namespace ringhook
