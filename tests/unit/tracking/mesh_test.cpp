#include "tracking/mesh.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "mesh_shapes.h"
#include "tracking/mesh_repair.h"

namespace ringhook {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string refusalOf(const std::string& text) {
  try {
    static_cast<void>(parseObj(text, "part.obj"));
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

constexpr auto kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, ReadsEverySpellingOfACorner) {
  for (const auto* face : {"f 1 2 3", "f 1/5 2/6 3/7", "f 1//9 2//9 3//9", "f 1/1/1 2/2/2 3/3/3",
                           "f -3 -2 -1", "f 1 \\\n 2 3", "f 1 2 3 # remark", "f 1 2 3\r"}) {
    const Mesh mesh = parseObj(std::string(kThree) + face + "\n", "part.obj");
    ASSERT_EQ(mesh.faces.size(), 1U) << face;
    EXPECT_THAT(mesh.faces[0].corners, ElementsAre(0, 1, 2)) << face;
    EXPECT_EQ(mesh.faces[0].line, 4) << face;
  }
}

TEST(Obj, ReadsOverWhatATrackerDoesNotNeed) {
  const Mesh mesh = parseObj(std::string("mtllib a.mtl\no part\ng side\nusemtl steel\ns off\n"
                                         "vn 0 0 1\nvt 0 0\nl 1 2\n\n") +
                                 kThree + "v 5 5 5 1.0\nv 1 1 0 0.5 0.5 0.5\nf 1 2 5 3\n",
                             "part.obj");
  EXPECT_EQ(mesh.points.size(), 5U);
  EXPECT_EQ(extents(mesh), Eigen::Vector3d(1, 1, 0));  // of the faces: the stray point is none
}

TEST(Obj, RefusalsNameFileAndLine) {
  const std::string three = kThree;
  EXPECT_THAT(refusalOf(three + "f 1 2\n"), AllOf(HasSubstr("part.obj:4"), HasSubstr("three")));
  EXPECT_THAT(refusalOf(three + "f 1 2 4\n"), AllOf(HasSubstr(":4"), HasSubstr("point 4")));
  EXPECT_THAT(refusalOf(three + "f 1 2 0\n"), HasSubstr("point 0"));
  EXPECT_THAT(refusalOf(three + "f 1 2 -4\n"), HasSubstr("point -4"));
  EXPECT_THAT(refusalOf(three + "f 1 2 x\n"), HasSubstr("'x'"));
  EXPECT_THAT(refusalOf("v 1 2\n"), HasSubstr("part.obj:1: three coordinates"));
  EXPECT_THAT(refusalOf("v 1 2 nan\n"), HasSubstr("'nan'"));
  EXPECT_THAT(refusalOf("v 1 2 1e300\n"), HasSubstr("1e300"));
  EXPECT_THAT(refusalOf("solid part\n facet normal 0 0 1\n"), HasSubstr("'solid'"));
  EXPECT_THAT(refusalOf(three + "cstype bezier\n"), HasSubstr("free-form"));
  EXPECT_THAT(refusalOf(""), HasSubstr("no face"));
  EXPECT_THAT(refusalOf(three), HasSubstr("no face"));
}

TEST(Obj, AFolderAndAMissingFileAreNamed) {
  EXPECT_THROW((void)loadObj("/tmp"), InputError);
  EXPECT_THROW((void)loadObj("/nowhere/part.obj"), InputError);
}

TEST(AreaVector, HoldsForAConcavePolygon) {
  Mesh mesh = parseObj(test::prism(test::ell(1.0), 2.0, false), "part.obj");
  double top = 0.0;
  for (const MeshFace& face : mesh.faces) {
    top = std::max(top, 0.5 * areaVector(mesh, face).z());
  }
  EXPECT_DOUBLE_EQ(top, 3.0);  // three unit squares
}

double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const MeshFace& face : mesh.faces) {
    const auto& p = mesh.points[static_cast<std::size_t>(face.corners[0])];
    sum += areaVector(mesh, face).dot(p) / 6.0;
  }
  return sum;
}

