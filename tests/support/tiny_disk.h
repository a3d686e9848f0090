#pragma once

/// \file
/// A disk of a test's own that is soon full: a file system in memory, in a mount namespace of a
/// process of its own. Needs no rights where the kernel permits user namespaces, and otherwise
/// root; a test that can have neither is skipped.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace ringhook::test {

struct TinyDiskResult {
  bool possible = false;  ///< false if such a disk cannot be had here
  bool passed = false;    ///< the job returned, and no expectation in it failed
};

/// Runs `job` in another process, with a disk of `bytes` on `folder`, which must exist. What it
/// wrote there vanishes with it.
TinyDiskResult runOnTinyDisk(const std::filesystem::path& folder, std::size_t bytes,
                             const std::function<void()>& job);

}  // namespace ringhook::test
