#include "tracking/mesh_model.h"
#include "core/angle.h"

#include <gmock/gmock.h>

#include <fstream>
#include <set>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "mesh_shapes.h"
#include "tests/unit/tracking/painted_hook.h"
#include "tracking/edge_model.h"
#include "tracking/edge_tracker.h"

namespace ringhook {
namespace {

using test::prism;
using ::testing::AllOf;
using ::testing::HasSubstr;

MeshModel modelOf(const std::string& obj, double chord_tolerance_m = 0.0) {
  MeshModelOptions options;
  options.chord_tolerance_m = chord_tolerance_m;
  return modelFromMesh(parseObj(obj, "part.obj"), options, "part.obj");
}

Eigen::Vector3d normalOf(const MeshModel& model, const std::vector<int>& face) {
  Mesh mesh;
  mesh.points = model.points;
  return areaVector(mesh, {face, 0}).normalized();
}

/// Distance of a point from the nearest edge.
double distanceFrom(const EdgeModel& model, const Eigen::Vector3d& p) {
  double nearest = 1e9;
  for (const auto& edge : model.edges) {
    const Eigen::Vector3d& a = model.points[static_cast<std::size_t>(edge[0])];
    const Eigen::Vector3d d = model.points[static_cast<std::size_t>(edge[1])] - a;
    const double s = std::clamp((p - a).dot(d) / d.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (p - a - s * d).norm());
  }
  return nearest;
}

TEST(MeshModel, ACubeHasTwelveLinesHoweverItIsMeshed) {
  const std::string quads = prism(test::square(0.1), 0.1, false);
  const std::string triangles = prism(test::square(0.1), 0.1, true, 0);
  for (const std::string& obj : {quads, triangles}) {
    const MeshModel model = modelOf(obj);
    EXPECT_EQ(model.lines, 12);
    EXPECT_EQ(model.flat_faces, 6);
    EXPECT_EQ(model.hole_faces + model.thread_faces + model.left_out, 0);
    EXPECT_EQ(model.points.size(), 8U);
    EXPECT_EQ(parseEdgeModel(caoText(model, "cube"), "cube.cao").edges.size(), 12U);
    for (const auto& face : model.faces) {
      Eigen::Vector3d centre = Eigen::Vector3d::Zero();
      for (const int point : face) {
        centre += model.points[static_cast<std::size_t>(point)] / 4.0;
      }
      EXPECT_GT(normalOf(model, face).dot(centre - Eigen::Vector3d::Constant(0.05)), 0.04);
    }
  }
}

TEST(MeshModel, AnLKeepsItsConcaveFaces) {
  const MeshModel model = modelOf(prism(test::ell(0.05), 0.02, true, 0));
  EXPECT_EQ(model.lines, 18);
  EXPECT_EQ(model.flat_faces, 8);
  EXPECT_EQ(model.points.size(), 12U);
}

TEST(MeshModel, CollinearEdgesBecomeOneLine) {
  // A cube whose lower edges have a point in the middle.
  test::Outline outline;
  const test::Outline corners = test::square(0.1);
  for (std::size_t i = 0; i < 4; ++i) {
    outline.push_back(corners[i]);
    outline.push_back(0.5 * (corners[i] + corners[(i + 1) % 4]));
  }
  const MeshModel model = modelOf(prism(outline, 0.1, true, 1));
  EXPECT_EQ(model.lines, 12);
  EXPECT_EQ(model.points.size(), 8U);
}

TEST(MeshModel, ACylindersSideHasNoLinesButItsRims) {
  constexpr double kRadius = 0.04;
  const MeshModel fine = modelOf(prism(test::circle(kRadius, 64), 0.1, true, 0));
  EXPECT_EQ(fine.lines, 128);
  EXPECT_EQ(fine.flat_faces, 2);
  EXPECT_EQ(fine.thread_faces, 128);
  for (const auto& face : fine.faces) {
    const Eigen::Vector3d normal = normalOf(fine, face);
    if (face.size() == 3) {  // a thread looks as the side does there: away from the axis
      const Eigen::Vector3d p = fine.points[static_cast<std::size_t>(face[0])];
      EXPECT_NEAR(normal.z(), 0.0, 1e-3);
      EXPECT_GT(normal.head<2>().dot(p.head<2>().normalized()), 0.99);
    } else {
      EXPECT_NEAR(std::abs(normal.z()), 1.0, 1e-9);
    }
  }
}

TEST(MeshModel, ArcsAreThinnedWithinTheTolerance) {
  constexpr double kRadius = 0.04;
  constexpr double kTolerance = 0.0002;
  const MeshModel model = modelOf(prism(test::circle(kRadius, 128), 0.1, true, 0), kTolerance);
  // A chord of k of 128 steps is off by r (1 - cos(pi k / 128)): 4 steps 0.193 mm, 8 steps 0.77 mm.
  EXPECT_EQ(model.lines, 2 * 32);
  const EdgeModel edges = parseEdgeModel(caoText(model, "cylinder"), "cylinder.cao");
  for (const Eigen::Vector2d& p : test::circle(kRadius, 128)) {
    EXPECT_LE(distanceFrom(edges, {p.x(), p.y(), 0.1}), kTolerance);
  }
}

TEST(MeshModel, AHoleIsSeenWithTheFaceAroundIt) {
  // A plate of 0.1 x 0.1 x 0.02 with a square hole: top and bottom as rings of four quads.
  std::string obj;
  for (const double z : {0.0, 0.02}) {
    for (const auto& [low, high] : {std::pair{0.0, 0.1}, {0.03, 0.07}}) {
      obj += test::pointLine(low, low, z) + test::pointLine(high, low, z) +
             test::pointLine(high, high, z) + test::pointLine(low, high, z);
    }
  }
  const auto quad = [&](int a, int b, int c, int d) {
    obj += "f " + std::to_string(a) + " " + std::to_string(b) + " " + std::to_string(c) + " " +
           std::to_string(d) + "\n";
  };
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    quad(1 + j, 1 + i, 5 + i, 5 + j);    // bottom
    quad(9 + i, 9 + j, 13 + j, 13 + i);  // top
    quad(1 + i, 1 + j, 9 + j, 9 + i);    // outer walls
    quad(5 + j, 5 + i, 13 + i, 13 + j);  // walls of the hole
  }
  const MeshModel model = modelOf(obj);
  EXPECT_EQ(model.lines, 24);
  EXPECT_EQ(model.flat_faces, 10);
  EXPECT_EQ(model.hole_faces, 2);
  EXPECT_EQ(model.repair.turned_faces, 0);
  int up = 0;
  for (const auto& face : model.faces) {
    up += normalOf(model, face).z() > 0.9 ? 1 : 0;
  }
  EXPECT_EQ(up, 2);  // the top and its hole
}

TEST(MeshModel, CubesThatShareAnEdgeShareItsLine) {
  std::string obj = prism(test::square(0.1), 0.1, false);
  std::string other = prism({{0.1, 0.1}, {0.2, 0.1}, {0.2, 0.2}, {0.1, 0.2}}, 0.1, false, -1, 9);
  const MeshModel model = modelOf(obj + other);
  EXPECT_EQ(model.lines, 23);
  EXPECT_EQ(model.repair.crowded_edges, 1);
  EXPECT_EQ(model.flat_faces, 12);
}

TEST(MeshModel, TheFeatureAngleDecides) {
  const std::string hexagon = prism(test::circle(0.05, 6), 0.1, false);  // sides meet at 60 degrees
  MeshModelOptions options;
  const auto lines = [&](double degrees) {
    options.feature_angle = degrees * kDegree;
    return modelFromMesh(parseObj(hexagon, "hexagon.obj"), options, "hexagon.obj").lines;
  };
  EXPECT_EQ(lines(30), 18);
  EXPECT_EQ(lines(60), 18);
  EXPECT_EQ(lines(61), 12);
}

std::string refusalOf(const std::string& obj, double scale) {
  MeshModelOptions options;
  options.scale = scale;
  try {
    static_cast<void>(modelFromMesh(parseObj(obj, "hook.obj"), options, "hook.obj"));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(MeshModel, RefusesTheWrongUnitWithAdvice) {
  const std::string in_millimetres = prism(test::square(100), 450, false);
  EXPECT_THAT(refusalOf(in_millimetres, 1.0),
              AllOf(HasSubstr("hook.obj"), HasSubstr("450 m large"), HasSubstr("--scale 0.001")));
  EXPECT_THAT(refusalOf(in_millimetres, 1e-6), HasSubstr("0.45 mm large"));
  EXPECT_EQ(refusalOf(in_millimetres, 0.001), "accepted");
}

TEST(MeshModel, APointOfNoFaceMayLieAnywhere) {
  MeshModelOptions options;
  options.scale = 1e6;
  options.weld_m = 1e-9;
  const std::string cube = prism(test::square(1e-7), 1e-7, false);
  const std::string obj = cube + "v 1e9 -1e9 1e9\n";
  EXPECT_EQ(modelFromMesh(parseObj(obj, "part.obj"), options, "part.obj").lines, 12);
}

TEST(MeshModel, RefusesASolidWithoutEdges) {
  // A ball of 24 x 12 facets: neighbours meet at 15 degrees or less.
  std::string ball = test::pointLine(0, 0, 0.1) + test::pointLine(0, 0, -0.1);
  constexpr int kAround = 24;
  constexpr int kDown = 12;
  for (int j = 1; j < kDown; ++j) {
    const double polar = std::numbers::pi * j / kDown;
    for (const Eigen::Vector2d& p : test::circle(0.1 * std::sin(polar), kAround)) {
      ball += test::pointLine(p.x(), p.y(), 0.1 * std::cos(polar));
    }
  }
  const auto at = [](int j, int i) { return std::to_string(3 + (j - 1) * kAround + i % kAround); };
  for (int i = 0; i < kAround; ++i) {
    ball += "f 1 " + at(1, i) + " " + at(1, i + 1) + "\n";
    ball += "f 2 " + at(kDown - 1, i + 1) + " " + at(kDown - 1, i) + "\n";
    for (int j = 1; j + 1 < kDown; ++j) {
      ball +=
          "f " + at(j, i) + " " + at(j + 1, i) + " " + at(j + 1, i + 1) + " " + at(j, i + 1) + "\n";
    }
  }
  EXPECT_THAT(refusalOf(ball, 1.0), HasSubstr("no edge is sharper"));
}

// The hook's own model was made from the same numbers in another way.
TEST(MeshModel, TheHooksSolidGivesTheEdgesOfItsModel) {
  const auto folder = std::filesystem::path(RINGHOOK_SOURCE_DIR) / "datasets/models/hook";
  const MeshModel model = modelFromMesh(loadObj(folder / "hook.obj"), {}, "hook.obj");
  EXPECT_EQ(model.repair.turned_faces, 0);
  EXPECT_EQ(model.repair.open_edges, 0);
  EXPECT_EQ(model.left_out, 0);
  const EdgeModel converted = parseEdgeModel(caoText(model, "hook"), "converted.cao");
  const EdgeModel own = loadEdgeModel(folder / "hook.cao");
  double worst = 0.0;
  for (const EdgeSample& sample : sampleEdges(own, 0.0005)) {
    worst = std::max(worst, distanceFrom(converted, sample.point_o));
  }
  // 16 chords in hook.cao stand off the arc by up to 0.14 mm, the tolerance is 0.1 mm.
  EXPECT_LT(worst, 0.00025);
  // The other way: front edges of the bar below the plate and the plate's face.
  for (const EdgeSample& sample : sampleEdges(converted, 0.0005)) {
    const Eigen::Vector3d& p = sample.point_o;
    const bool front = std::abs(p.x() - 0.003) < 2e-6 && p.z() < 0.146;
    if (front && std::abs(sample.tangent_o.x()) < 0.1) {
      ASSERT_LT(distanceFrom(own, p), 0.00025) << p.transpose();
    }
  }
}

/// Sides of the L's outline on which `view` has features, by their numbers; a feature elsewhere
/// fails the test. \param z height of the face that is seen [m].
std::set<std::size_t> sidesSeen(const HookView& view, const test::Outline& outline, double z) {
  std::set<std::size_t> seen;
  for (const EdgeFeature& feature : view.cameras.front().edges) {
    const Eigen::Vector3d middle = 0.5 * (feature.start_o + feature.end_o);
    EXPECT_NEAR(middle.z(), z, 1e-6);
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d side = 0.5 * (outline[i] + outline[(i + 1) % outline.size()]);
      if ((side - middle.head<2>()).norm() < 1e-6) {
        seen.insert(i);
      }
    }
  }
  return seen;
}

// ViSP decides by the face's direction what is visible; the L's first corner is its inward one.
TEST(MeshModel, VispSeesTheConcaveFaceThatIsTurnedToIt) {
  const ScratchFolder folder;
  const test::Outline outline = test::ell(0.04);
  const auto file =
      folder.write("ell.cao", caoText(modelOf(prism(outline, 0.01, true, 0)), "ell.obj"));
  for (const bool from_above : {true, false}) {
    RectifiedFrame frame = test::emptyPair(90);
    frame.views.resize(1);  // the right camera would see the L's sides, too
    Pose c1Mo = Pose::Identity();
    if (from_above) {  // z of the solid towards the camera
      c1Mo.linear() << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    }
    c1Mo.translation() = Eigen::Vector3d(-0.04, from_above ? 0.04 : -0.04, 1.2);
    Pose oMface = Pose::Identity();
    oMface.translation().z() = from_above ? 0.01 : 0.0;
    test::paint(frame.views[0], c1Mo * oMface, {0.1, 0.1}, test::polygon(outline, 200));
    EdgeTracker tracker(file);
    Pose start = c1Mo;
    start.translation() += Eigen::Vector3d(0.001, -0.001, 0.002);
    const auto view = tracker.track(frame, start);
    ASSERT_TRUE(view) << view.reason();
    EXPECT_EQ(sidesSeen(*view, outline, oMface.translation().z()).size(), 6U);
    EXPECT_LT(tracker.quality().rms_px, 1.0);
  }
}

}  // namespace
}  // namespace ringhook
