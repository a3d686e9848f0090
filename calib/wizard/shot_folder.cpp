#include "calib/wizard/shot_folder.h"

#include <array>
#include <cstdio>
#include <utility>

#include "camera/image_file.h"
#include "core/atomic_file.h"
#include "core/file_kind.h"
#include "core/number_text.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

constexpr std::array kColumns = {"j1_rad", "j2_rad", "j3_rad", "j4_rad", "j5_rad", "j6_rad", "x",
                                 "y",      "z",      "qx",     "qy",     "qz",     "qw"};

std::string numbered(std::size_t index) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%04zu.png", index + 1);
  return name.data();
}

}  // namespace

ShotFolder::ShotFolder(fs::path folder, bool with_arm)
    : folder_(std::move(folder)), with_arm_(with_arm) {
  if (with_arm_ && isFile(table())) {
    arms_ = readArmRows(table());
  }
  while (isFile(left(count_)) && isFile(right(count_)) && (!with_arm_ || count_ < arms_.size())) {
    ++count_;
  }
  arms_.resize(with_arm_ ? count_ : 0);
}

fs::path ShotFolder::left(std::size_t index) const { return folder_ / "left" / numbered(index); }

fs::path ShotFolder::right(std::size_t index) const { return folder_ / "right" / numbered(index); }

std::vector<fs::path> ShotFolder::allLeft() const {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < count_; ++i) {
    files.push_back(left(i));
  }
  return files;
}

std::vector<fs::path> ShotFolder::allRight() const {
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < count_; ++i) {
    files.push_back(right(i));
  }
  return files;
}

void ShotFolder::add(const GrayImage& left_image, const GrayImage& right_image, const ArmRow& arm) {
  fs::create_directories(folder_ / "left");
  fs::create_directories(folder_ / "right");
  writeGrayImage(left(count_), left_image);
  writeGrayImage(right(count_), right_image);
  if (with_arm_) {
    std::vector<ArmRow> arms = arms_;
    arms.push_back(arm);
    writeTable(arms);
    arms_ = std::move(arms);
  }
  ++count_;
}

void ShotFolder::clear() {
  for (std::size_t i = count_; i > 0; --i) {
    fs::remove(right(i - 1));
    fs::remove(left(i - 1));
  }
  fs::remove(table());
  count_ = 0;
  arms_.clear();
}

void ShotFolder::writeTable(const std::vector<ArmRow>& arms) const {
  std::string text = "time_s";
  for (const char* name : kColumns) {
    text += std::string(",") + name;
  }
  text += "\n";
  for (std::size_t i = 0; i < arms.size(); ++i) {
    text += std::to_string(i);
    for (const double angle : arms[i].joints) {
      text += "," + exactText(angle);
    }
    const Eigen::Quaterniond q(arms[i].fMe.linear());
    for (const double value : {arms[i].fMe.translation().x(), arms[i].fMe.translation().y(),
                               arms[i].fMe.translation().z(), q.x(), q.y(), q.z(), q.w()}) {
      text += "," + exactText(value);
    }
    text += "\n";
  }
  writeFileAtomically(table(), text);
}

}  // namespace ringhook
