// Truth: OpenCV reads and rectifies what was written, ViSP's own parser reads the cameras (through
// loadVispCamera), points in space fall where ROS's matrices say, and files written by hand.

#include "calib/exchange/exchange.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "../../support/scratch_folder.h"
#include "calib/exchange/lens_fit.h"
#include "camera/visp_camera_xml.h"
#include "core/atomic_file.h"
#include "core/error.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Exchange : public testing::Test {
 protected:
  fs::path write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }
  std::vector<fs::path> write(const RigExport& exported) const {
    std::vector<fs::path> files;
    for (const ExportedFile& file : exported.files) {
      files.push_back(write(file.name, file.text));
    }
    return files;
  }
  /// The sentence with which an import is refused.
  static std::string refusal(RigFormat format, const std::vector<fs::path>& files,
                             const ImportHints& hints = {}) {
    try {
      static_cast<void>(importRig(format, files, hints));
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }

 private:
  ScratchFolder folder_;
};

StereoRig someRig() {
  StereoRig rig;
  rig.left.width = 1280;
  rig.left.height = 1024;
  rig.left.K << 1401.25, 0, 645.5, 0, 1399.75, 508.125, 0, 0, 1;
  rig.left.distortion = Eigen::Matrix<double, 5, 1>(-0.21, 0.11, 0.0011, -0.0007, 0.013);
  rig.right = rig.left;
  rig.right->K << 1396.5, 0, 631.25, 0, 1397.125, 517.5, 0, 0, 1;
  rig.right->distortion = Eigen::Matrix<double, 5, 1>(-0.2, 0.093, -0.0004, 0.0009, 0.00001);
  rig.c2Mc1 = makePoseThetaU({-0.249, 0.0031, 0.021}, {0.011, -0.17, 0.004});
  return rig;
}

void expectSame(const CameraModel& a, const CameraModel& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.K, b.K);
  EXPECT_EQ(a.distortion, b.distortion);
}

void expectSameRig(const StereoRig& a, const StereoRig& b, double tolerance) {
  expectSame(a.left, b.left);
  expectSame(*a.right, *b.right);
  EXPECT_LT((a.c2Mc1.matrix() - b.c2Mc1.matrix()).norm(), tolerance);
}

StereoRig withTerms(StereoRig rig, const Eigen::VectorXd& terms) {
  rig.left.distortion = terms;
  rig.right->distortion = 0.9 * terms;
  return rig;
}

TEST_F(Exchange, BringsARigBackFromEveryFormat) {
  const StereoRig rig = someRig();
  for (const RigFormat format : {RigFormat::kOpenCv, RigFormat::kRos}) {
    expectSameRig(rig, importRig(format, write(exportRig(format, rig)), {}), 1e-12);
  }
  const StereoRig radtan = withTerms(rig, rig.left.distortion.head(4));
  expectSameRig(radtan,
                importRig(RigFormat::kKalibr, write(exportRig(RigFormat::kKalibr, radtan)), {}),
                1e-12);
  const StereoRig radial = withTerms(rig, Eigen::Vector4d(-0.2, 0, 0, 0));
  expectSameRig(radial, importRig(RigFormat::kVisp, write(exportRig(RigFormat::kVisp, radial)), {}),
                1e-12);
}

TEST_F(Exchange, BringsARationalLensBackThroughOpenCvAndRos) {
  Eigen::VectorXd terms(8);
  terms << 0.3, -0.2, 1e-4, 1e-5, 0.01, 0.5, -0.1, 0.02;
  const StereoRig rig = withTerms(someRig(), terms);
  for (const RigFormat format : {RigFormat::kOpenCv, RigFormat::kRos}) {
    expectSameRig(rig, importRig(format, write(exportRig(format, rig)), {}), 1e-12);
  }
}

cv::Mat matrixIn(const fs::path& file, const std::string& key) {
  cv::Mat m;
  cv::FileStorage(file.string(), cv::FileStorage::READ)[key] >> m;
  return m;
}

