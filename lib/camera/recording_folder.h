#pragma once

/// \file
/// Where a recording may go: into a new or empty folder, or in place of an earlier recording when
/// that is asked for. A folder that holds anything else is never touched.

#include <cstdint>
#include <filesystem>

namespace ringhook {

/// Throws InputError unless a recording may be written there: the folder is absent or empty, or
/// `overwrite` is set and it holds an earlier recording and nothing else.
void checkRecordingFolder(const std::filesystem::path& folder, bool overwrite);

/// Removes an earlier recording's files; the folder itself stays. Precondition: checked as above.
void clearRecordingFolder(const std::filesystem::path& folder);

/// Throws Error, naming both sizes, if less than `bytes` are free where `folder` is or will be.
void requireFreeSpace(const std::filesystem::path& folder, std::uint64_t bytes);

}  // namespace ringhook
