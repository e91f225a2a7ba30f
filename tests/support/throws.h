// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "tests/support/scenes.h"

/// Random throws of any shape at any other, for tests that hold all pairs of kinds to an independent answer.
namespace carom::test {

/// One row of the table of kinds: a maker of random shapes, 5 cm to half a metre in size. A new kind adds a row.
struct ShapeMaker {
  const char* name;
  bool moves;  ///< false: only as a fixed body
  Shape (*make)(Random&, bool fixed);
};
const std::vector<ShapeMaker>& shapeMakers();

/// Two kinds in order.
struct ShapePair {
  const ShapeMaker *a, *b;
  /// As in the names of tests: "sphere_on_box".
  std::string name(const char* relation = "_on_") const { return std::string(a->name) + relation + b->name; }
};
inline std::ostream& operator<<(std::ostream& out, const ShapePair& pair) { return out << pair.name(); }
/// Every ordered pair of kinds, but for those that both stand still and cannot meet.
std::vector<ShapePair> pairsThatMeet();

/// Closed, concave: an L of square bars; a cup with an open top. With `jitter` m its faces are not flat.
Mesh bracketMesh(Random& random, double jitter);
Mesh cupMesh(Random& random, int sides, double jitter);
/// Open: a piece of ground of 4 x 4 squares, cut into triangles.
Mesh groundMesh(Random& random);
/// Of points on an ellipsoid, off the origin.
Hull pebbleHull(Random& random, int points);

struct Throw {
  Scene scene;  ///< two bodies, of the kinds asked for and in that order
  double duration = 0.5;
};
/// Bodies apart at the start, thrown so that most of them meet; both moving, or one of them fixed; spinning, most with
/// gravity. The same seed gives the same throw.
Throw randomThrow(const ShapeMaker& a, const ShapeMaker& b, std::uint64_t seed);

/// One line a body, to full precision.
std::string describe(const Throw& t);

}  // namespace carom::test
