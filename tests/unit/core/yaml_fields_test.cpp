#include "core/yaml_fields.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "../../support/scratch_folder.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

YamlFields opened(const std::string& text) {
  const ScratchFolder folder;
  return YamlFields::open(folder.write("fields.yaml", text));
}

template <class Action>
std::string complaint(Action&& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(YamlFields, UpdateKeepsWhatIsLeftOutAndConvertsTheUnit) {
  YamlFields fields = opened("a_mm: 5\nflag: true\nlist: [1, 2.5]\n");
  double a = 1.0;
  double b = 2.0;
  int count = 3;
  bool flag = false;
  std::vector<double> list;
  fields.update("a_mm", a, 0.0, 10.0, 1e-3);
  fields.update("b", b, 0.0, 10.0);
  fields.update("count", count, 0, 10);
  fields.update("flag", flag);
  fields.update("list", list, 4, 0.0, 3.0);
  fields.refuseUnknown();
  EXPECT_DOUBLE_EQ(a, 0.005);
  EXPECT_EQ(b, 2.0);
  EXPECT_EQ(count, 3);
  EXPECT_TRUE(flag);
  EXPECT_EQ(list, (std::vector<double>{1.0, 2.5}));
}

TEST(YamlFields, NamesFieldsOfMappingsInLists) {
  YamlFields fields = opened("layout:\n  - {size: 1}\n  - {size: big}\n");
  auto entries = fields.list("layout");
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[0].number("size"), 1.0);
  EXPECT_THAT(complaint([&] { entries[1].number("size"); }),
              AllOf(HasSubstr("line 3: field layout[1].size: expected a number")));
}

TEST(YamlFields, TellsTheRangeThatItExpects) {
  YamlFields fields = opened("x: 9\nn: 2.5\ns: maybe\nl: [1, 9]\nk: blue\n");
  double x = 0.0;
  int n = 0;
  bool flag = false;
  std::vector<double> list;
  EXPECT_THAT(complaint([&] { fields.update("x", x, 0.0, 5.0); }),
              HasSubstr("line 1: field x: expected a number from 0 to 5"));
  EXPECT_THAT(complaint([&] { fields.number("x", 10.0); }), HasSubstr("a number from 10 on"));
  EXPECT_THAT(complaint([&] { fields.update("n", n, 0, 5); }),
              HasSubstr("line 2: field n: expected a whole number from 0 to 5"));
  EXPECT_THAT(complaint([&] { fields.update("s", flag); }),
              HasSubstr("line 3: field s: expected true or false"));
  EXPECT_THAT(
      complaint([&] { fields.update("l", list, 3, 0.0, 5.0); }),
      HasSubstr("line 4: field l: expected at most 3 numbers in [ ], each a number from 0"));
  EXPECT_THAT(complaint([&] {
                static_cast<void>(fields.choice("k", {"red", "green"}));
              }),
              HasSubstr("line 5: field k: expected one of red, green, got blue"));
}

TEST(YamlFields, RefusesAFieldThatStandsTwice) {
  EXPECT_THAT(complaint([&] { opened("a: 1\nb: 2\na: 3\n"); }),
              HasSubstr("line 3: field a stands twice"));
  EXPECT_THAT(complaint([&] { opened("s: {a: 1,\n a: 3}\n").section("s"); }),
              HasSubstr("line 2: field s.a stands twice"));
}

TEST(YamlFields, NamesWhatItWouldHaveKnown) {
  YamlFields fields = opened("colour: red\n");
  double size = 0.0;
  fields.update("size", size, 0.0, 1.0);
  EXPECT_FALSE(fields.has("light")) << "a section that may be left out";
  EXPECT_THAT(complaint([&] { fields.refuseUnknown(); }),
              HasSubstr("line 1: unknown field colour; expected light, size"));
}

}  // namespace
}  // namespace ringhook
