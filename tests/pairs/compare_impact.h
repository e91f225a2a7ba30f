// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

#include "adjoint/simulate/simulate.h"
#include "tests/pairs/encounter.h"
#include "tests/support/scaled.h"

namespace carom::pairs {

/// What the program finds of the first impact of a scene's two bodies, with the normal from body 1 to body 0.
struct Found {
  bool any = false;
  double time = 0;
  Vec3 normal = Vec3::Zero(), point = Vec3::Zero();
  double margin = 1;  ///< grazing
  std::size_t contacts = 0;
  std::string what;  ///< in words
};
Found firstFound(const Scene& scene, double duration);

inline constexpr double kTimeTolerance = 1e-12;  // s
inline constexpr double kPlaceTolerance = 1e-9;  // m; and 1 for normals
inline constexpr int kMostFailures = 5;          // of a test, which then stops

/// Compares what was found with the brute-force answer, over many throws.
class Agreement {
 public:
  /// One sentence about what differs; empty when nothing does.
  std::string compare(const Found& found, const std::optional<FirstImpact>& expected);

  int impacts = 0, misses = 0, doubtful = 0;
  std::map<std::string, int> doubts;    ///< of throws that were replaced
  std::map<std::string, int> features;  ///< kinds of features that met
  double worst_time = 0, worst_normal = 0, worst_point = 0;
  std::string summary() const;
};

/// The kinds of features, such as "vertex on face".
std::string withoutNumbers(const std::string& features);

using test::scaled;

}  // namespace carom::pairs