TEST_F(Exchange, WritesWhatOpenCvReadsAndRectifiesAlike) {
  const auto files = write(exportRig(RigFormat::kOpenCv, someRig()));
  const cv::Mat M1 = matrixIn(files[0], "M1"), D1 = matrixIn(files[0], "D1");
  const cv::Mat M2 = matrixIn(files[0], "M2"), D2 = matrixIn(files[0], "D2");
  const cv::Mat R = matrixIn(files[1], "R"), T = matrixIn(files[1], "T");
  cv::Mat R1, R2, P1, P2, Q;
  cv::stereoRectify(M1, D1, M2, D2, cv::Size(1280, 1024), R, T, R1, R2, P1, P2, Q,
                    cv::CALIB_ZERO_DISPARITY, -1.0);
  EXPECT_LT(cv::norm(R1, matrixIn(files[1], "R1"), cv::NORM_INF), 1e-9);
  EXPECT_LT(cv::norm(R2, matrixIn(files[1], "R2"), cv::NORM_INF), 1e-9);
  // The same baseline at each one's focal length.
  const cv::Mat ours = matrixIn(files[1], "P2");
  EXPECT_NEAR(ours.at<double>(0, 3) / ours.at<double>(0, 0),
              P2.at<double>(0, 3) / P2.at<double>(0, 0), 1e-12);
}

TEST_F(Exchange, WritesRosMatricesThatRectifyPointsInSpace) {
  const StereoRig rig = someRig();
  const Rectification r = rectification(rig);
  const auto pixels = [](const CameraModel& camera, const Eigen::Vector3d& point_c,
                         const Eigen::Matrix3d& R, const Eigen::Matrix<double, 3, 4>& P) {
    const Eigen::Vector2d raw = projectNormalised(camera, point_c.hnormalized());
    const auto toCv = [](const Eigen::MatrixXd& m) {
      cv::Mat out(static_cast<int>(m.rows()), static_cast<int>(m.cols()), CV_64F);
      for (int i = 0; i < out.rows; ++i) {
        for (int j = 0; j < out.cols; ++j) {
          out.at<double>(i, j) = m(i, j);
        }
      }
      return out;
    };
    std::vector<cv::Point2d> in{{raw.x(), raw.y()}}, out;
    cv::undistortPoints(
        in, out, toCv(camera.K), toCv(camera.distortion.transpose()), toCv(R),
        toCv(P.leftCols<3>()),
        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 200, 1e-14));
    return Eigen::Vector2d(out[0].x, out[0].y);
  };
  for (const Eigen::Vector3d& point : {Eigen::Vector3d(0.1, 0.05, 1.1), {-0.1, -0.2, 0.9}}) {
    const Eigen::Vector2d a = pixels(rig.left, point, r.R1, r.P1);
    const Eigen::Vector2d b = pixels(*rig.right, rig.c2Mc1 * point, r.R2, r.P2);
    EXPECT_NEAR(a.y(), b.y(), 1e-6);
    const double depth = (r.R1 * point).z();
    EXPECT_NEAR(a.x() - b.x(), r.P1(0, 0) * baseline(rig) / depth, 1e-5);
    EXPECT_NEAR(a.x(), (r.P1.leftCols<3>() * r.R1 * point).hnormalized().x(), 1e-5);
  }
}

TEST_F(Exchange, KeepsTheMiddleOfBothViewsInTheMiddleOfRosImages) {
  const StereoRig rig = someRig();
  const Rectification r = rectification(rig);
  const auto left = undistortPixel(rig.left, {639.5, 511.5});
  const auto right = undistortPixel(*rig.right, {639.5, 511.5});
  const Eigen::Vector2d middle =
      0.5 * ((r.P1.leftCols<3>() * r.R1 * left->homogeneous()).hnormalized() +
             (r.P2.leftCols<3>() * r.R2 * right->homogeneous()).hnormalized());
  EXPECT_NEAR(middle.x(), 639.5, 60.0);
  EXPECT_NEAR(middle.y(), 511.5, 60.0);
  EXPECT_EQ(r.P1.leftCols<3>(), r.P2.leftCols<3>());
}

