#include "tracking/edge_model.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "core/error.h"
#include "core/file_kind.h"

namespace ringhook {
namespace {

constexpr int kDeepestLoad = 8;
constexpr std::size_t kMostEntries = 100000;

std::string readText(const std::filesystem::path& path) {
  // A folder or a device would open, but has no end up to which it could be read.
  std::ifstream file(isFile(path) ? path : std::filesystem::path());
  if (!file) {
    throw InputError(path.string() + ": cannot read this edge model (.cao expected)");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

/// One .cao file, line by line: comments and attributes removed, line numbers kept.
class CaoReader {
 public:
  CaoReader(const std::string& text, std::filesystem::path path, int depth)
      : stream_(text), path_(std::move(path)), depth_(depth) {}

  EdgeModel read() {
    if (!next() || line_ != "V1") {
      fail("'V1' expected as the first line of an edge model");
    }
    while (next() && line_.rfind("load", 0) == 0) {
      include();
    }
    const int own = static_cast<int>(model_.points.size());
    readPoints();
    readLines(own);
    readLineFaces();
    readPointFaces(own);
    for (const std::size_t values : {3U, 4U}) {  // cylinders: 2 points, radius; circles: 3 points
      if (have_line_) {
        readRows("a cylinder or circle", values, [](const std::vector<double>&) {});
      }
    }
    return std::move(model_);
  }

 private:
  [[noreturn]] void fail(const std::string& sentence) const {
    throw InputError(path_.string() + ":" + std::to_string(number_) + ": " + sentence);
  }

  /// Moves to the next line that holds anything.
  bool next() {
    have_line_ = false;
    std::string raw;
    while (!have_line_ && std::getline(stream_, raw)) {
      ++number_;
      raw = raw.substr(0, raw.find('#'));
      std::istringstream words(raw);
      std::string word;
      line_.clear();
      while (words >> word && word.find('=') == std::string::npos) {
        line_ += (line_.empty() ? "" : " ") + word;
      }
      have_line_ = !line_.empty();
    }
    return have_line_;
  }

  void include() {
    const auto open = line_.find('"');
    const auto close = line_.rfind('"');
    if (open == std::string::npos || close <= open) {
      fail("load(\"file.cao\") expected");
    }
    if (depth_ >= kDeepestLoad) {
      fail("load() goes deeper than " + std::to_string(kDeepestLoad) + " files");
    }
    const std::filesystem::path file =
        path_.parent_path() / line_.substr(open + 1, close - open - 1);
    const EdgeModel part = CaoReader(readText(file), file, depth_ + 1).read();
    const int offset = static_cast<int>(model_.points.size());
    model_.points.insert(model_.points.end(), part.points.begin(), part.points.end());
    for (const auto& edge : part.edges) {
      addEdge(edge[0] + offset, edge[1] + offset);
    }
  }

  std::vector<double> numbers() const {
    std::istringstream words(line_);
    std::vector<double> values;
    std::string word;
    while (words >> word) {
      char* end = nullptr;
      values.push_back(std::strtod(word.c_str(), &end));
      if (end != word.c_str() + word.size() || !std::isfinite(values.back())) {
        fail("a number expected instead of '" + word + "'");
      }
    }
    return values;
  }

  /// A section: a count, then as many rows of at least `least` numbers.
  template <class Use>
  void readRows(const std::string& what, std::size_t least, Use&& use) {
    const std::vector<double> count = numbers();
    if (count.size() != 1 || count[0] < 0 || count[0] != std::floor(count[0]) ||
        count[0] > static_cast<double>(kMostEntries)) {
      fail("the number of rows expected before " + what);
    }
    for (auto left = static_cast<std::size_t>(count[0]); left > 0; --left) {
      if (!next()) {
        fail("the file ends before " + what);
      }
      const std::vector<double> row = numbers();
      if (row.size() < least) {
        fail(std::to_string(least) + " numbers expected for " + what);
      }
      use(row);
    }
    next();
  }

  int index(double value, std::size_t size, int own) const {
    const double last = static_cast<double>(size) - own - 1;
    if (value != std::floor(value) || value < 0 || value > last) {
      fail("a number from 0 to " + std::to_string(static_cast<long>(last)) + " expected, not " +
           std::to_string(value));
    }
    return static_cast<int>(value) + own;
  }

  void addEdge(int a, int b) {
    const std::array<int, 2> edge{std::min(a, b), std::max(a, b)};
    if (a != b && std::find(model_.edges.begin(), model_.edges.end(), edge) == model_.edges.end()) {
      model_.edges.push_back(edge);
    }
  }

  void readPoints() {
    if (!have_line_) {
      fail("the number of points expected");
    }
    readRows("a point", 3, [&](const std::vector<double>& row) {
      model_.points.emplace_back(row[0], row[1], row[2]);
    });
  }

  void readLines(int own) {
    if (!have_line_) {
      return;
    }
    readRows("a line", 2, [&](const std::vector<double>& row) {
      const std::size_t size = model_.points.size();
      addEdge(index(row[0], size, own), index(row[1], size, own));
      ++lines_;
    });
  }

  /// A face of lines adds no edge to those of its lines.
  void readLineFaces() {
    if (!have_line_) {
      return;
    }
    readRows("a face of lines", 2, [&](const std::vector<double>& row) {
      for (std::size_t i = 1; i < checkedSize(row); ++i) {
        static_cast<void>(index(row[i], lines_, 0));
      }
    });
  }

  void readPointFaces(int own) {
    if (!have_line_) {
      return;
    }
    readRows("a face of points", 2, [&](const std::vector<double>& row) {
      const std::size_t size = checkedSize(row);
      for (std::size_t i = 1; i < size; ++i) {
        const double other = row[i + 1 < size ? i + 1 : 1];
        addEdge(index(row[i], model_.points.size(), own), index(other, model_.points.size(), own));
      }
    });
  }

  /// Numbers in a face's row with its leading count; the row must hold them all.
  std::size_t checkedSize(const std::vector<double>& row) const {
    if (row[0] < 1 || row[0] != std::floor(row[0]) ||
        row[0] + 1 > static_cast<double>(row.size())) {
      fail("a face must list as many members as its first number says");
    }
    return static_cast<std::size_t>(row[0]) + 1;
  }

  std::istringstream stream_;
  std::filesystem::path path_;
  int depth_;
  int number_ = 0;
  std::size_t lines_ = 0;
  std::string line_;
  bool have_line_ = false;
  EdgeModel model_;
};

}  // namespace

std::vector<EdgeSample> sampleEdges(const EdgeModel& model, double step_m) {
  std::vector<EdgeSample> samples;
  for (const auto& edge : model.edges) {
    const Eigen::Vector3d& a = model.points[static_cast<std::size_t>(edge[0])];
    const Eigen::Vector3d& b = model.points[static_cast<std::size_t>(edge[1])];
    const double length = (b - a).norm();
    const int pieces = std::max(1, static_cast<int>(std::ceil(length / step_m)));
    for (int i = 0; i < pieces && length > 0.0; ++i) {
      samples.push_back({a + (b - a) * ((i + 0.5) / pieces), (b - a) / length});
    }
  }
  return samples;
}

EdgeModel loadEdgeModel(const std::filesystem::path& path) {
  return parseEdgeModel(readText(path), path);
}

EdgeModel parseEdgeModel(const std::string& text, const std::filesystem::path& path) {
  EdgeModel model = CaoReader(text, path, 0).read();
  if (model.edges.empty()) {
    throw InputError(path.string() + ": model with no face or line");
  }
  return model;
}

}  // namespace ringhook
