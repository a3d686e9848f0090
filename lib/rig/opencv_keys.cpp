#include "rig/opencv_keys.h"

#include "core/error.h"

namespace ringhook {

int OpenCvKeys::integer(const std::string& key) const {
  const cv::FileNode node = root_[key];
  if (!node.isInt()) {
    fail(key, "an integer");
  }
  return static_cast<int>(node);
}

std::optional<double> OpenCvKeys::number(const std::string& key) const {
  if (!has(key)) {
    return std::nullopt;
  }
  const cv::FileNode node = root_[key];
  if (!node.isInt() && !node.isReal()) {
    fail(key, "a number");
  }
  return static_cast<double>(node);
}

std::optional<std::string> OpenCvKeys::text(const std::string& key) const {
  if (!has(key)) {
    return std::nullopt;
  }
  if (!root_[key].isString()) {
    fail(key, "a string in quotes");
  }
  return static_cast<std::string>(root_[key]);
}

Eigen::MatrixXd OpenCvKeys::matrix(const std::string& key, int rows, int cols) const {
  const std::string shape = std::to_string(rows) + "x" + std::to_string(cols) + " matrix";
  Eigen::MatrixXd m = anyMatrix(key, shape);
  if (m.rows() != rows || m.cols() != cols) {
    fail(key, "a " + shape + ", not " + std::to_string(m.rows()) + "x" + std::to_string(m.cols()));
  }
  return m;
}

Eigen::VectorXd OpenCvKeys::vector(const std::string& key, int most) const {
  const std::string shape = "row or column of at most " + std::to_string(most) + " numbers";
  Eigen::MatrixXd m = anyMatrix(key, shape);
  if ((m.rows() > 1 && m.cols() > 1) || m.size() > most) {
    fail(key, "a " + shape + ", not " + std::to_string(m.rows()) + "x" + std::to_string(m.cols()));
  }
  return m.reshaped();
}

void OpenCvKeys::fail(const std::string& key, const std::string& expected) const {
  throw InputError(file_ + ": key " + key + (has(key) ? " must be " : " is missing, expected ") +
                   expected);
}

Eigen::MatrixXd OpenCvKeys::anyMatrix(const std::string& key, const std::string& shape) const {
  const cv::FileNode node = root_[key];
  const std::string expected = "a " + shape + " (!!opencv-matrix of type d or f)";
  if (!node.isMap() || !node["rows"].isInt() || !node["cols"].isInt() || !node["dt"].isString() ||
      !node["data"].isSeq()) {
    fail(key, expected);
  }
  const int rows = static_cast<int>(node["rows"]);
  const int cols = static_cast<int>(node["cols"]);
  const std::string type = static_cast<std::string>(node["dt"]);
  const bool sane =
      rows >= 0 && cols >= 0 && rows <= 64 && cols <= 64 && (type == "d" || type == "f") &&
      node["data"].size() == static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols);
  if (!sane) {
    fail(key, expected);
  }
  Eigen::MatrixXd m(rows, cols);
  for (int i = 0; i < rows * cols; ++i) {
    const cv::FileNode value = node["data"][i];
    if (!value.isInt() && !value.isReal()) {
      fail(key, expected);
    }
    m(i / cols, i % cols) = static_cast<double>(value);
  }
  return m;
}

}  // namespace ringhook