TEST_F(Exchange, WritesCamerasThatViSPsParserReads) {
  const StereoRig rig = withTerms(someRig(), Eigen::Vector4d(-0.2, 0, 0, 0));
  const auto files = write(exportRig(RigFormat::kVisp, rig));
  const StereoRig right = loadVispCamera(files[1], "right", {});
  expectSame(right.left, *rig.right);
}

TEST_F(Exchange, TellsWhatAFormatCannotHold) {
  const RigExport exact = exportRig(RigFormat::kOpenCv, someRig());
  EXPECT_EQ(exact.loss_px, 0.0);
  EXPECT_TRUE(exact.notes.empty());
  const RigExport visp = exportRig(RigFormat::kVisp, someRig());
  EXPECT_GT(visp.loss_px, 0.1);
  EXPECT_THAT(visp.notes.at(0), HasSubstr("fewer lens terms"));
  StereoRig placed = someRig();
  placed.fMc1 = Pose::Identity();
  EXPECT_THAT(exportRig(RigFormat::kRos, placed).notes.at(0), HasSubstr("fMc1"));
}

TEST_F(Exchange, StatesTheLossThatPixelsReallyHave) {
  const CameraModel full = someRig().left;
  const FittedLens fitted = closestLens(full, LensKind::kRadTan);
  double worst = 0.0;
  for (double u = 0.0; u <= 1279.0; u += 1279.0 / 60) {
    for (double v = 0.0; v <= 1023.0; v += 1023.0 / 60) {
      const auto ray = undistortPixel(full, {u, v});
      ASSERT_TRUE(ray);
      worst =
          std::max(worst, (projectNormalised(fitted.camera, *ray) - Eigen::Vector2d(u, v)).norm());
    }
  }
  EXPECT_NEAR(fitted.loss_px, worst, 0.05 * worst);
  // A lens that nearly folds in the corners, where the loss rises steeply.
  CameraModel steep = full;
  steep.K.topLeftCorner<2, 2>() *= 0.75;
  steep.distortion << -0.3, 0.172, 0.0013, 0.0, -0.14;
  const FittedLens rough = closestLens(steep, LensKind::kRadTan);
  double most = 0.0;
  for (double u = 0.0; u <= 1279.0; u += 4.0) {
    for (double v = 0.0; v <= 1023.0; v += 4.0) {
      const auto ray = undistortPixel(steep, {u, v});
      if (ray) {
        most =
            std::max(most, (projectNormalised(rough.camera, *ray) - Eigen::Vector2d(u, v)).norm());
      }
    }
  }
  EXPECT_NEAR(rough.loss_px, most, 0.15 * most);
  // The least-squares lens is better than the same terms cut off.
  CameraModel cut = full;
  cut.distortion = full.distortion.head(4);
  const auto corner = undistortPixel(full, {0.0, 0.0});
  EXPECT_LT(fitted.loss_px, (projectNormalised(cut, *corner) - Eigen::Vector2d(0, 0)).norm());
}

TEST_F(Exchange, StatesTheErrorOfViSPsWayBack) {
  CameraModel camera = someRig().left;
  camera.distortion = Eigen::Vector4d(-0.2, 0, 0, 0);
  const InverseRadial back = inverseRadial(camera);
  EXPECT_NEAR(back.kdu, 0.2, 0.05);  // to first order the sign turns
  EXPECT_GT(back.loss_px, 0.05);
  camera.distortion = Eigen::Vector4d(-0.002, 0, 0, 0);
  EXPECT_LT(inverseRadial(camera).loss_px, 1e-3);
}

