// SPDX-License-Identifier: MIT
#include "editing/strategy/place_ranges.hpp"

#include <algorithm>
#include <cmath>

namespace carom::editing_detail {

bool varies(const EditProblem& problem, const std::string& body, std::initializer_list<const char*> words) {
  const auto& controls = problem.controls.controls();
  return std::any_of(controls.begin(), controls.end(), [&](const BoundControl& c) {
    return c.control.body == body && std::find(words.begin(), words.end(), c.control.vary) != words.end();
  });
}

bool readsPosition(const Row& row) { return row.kind && std::string(row.kind->word) == "position" && row.region < 0 && row.own < 0; }

PositionRange placeOf(const ConstraintSet& set, int constraint, double tolerance) {
  PositionRange place;
  for (const Row& row : set.rows()) {
    if (row.constraint != constraint || !readsPosition(row)) continue;
    const auto k = static_cast<std::size_t>(row.component);
    const bool range = row.isRange();
    place.lower[k] = (range ? row.lower : row.target) - tolerance * row.scale;
    place.upper[k] = (range ? row.upper : row.target) + tolerance * row.scale;
    place.any = true;
  }
  return place;
}

double distanceOf(const PositionRange& a, const PositionRange& b) {
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double off = std::max({0.0, a.lower[k] - b.upper[k], b.lower[k] - a.upper[k]});
    squares += off * off;
  }
  return std::sqrt(squares);
}

}  // namespace carom::editing_detail
