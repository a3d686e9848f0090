#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../../support/scratch_folder.h"
#include "core/error.h"
#include "tests/unit/tracking/painted_hook.h"
#include "tracking/edge_model.h"
#include "tracking/tag_plate.h"

namespace ringhook {
namespace {

using testing::HasSubstr;

/// What loading complains about; empty if it does not.
template <class Load>
std::string complaint(Load&& load) {
  try {
    load();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

std::string plateComplaint(const std::string& text) {
  const ScratchFolder folder;
  const auto path = folder.write("plate.yaml", text);
  return complaint([&] { loadTagPlate(path); });
}

std::string modelComplaint(const std::string& text) {
  return complaint([&] { parseEdgeModel(text, "model.cao"); });
}

TEST(TagPlate, PutsTheHooksTagsOnItsShankWithTheUpperOneFirst) {
  const TagPlate plate = loadTagPlate(test::hookPlatePath());
  ASSERT_EQ(plate.tags.size(), 2U);
  const auto upper = tagCorners(plate, plate.tags[0]);
  // Upper left corner of the upper tag: 20 mm left of the shank, 27 + 20 mm above the centre.
  EXPECT_TRUE(upper[0].isApprox(Eigen::Vector3d(0.005, -0.055, 0.247), 1e-9));
  EXPECT_TRUE(upper[2].isApprox(Eigen::Vector3d(0.005, -0.015, 0.207), 1e-9));
}

TEST(TagPlate, NamesLineAndFieldOfABadFile) {
  EXPECT_THAT(plateComplaint("family: tag99\nlayout: [{id: 0, size: 1}]"),
              HasSubstr("line 1: field family: expected one of tag16h5, tag25h9, tag36h11"));
  EXPECT_THAT(plateComplaint("family: tag36h11\n"), HasSubstr("field layout is missing"));
  EXPECT_THAT(plateComplaint("family: tag36h11\nlayout: []"), HasSubstr("field layout: expected"));
  const std::string head = "family: tag16h5\nlayout:\n  - ";
  const std::pair<const char*, const char*> bad_tags[] = {
      {"{id: 30, size: 0.04}", "line 3: field layout[0].id: expected a whole number from 0 to 29"},
      {"{id: 1, size: -0.04}", "line 3: field layout[0].size: expected a number from 0"},
      {"{id: 1, size: 0}", "line 3: field layout[0].size: expected a positive length"},
      {"{id: 1}", "field layout[0].size is missing"},
      {"{id: 1, size: 0.1, x: far}", "line 3: field layout[0].x: expected a number"},
      {"{id: 1, size: 0.1, qw: 0}", "line 3: field layout[0]: expected a quaternion"},
      {"{id: 1, size: 0.1}\n  - {id: 1, size: 0.1}",
       "line 4: field layout[1].id: expected each id once, got 1 again"},
      {"{id: 1, size: 0.1}\noMK: {x: 1}",
       "line 4: unknown field oMK; expected family, layout, oMk"}};
  for (const auto& [tags, words] : bad_tags) {
    EXPECT_THAT(plateComplaint(head + tags), HasSubstr(words)) << tags;
  }
  EXPECT_THAT(plateComplaint("family: [\n"), HasSubstr("not valid YAML"));
  EXPECT_THAT(plateComplaint(""), HasSubstr("a map"));
  EXPECT_THAT(complaint([] { loadTagPlate("absent.yaml"); }), HasSubstr("absent.yaml"));
}

TEST(EdgeModel, ReadsTheHook) {
  const EdgeModel hook = loadEdgeModel(test::hookModelPath());
  EXPECT_EQ(hook.points.size(), 46U);
  EXPECT_EQ(hook.edges.size(), 43U);
  double length = 0.0;
  for (const auto& edge : hook.edges) {
    length += (hook.points[static_cast<std::size_t>(edge[0])] -
               hook.points[static_cast<std::size_t>(edge[1])])
                  .norm();
  }
  const auto samples = sampleEdges(hook, 0.002);
  EXPECT_GE(static_cast<double>(samples.size()), length / 0.002);
}

constexpr const char* kSquare =
    "V1\n# points\n4\n0 0 0\n1 0 0 # second\n1 1 0\n0 1 0\n1\n0 2 name=diagonal\n0\n1\n4 0 1 2 3 "
    "name=front\n0\n0\n";

TEST(EdgeModel, TakesLinesAndFacesOncePerEdge) {
  EXPECT_EQ(parseEdgeModel(kSquare, "square.cao").edges.size(), 5U);
}

TEST(EdgeModel, NamesTheLineOfABadFile) {
  EXPECT_THAT(modelComplaint("V2\n"), HasSubstr("model.cao:1: 'V1'"));
  EXPECT_THAT(modelComplaint("V1\n2\n0 0 0\n"), HasSubstr("the file ends before a point"));
  EXPECT_THAT(modelComplaint("V1\n1\n0 0 zero\n"), HasSubstr(":3: a number"));
  EXPECT_THAT(modelComplaint("V1\n1\n0 0 0\n1\n0 7\n"), HasSubstr(":5: a number from 0 to 0"));
  EXPECT_THAT(modelComplaint("V1\n1\n0 0 0\n0\n0\n1\n4 0 0\n"), HasSubstr(":7: a face"));
  EXPECT_THAT(modelComplaint("V1\n1\n0 0 0\n0\n0\n0\n0\n0\n"), HasSubstr("no face"));
  EXPECT_THAT(modelComplaint("V1\n-3\n"), HasSubstr(":2: the number of rows"));
}

TEST(EdgeModel, SurvivesEveryTruncationAndEveryBrokenByte) {
  const std::string text = kSquare;
  for (std::size_t i = 0; i < text.size(); ++i) {
    modelComplaint(text.substr(0, i));
    for (const char wrong : {'9', '-', '.', '"', '\n', '\0', 'e'}) {
      std::string broken = text;
      broken[i] = wrong;
      modelComplaint(broken);
    }
  }
  SUCCEED();
}

}  // namespace
}  // namespace ringhook
