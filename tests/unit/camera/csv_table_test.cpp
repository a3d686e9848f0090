#include "camera/csv_table.h"

#include <gmock/gmock.h>

#include "../../support/scratch_folder.h"
#include "core/error.h"

namespace ringhook {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(CsvTable, FindsColumnsByNameInAnyOrder) {
  const ScratchFolder folder;
  const CsvTable table(folder.write("t.csv", "# b , a\n\n1.5,-2\n# a remark\n+3e1, 4\n"));
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.number(0, table.column("a")), -2.0);
  EXPECT_EQ(table.number(1, table.column("b")), 30.0);
}

TEST(CsvTable, NamesLineAndColumnOfABadNumber) {
  const ScratchFolder folder;
  const CsvTable table(folder.write("t.csv", "a,b\n1,2\n3,nan\n4,2x\n"));
  for (const std::size_t row : {1U, 2U}) {
    const std::string message = messageOf<InputError>([&] { (void)table.number(row, 1); });
    EXPECT_THAT(message, AllOf(HasSubstr("t.csv line " + std::to_string(row + 2)),
                               HasSubstr("column b"), HasSubstr("expected a number")));
  }
}

TEST(CsvTable, RefusesRowsOfAnotherLength) {
  const ScratchFolder folder;
  const auto file = folder.write("t.csv", "a,b\n1,2\n1,2,3\n");
  EXPECT_THAT(messageOf<InputError>([&] { CsvTable{file}; }), HasSubstr("line 3"));
}

TEST(CsvTable, ListsThePresentColumnsWhenOneIsMissing) {
  const ScratchFolder folder;
  const CsvTable table(folder.write("t.csv", "time_s,x\n0,1\n"));
  EXPECT_THAT(messageOf<InputError>([&] { (void)table.column("y"); }),
              AllOf(HasSubstr("column y"), HasSubstr("time_s, x")));
}

TEST(CsvTable, RefusesAMissingOrEmptyFile) {
  const ScratchFolder folder;
  const auto empty = folder.write("empty.csv", "");
  EXPECT_THROW(CsvTable{empty}, InputError);
  EXPECT_THROW(CsvTable{folder.path() / "none.csv"}, InputError);
}

}  // namespace
}  // namespace ringhook
