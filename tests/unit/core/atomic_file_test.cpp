#include "core/atomic_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "../../support/scratch_folder.h"
#include "core/error.h"

namespace ringhook {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  static std::string read(const fs::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  ScratchFolder scratch_;
  const fs::path folder_ = scratch_.path() / "of the test";
};

TEST_F(AtomicFileTest, AppearsWholeOnCommit) {
  const fs::path path = folder_ / "deep" / "result.json";
  AtomicFile file(path);
  file.stream() << "{}";
  EXPECT_FALSE(fs::exists(path));
  file.commit();
  EXPECT_EQ(read(path), "{}");
}

TEST_F(AtomicFileTest, AnExceptionLeavesTheOldFileAndNothingElse) {
  const fs::path path = folder_ / "result.json";
  writeFileAtomically(path, "old");
  try {
    AtomicFile file(path);
    file.stream() << "half";
    throw std::runtime_error("interrupted");
  } catch (const std::runtime_error&) {
    EXPECT_EQ(read(path), "old");
  }
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, WithoutCommitFoldersThatItMadeAreGoneAndOthersStay) {
  fs::create_directories(folder_ / "mine");
  { const AtomicFile file(folder_ / "mine" / "out" / "live" / "result.json"); }
  EXPECT_FALSE(fs::exists(folder_ / "mine" / "out"));
  EXPECT_TRUE(fs::exists(folder_ / "mine")) << "it was there before";
  {
    const AtomicFile file(folder_ / "mine" / "out" / "live" / "result.json");
    writeFileAtomically(folder_ / "mine" / "out" / "kept.json", "{}");
  }
  EXPECT_FALSE(fs::exists(folder_ / "mine" / "out" / "live"));
  EXPECT_EQ(read(folder_ / "mine" / "out" / "kept.json"), "{}")
      << "somebody else's, made meanwhile";
}

TEST_F(AtomicFileTest, RefusesAPlaceThatCannotBeWrittenAndNamesIt) {
  fs::create_directories(folder_);
  writeFileAtomically(folder_ / "file", "x");
  try {
    AtomicFile file(folder_ / "file" / "below.json");
    FAIL() << "expected an InputError";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("below.json"), std::string::npos);
    EXPECT_EQ(e.exitCode(), 2);
  }
}

}  // namespace
}  // namespace ringhook