TEST(MeshRepair, TurnsEveryFaceOutward) {
  const std::string obj = test::prism(test::ell(1.0), 2.0, true, 0);
  for (const unsigned pattern : {0U, 1U, 0x55555U, 0xfffffU, 0x12345U}) {
    Mesh mesh = parseObj(obj, "part.obj");
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
      if ((pattern >> i & 1U) != 0U) {
        std::reverse(mesh.faces[i].corners.begin(), mesh.faces[i].corners.end());
      }
    }
    const RepairReport report = repairMesh(mesh, 1e-6, "part.obj");
    EXPECT_NEAR(volume(mesh), 6.0, 1e-12) << pattern;
    EXPECT_EQ(report.turned_faces, __builtin_popcount(pattern & 0xfffffU)) << pattern;
    EXPECT_EQ(report.open_edges, 0);
  }
}

TEST(MeshRepair, JoinsPointsThatAreOne) {
  // Every face with points of its own, as many exporters write them, off by a little.
  Mesh mesh = parseObj(test::prism(test::square(1.0), 1.0, false), "part.obj");
  Mesh loose;
  for (const MeshFace& face : mesh.faces) {
    MeshFace own;
    for (const int corner : face.corners) {
      own.corners.push_back(static_cast<int>(loose.points.size()));
      loose.points.push_back(mesh.points[static_cast<std::size_t>(corner)] +
                             Eigen::Vector3d::Constant(2e-7 * (loose.points.size() % 3)));
    }
    loose.faces.push_back(own);
  }
  const RepairReport report = repairMesh(loose, 1e-6, "part.obj");
  EXPECT_EQ(report.welded_points, 24 - 8);
  EXPECT_EQ(report.open_edges, 0);
  EXPECT_EQ(edgesOf(loose).size(), 12U);
}

TEST(MeshRepair, AFaceWithoutAreaLeavesNoGap) {
  // The top's long side is bridged to its neighbour's two sides by a triangle without area.
  std::string obj = test::prism(test::square(1.0), 1.0, false);
  const auto at = obj.find("f 1 2 6 5\n");
  ASSERT_NE(at, std::string::npos);
  obj.replace(at, 10, "v 0.5 0 1\nf 1 2 6 9 5\nf 5 9 6\n");
  Mesh mesh = parseObj(obj, "part.obj");
  const RepairReport report = repairMesh(mesh, 1e-6, "part.obj");
  EXPECT_EQ(report.dropped_faces, 1);
  EXPECT_EQ(report.divided_sides, 1);
  EXPECT_EQ(report.open_edges, 0);
  EXPECT_EQ(edgesOf(mesh).size(), 13U);
}

TEST(MeshRepair, CountsOpenAndCrowdedEdges) {
  std::string sheet = std::string(kThree) + "f 1 2 3\n";
  Mesh mesh = parseObj(sheet, "part.obj");
  EXPECT_EQ(repairMesh(mesh, 1e-6, "part.obj").open_edges, 3);
  mesh = parseObj(sheet + "v 0 0 1\nv 0 0 -1\nf 1 4 2\nf 1 2 5\n", "part.obj");
  EXPECT_EQ(repairMesh(mesh, 1e-6, "part.obj").crowded_edges, 1);
}

TEST(MeshRepair, RefusesASurfaceWithOneSide) {
  std::string strip;
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / kSteps;
    for (const double w : {-0.2, 0.2}) {
      const double r = 1.0 + w * std::cos(turn / 2);
      strip += test::pointLine(r * std::cos(turn), r * std::sin(turn), w * std::sin(turn / 2));
    }
  }
  for (int i = 0; i < kSteps; ++i) {
    const bool last = i + 1 == kSteps;
    const int a = 2 * i + 1;
    const int c = last ? 2 : a + 2;
    const int d = last ? 1 : a + 3;
    strip += "f " + std::to_string(a) + " " + std::to_string(c) + " " + std::to_string(d) + " " +
             std::to_string(a + 1) + "\n";
  }
  Mesh mesh = parseObj(strip, "part.obj");
  try {
    static_cast<void>(repairMesh(mesh, 1e-6, "part.obj"));
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("part.obj:"), HasSubstr("one side")));
  }
}

TEST(MeshRepair, RefusesFacesWithoutArea) {
  Mesh mesh = parseObj("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "part.obj");
  EXPECT_THROW((void)repairMesh(mesh, 1e-6, "part.obj"), InputError);
}

}  // namespace
}  // namespace ringhook
