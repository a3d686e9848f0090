#include "rig/covered_rectangle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ringhook {
namespace {

using Eigen::Vector2d;

constexpr std::size_t kCoarseRows = 24;
constexpr double kFinestStep = 0.25;  // [px]

struct Span {
  double left = 1e9;    // [px]
  double right = -1e9;  // [px]
};

/// Columns of the polygon in one row.
Span spanAt(const std::vector<Vector2d>& polygon, double row) {
  Span span;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d& a = polygon[i];
    const Vector2d& b = polygon[(i + 1) % polygon.size()];
    if ((a.y() - row) * (b.y() - row) > 0.0 || a.y() == b.y()) {
      continue;
    }
    const double x = a.x() + (b.x() - a.x()) * (row - a.y()) / (b.y() - a.y());
    span.left = std::min(span.left, x);
    span.right = std::max(span.right, x);
  }
  return span;
}

struct Rows {
  double top = 0.0;     // [px]
  double bottom = 0.0;  // [px]
  double area = 0.0;    // [px^2]
  Span span;
};

Rows between(double top, const Span& a, double bottom, const Span& b) {
  Rows rows{top, bottom, 0.0, {std::max(a.left, b.left), std::min(a.right, b.right)}};
  rows.area = std::max(0.0, rows.span.right - rows.span.left) * std::max(0.0, bottom - top);
  return rows;
}

Rows rectangleOf(const std::vector<Vector2d>& polygon, double top, double bottom) {
  return between(top, spanAt(polygon, top), bottom, spanAt(polygon, bottom));
}

Rows coarseSearch(const std::vector<Vector2d>& polygon, double low, double high) {
  std::array<double, kCoarseRows + 1> rows{};
  std::array<Span, kCoarseRows + 1> spans;
  for (std::size_t i = 0; i <= kCoarseRows; ++i) {
    rows[i] = low + (high - low) * static_cast<double>(i) / kCoarseRows;
    spans[i] = spanAt(polygon, rows[i]);
  }
  Rows best;
  for (std::size_t a = 0; a < kCoarseRows; ++a) {
    for (std::size_t b = a + 1; b <= kCoarseRows; ++b) {
      const Rows now = between(rows[a], spans[a], rows[b], spans[b]);
      best = now.area > best.area ? now : best;
    }
  }
  return best;
}

Rows fineSearch(const std::vector<Vector2d>& polygon, Rows best, double step) {
  while (step > kFinestStep) {
    const Rows before = best;
    for (const Vector2d& d :
         {Vector2d(step, 0), Vector2d(-step, 0), Vector2d(0, step), Vector2d(0, -step)}) {
      const Rows rows = rectangleOf(polygon, before.top + d.x(), before.bottom + d.y());
      best = rows.area > best.area ? rows : best;
    }
    step = best.area > before.area ? step : 0.5 * step;
  }
  return best;
}

bool columnCovered(int x, const Window& w, const std::function<bool(int, int)>& covered) {
  for (int y = w.y; y < w.y + w.height; ++y) {
    if (!covered(x, y)) {
      return false;
    }
  }
  return true;
}

bool rowCovered(int y, const Window& w, const std::function<bool(int, int)>& covered) {
  for (int x = w.x; x < w.x + w.width; ++x) {
    if (!covered(x, y)) {
      return false;
    }
  }
  return true;
}

/// Drops each border line that has an uncovered pixel, `trim` pixels at its ends not looked at;
/// false if none had.
bool shrinkOnce(Window& w, int trim, const std::function<bool(int, int)>& covered) {
  const Window before = w;
  const Window inner{w.x + trim, w.y + trim, w.width - 2 * trim, w.height - 2 * trim};
  const int right = w.x + w.width - 1;
  const int bottom = w.y + w.height - 1;
  if (!rowCovered(w.y, inner, covered)) {
    w = {w.x, w.y + 1, w.width, w.height - 1};
  }
  if (!rowCovered(bottom, inner, covered)) {
    w.height -= 1;
  }
  if (w != before && trim == 0) {
    return true;
  }
  if (!columnCovered(w.x, inner, covered)) {
    w = {w.x + 1, w.y, w.width - 1, w.height};
  }
  if (!columnCovered(right, inner, covered)) {
    w.width -= 1;
  }
  return w != before;
}

}  // namespace

Window coveredRectangle(const std::vector<Vector2d>& polygon, const Window& bounds,
                        const std::function<bool(int, int)>& covered) {
  double low = 1e9;
  double high = -1e9;
  for (const Vector2d& p : polygon) {
    low = std::min(low, p.y());
    high = std::max(high, p.y());
  }
  if (!(high > low)) {
    return {};
  }
  const Rows best =
      fineSearch(polygon, coarseSearch(polygon, low, high), (high - low) / kCoarseRows);
  if (!(best.area > 0.0)) {
    return {};
  }
  // One pixel too many on each side, then shrink to what is covered in truth.
  const int x = static_cast<int>(std::floor(best.span.left)) - 1;
  const int y = static_cast<int>(std::floor(best.top)) - 1;
  Window w = intersect({x, y, static_cast<int>(std::ceil(best.span.right)) + 2 - x,
                        static_cast<int>(std::ceil(best.bottom)) + 2 - y},
                       bounds);
  for (const int trim : {2, 0}) {  // sides first, so that one bad corner costs one line only
    while (!w.empty() && shrinkOnce(w, trim, covered)) {
    }
  }
  return w;
}

}  // namespace ringhook