constexpr auto kCamchain = R"(cam0:
  cam_overlaps: [1]
  camera_model: pinhole
  distortion_coeffs: [-0.28, 0.07, 0.0002, 1.8e-05]
  distortion_model: radtan
  intrinsics: [458.6, 457.3, 367.2, 248.4]
  resolution: [752, 480]
  rostopic: /left/image_raw
cam1:
  T_cn_cnm1:
  - [1.0, 0.0, 0.0, -0.11]
  - [0.0, 0.8, -0.6, 0.002]
  - [0.0, 0.6, 0.8, -0.003]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [-0.27, 0.06, 0.0001, 2.0e-05]
  distortion_model: radtan
  intrinsics: [457.5, 456.1, 379.9, 255.2]
  resolution: [752, 480]
  rostopic: /right/image_raw
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  text.replace(text.find(what), what.size(), with);
  return text;
}

TEST_F(Exchange, ReadsAKalibrChainAsItsDocumentationHasIt) {
  const StereoRig rig = importRig(RigFormat::kKalibr, {write("chain.yaml", kCamchain)}, {});
  EXPECT_EQ(rig.left.width, 752);
  EXPECT_EQ(rig.left.K(1, 2), 248.4);
  EXPECT_EQ(rig.left.distortion[3], 1.8e-5);
  EXPECT_EQ(rig.right->K(0, 0), 457.5);
  EXPECT_NEAR(rig.c2Mc1.translation().x(), -0.11, 1e-15);
  EXPECT_NEAR(rig.c2Mc1.linear()(1, 2), -0.6, 1e-12);
}

TEST_F(Exchange, NamesFileAndKeyOfABadKalibrChain) {
  const auto says = [&](const std::string& what, const std::string& with) {
    return refusal(RigFormat::kKalibr, {write("chain.yaml", replaced(kCamchain, what, with))});
  };
  EXPECT_THAT(says("radtan", "equidistant"),
              testing::AllOf(HasSubstr("chain.yaml"), HasSubstr("cam0.distortion_model"),
                             HasSubstr("equidistant")));
  EXPECT_THAT(says("[1.0, 0.0, 0.0, -0.11]", "[1.0, 0.0, -0.11]"), HasSubstr("cam1.T_cn_cnm1"));
  EXPECT_THAT(says("T_cn_cnm1", "T_cam_imu"), HasSubstr("T_cn_cnm1"));
  EXPECT_THAT(says("[458.6, 457.3, 367.2, 248.4]", "[458.6]"), HasSubstr("cam0.intrinsics"));
  EXPECT_THAT(says("-0.11", "-110.0"), HasSubstr("--unit mm"));
  EXPECT_THAT(says("0.8, -0.6", "0.8, 0.6"), HasSubstr("R must be a rotation"));
  EXPECT_THAT(refusal(RigFormat::kKalibr, {write("a.yaml", "")}), HasSubstr("a.yaml"));
  EXPECT_THAT(refusal(RigFormat::kKalibr, {"/nowhere.yaml"}), HasSubstr("/nowhere.yaml"));
}

TEST_F(Exchange, TakesMillimetresWhereTheyAreStated) {
  const auto file = write("chain.yaml", replaced(kCamchain, "-0.11", "-110.0"));
  ImportHints hints;
  hints.unit_m = 1e-3;
  EXPECT_NEAR(importRig(RigFormat::kKalibr, {file}, hints).c2Mc1.translation().x(), -0.11, 1e-12);
}

constexpr auto kSampleIntrinsics = R"(%YAML:1.0
---
M1: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 534., 0., 341., 0., 534., 234., 0., 0., 1. ]
D1: !!opencv-matrix
   rows: 1
   cols: 14
   dt: d
   data: [ -0.28, 0.1, 0., 0., 0., 0., 0., 0.2, 0., 0., 0., 0., 0., 0. ]
)";

