// The law of lib/README.md, read off the source tree itself.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "source_tree.h"

namespace ringhook {
namespace {

using test::Include;
using test::includesOf;
using test::moduleOf;
using test::SourceFile;
using test::sourcesBelow;
using ::testing::IsEmpty;
using Names = std::set<std::string>;

/// What each folder of lib may name besides itself: lib/README.md's last column.
const std::map<std::string, Names>& law() {
  static const std::map<std::string, Names> table = {
      {"core", {}},
      {"rig", {"core"}},
      {"camera", {"core", "rig"}},
      {"tracking", {"core", "rig"}},
      {"stereo", {"core", "rig"}},
      {"prediction", {"core"}},
      {"servo", {"core"}},
      {"robot", {"core"}},
      {"sim", {"core", "rig", "camera", "robot"}},
      {"cycle", {"core", "rig", "camera", "tracking", "stereo", "prediction", "servo", "robot"}},
      {"evaluation",
       {"core", "rig", "camera", "tracking", "stereo", "prediction", "servo", "robot", "cycle",
        "sim"}}};
  return table;
}

/// "path:line names what", one for each include of `files` that `offends`.
template <class Offends>
std::vector<std::string> offenders(const std::vector<SourceFile>& files, Offends offends) {
  std::vector<std::string> found;
  for (const SourceFile& file : files) {
    for (const Include& include : includesOf(file)) {
      if (offends(file, include)) {
        found.push_back(include.where + " names " + include.name);
      }
    }
  }
  return found;
}

std::vector<std::string> tooLong(const std::string& folder, bool headers, std::size_t limit) {
  std::vector<std::string> found;
  for (const SourceFile& file : sourcesBelow(folder)) {
    if (file.isHeader() == headers && file.lines.size() > limit) {
      found.push_back(file.path.string() + " has " + std::to_string(file.lines.size()) + " lines");
    }
  }
  return found;
}

TEST(Architecture, EveryFolderOfLibHasItsLaw) {
  Names lawful;
  for (const auto& [module, allowed] : law()) {
    lawful.insert(module);
  }
  const std::vector<std::string> folders = test::foldersIn("lib");
  EXPECT_EQ(Names(folders.begin(), folders.end()), lawful);
}

TEST(Architecture, LawHasNoCycle) {
  // Every folder's reach, by repeated widening, must leave itself out.
  std::map<std::string, Names> reach = law();
  for (std::size_t round = 0; round < law().size(); ++round) {
    for (auto& [module, names] : reach) {
      const Names before = names;
      for (const std::string& name : before) {
        names.insert(reach.at(name).begin(), reach.at(name).end());
      }
    }
  }
  for (const auto& [module, names] : reach) {
    EXPECT_FALSE(names.contains(module)) << module;
  }
}

class Module : public ::testing::TestWithParam<std::string> {};

TEST_P(Module, NamesOnlyWhatTheLawAllows) {
  const std::string module = GetParam();
  const std::vector<SourceFile> files = sourcesBelow("lib/" + module);
  ASSERT_GE(files.size(), 3U) << "the scan sees files";
  std::size_t own = 0;
  const auto found = offenders(files, [&](const SourceFile&, const Include& include) {
    const std::string named = moduleOf(include.name);
    own += include.quoted && named == module ? 1 : 0;
    return include.quoted && named != module && !law().at(module).contains(named);
  });
  EXPECT_THAT(found, IsEmpty());
  EXPECT_GE(own, 2U) << "the scan sees includes";
}

INSTANTIATE_TEST_SUITE_P(Architecture, Module,
                         ::testing::Values("core", "rig", "camera", "tracking", "stereo",
                                           "prediction", "servo", "robot", "sim", "cycle",
                                           "evaluation"),
                         [](const auto& test) { return test.param; });

TEST(Architecture, LibraryAndCalibrationNeverNameTheProgramOrTests) {
  for (const char* folder : {"lib", "calib"}) {
    EXPECT_THAT(offenders(sourcesBelow(folder),
                          [](const SourceFile&, const Include& include) {
                            const std::string named = moduleOf(include.name);
                            return named == "app" || named == "tests" || named == "..";
                          }),
                IsEmpty());
  }
  EXPECT_THAT(offenders(sourcesBelow("lib"),
                        [](const SourceFile&, const Include& include) {
                          return moduleOf(include.name) == "calib";
                        }),
              IsEmpty());
}

TEST(Architecture, TruthIsNamedBySimEvaluationAndTestsAlone) {
  const auto names_truth = [](const SourceFile&, const Include& include) {
    return include.name.ends_with("truth.h") && moduleOf(include.name) == "sim";
  };
  for (const std::string& module : test::foldersIn("lib")) {
    if (module == "sim" || module == "evaluation") {
      continue;
    }
    EXPECT_THAT(offenders(sourcesBelow("lib/" + module), names_truth), IsEmpty());
  }
  EXPECT_THAT(offenders(sourcesBelow("calib"), names_truth), IsEmpty());
  EXPECT_FALSE(offenders(sourcesBelow("lib/evaluation"), names_truth).empty())
      << "the scan would see it";
}

TEST(Architecture, FencedHeadersShowEigenAndTheStandardLibraryAlone) {
  for (const char* module : {"core", "stereo", "prediction", "servo", "robot"}) {
    const auto found = offenders(sourcesBelow(std::string("lib/") + module),
                                 [](const SourceFile& file, const Include& include) {
                                   // Standard headers have neither a folder nor an extension.
                                   const bool standard =
                                       include.name.find_first_of("/.") == std::string::npos;
                                   return file.isHeader() && !include.quoted && !standard &&
                                          !include.name.starts_with("Eigen/");
                                 });
    EXPECT_THAT(found, IsEmpty());
  }
}

/// Drivers of real devices: they say when something came, on the host's clock.
bool isDriver(const std::string& path) {
  return path.ends_with("camera/gige_camera.cpp") ||
         path.ends_with("camera/aravis_stereo_camera.cpp");
}

TEST(Architecture, NoStageReadsAClock) {
  const std::regex clock(
      R"(_clock\s*::\s*now|\bClock\s*::\s*now|std::time\s*\(|clock_gettime|gettimeofday)");
  for (const char* module : {"core", "rig", "camera", "tracking", "stereo", "prediction", "servo",
                             "cycle", "evaluation"}) {
    for (const SourceFile& file : sourcesBelow(std::string("lib/") + module)) {
      for (const std::string& line : file.lines) {
        EXPECT_TRUE(isDriver(file.path) || !std::regex_search(line, clock))
            << file.path << ": " << line;
      }
    }
  }
  EXPECT_TRUE(std::regex_search("std::chrono::steady_clock::now()", clock));
}

TEST(Architecture, NoHeaderIsLongerThanTwoHundredLines) {
  for (const char* folder : {"lib", "calib", "app", "tests"}) {
    EXPECT_THAT(tooLong(folder, true, 200), IsEmpty());
  }
}

TEST(Architecture, NoSourceIsLongerThanFourHundredLines) {
  for (const char* folder : {"lib", "calib", "app", "tests"}) {
    EXPECT_THAT(tooLong(folder, false, 400), IsEmpty());
  }
}

}  // namespace
}  // namespace ringhook
