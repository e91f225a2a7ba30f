// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/support/scenes.h"

/// What the tests of solids share.
namespace carom::test {

struct SolidRow {
  std::string name;
  Body body;
};

/// Every shape but the plane, alone and in compounds, with its own centre of mass, one that is written, and fixed.
std::vector<SolidRow> solidRows(std::uint64_t seed);

Shape randomHull(Random& random, int points);
/// A strip of four triangles bent at a right angle: open, with one reflex edge.
Shape bentStrip(double scale);

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }
template <class T>
int count(const std::vector<T>& v) {
  return static_cast<int>(v.size());
}

}  // namespace carom::test
