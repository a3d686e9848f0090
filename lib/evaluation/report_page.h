#pragma once

/// \file
/// The report of an evaluation as one self-contained page: a table, zoomable charts (dygraphs,
/// inlined from Debian's libjs-dygraphs) and two pictures. It needs no network and no other file.

#include <string>
#include <utility>
#include <vector>

namespace ringhook {

/// One chart: a shared time axis and one line a series.
struct ReportChart {
  std::string title;                        ///< with the unit, as in "position error [mm]"
  std::vector<std::string> series;          ///< names of the lines
  std::vector<double> time_s;               ///< [s]
  std::vector<std::vector<double>> values;  ///< [series][time]; NaN leaves a gap
};

struct ReportPage {
  std::string title;
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and text
  std::vector<std::vector<std::string>> table;             ///< first row is the header
  std::vector<ReportChart> charts;
  std::vector<std::pair<std::string, std::string>> pictures;  ///< caption and PNG bytes
};

/// The page as HTML. Throws Error naming the missing file if dygraphs is not installed.
[[nodiscard]] std::string reportHtml(const ReportPage& page);

}  // namespace ringhook
