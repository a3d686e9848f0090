#pragma once

/// \file
/// What a rig file holds besides the keys of doc/formats: entries of other programs, which must
/// survive being read and written again. They are kept as the text they are, comments included, as
/// OpenCV's writer could not repeat them.

#include <string>
#include <vector>

#include "rig/stereo_rig.h"

namespace ringhook {

/// \param text an OpenCV YAML file. A top-level key stands in the first column and its block
/// reaches to the next one.
std::vector<UnknownEntry> unknownEntries(const std::string& text);

}  // namespace ringhook
