#include "rig/unknown_entries.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace ringhook {
namespace {

constexpr std::array<std::string_view, 18> kKnownKeys = {"image_width",
                                                         "image_height",
                                                         "K1",
                                                         "D1",
                                                         "K2",
                                                         "D2",
                                                         "R",
                                                         "T",
                                                         "fMc1",
                                                         "joint_zeros_deg",
                                                         "robot_delay_ms",
                                                         "camera_delay_ms",
                                                         "rms_px",
                                                         "heldout_vertical_disparity_px",
                                                         "board",
                                                         "views",
                                                         "date",
                                                         "tool_version"};

bool isKnown(std::string_view key) {
  return std::find(kKnownKeys.begin(), kKnownKeys.end(), key) != kKnownKeys.end();
}

}  // namespace

std::vector<UnknownEntry> unknownEntries(const std::string& text) {
  std::vector<UnknownEntry> entries;
  bool keep = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string line = text.substr(begin, end - begin);
    begin = end;
    const std::size_t colon = line.find(':');
    if (line.starts_with("%") || line.starts_with("---") || line.starts_with("...") ||
        line.starts_with("#")) {
      keep = false;
    } else if (colon != std::string::npos && colon > 0 &&
               std::string(" \t-[]{},").find(line[0]) == std::string::npos) {
      std::string key = line.substr(0, colon);
      key.erase(key.find_last_not_of(" \t\"'") + 1);
      key.erase(0, key.find_first_not_of("\"'"));
      keep = !isKnown(key);
      if (keep) {
        entries.push_back({key, line});
      }
    } else if (keep) {
      entries.back().text += line;
    }
  }
  return entries;
}

}  // namespace ringhook