TEST_F(Exchange, AsksForTheSizeThatTheSampleOfOpenCvDoesNotWrite) {
  const auto file = write("intrinsics.yml", kSampleIntrinsics);
  EXPECT_THAT(refusal(RigFormat::kOpenCv, {file}), HasSubstr("--size"));
  const StereoRig rig = importRig(RigFormat::kOpenCv, {file}, {640, 480, {}});
  EXPECT_EQ(rig.left.width, 640);
  EXPECT_EQ(rig.left.distortion.size(), 8);
  EXPECT_EQ(rig.left.distortion[7], 0.2);
}

TEST_F(Exchange, ReadsOpenCvsXmlAsWell) {
  const StereoRig rig = someRig();
  const fs::path file = write("rig.xml", "");
  {
    cv::FileStorage out(file.string(), cv::FileStorage::WRITE);
    const auto put = [&](const char* key, const Eigen::MatrixXd& m) {
      cv::Mat mat(static_cast<int>(m.rows()), static_cast<int>(m.cols()), CV_64F);
      for (int i = 0; i < mat.rows; ++i) {
        for (int j = 0; j < mat.cols; ++j) {
          mat.at<double>(i, j) = m(i, j);
        }
      }
      out << key << mat;
    };
    put("M1", rig.left.K);
    put("D1", rig.left.distortion);
    put("M2", rig.right->K);
    put("D2", rig.right->distortion);
    put("R", rig.c2Mc1.linear());
    put("T", rig.c2Mc1.translation());
  }
  expectSameRig(rig, importRig(RigFormat::kOpenCv, {file}, {1280, 1024, {}}), 1e-12);
}

TEST_F(Exchange, NamesFileAndKeyOfBadOpenCvFiles) {
  const auto says = [&](const std::string& what, const std::string& with) {
    return refusal(RigFormat::kOpenCv, {write("in.yml", replaced(kSampleIntrinsics, what, with))},
                   {640, 480, {}});
  };
  EXPECT_THAT(says("M1", "M9"),
              testing::AllOf(HasSubstr("in.yml"), HasSubstr("key M1 is missing")));
  EXPECT_THAT(says("0.2, 0., 0.", "0.2, 0.1, 0."), HasSubstr("key D1"));
  EXPECT_THAT(says("534., 0., 341.", "534., 0.5, 341."), HasSubstr("K1"));
  EXPECT_THAT(says("%YAML:1.0", "hello"), HasSubstr("not an OpenCV file"));
}

TEST_F(Exchange, NamesFileAndKeyOfBadRosFiles) {
  const auto files = write(exportRig(RigFormat::kRos, someRig()));
  std::ifstream stream(files[1]);
  const std::string right{std::istreambuf_iterator<char>(stream), {}};
  const auto says = [&](const std::string& what, const std::string& with) {
    return refusal(RigFormat::kRos, {files[0], write("right.yaml", replaced(right, what, with))});
  };
  EXPECT_THAT(says("plumb_bob", "equidistant"),
              testing::AllOf(HasSubstr("right.yaml"), HasSubstr("distortion_model")));
  EXPECT_THAT(says("projection_matrix", "projektion"), HasSubstr("projection_matrix"));
  EXPECT_THAT(says("rows: 3", "rows: 2"), HasSubstr("camera_matrix.rows"));
  EXPECT_THAT(refusal(RigFormat::kRos, {files[0], files[0]}), HasSubstr("baseline"));
}

TEST_F(Exchange, NamesFilesOfABadViSPSet) {
  const auto files = write(exportRig(RigFormat::kVisp, someRig()));
  EXPECT_THAT(refusal(RigFormat::kVisp, {files[0], files[1]}), HasSubstr("c2Mc1.txt"));
  EXPECT_THAT(refusal(RigFormat::kVisp, {files[0], files[1], write("m.txt", "1 0 0 x")}),
              HasSubstr("number 4"));
}

TEST_F(Exchange, RefusesAFormatItDoesNotKnow) {
  EXPECT_THROW(static_cast<void>(rigFormat("matlab")), InputError);
}

}  // namespace
}  // namespace ringhook
