// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/problem/controls/control_set.hpp"

/// Resolving one control against a scene, with every check on what a person can write. Internal to editing/.
namespace carom::editing_detail {

/// Adds a zero Tilt to `scene` where a tilt control needs one. Throws InputError starting at `where`.
BoundControl bindControl(Scene& scene, const Control& control, const std::string& where);

/// Which components of the kind vary: slots in increasing order.
std::vector<int> varyingSlots(const Scene& scene, const BoundControl& bound, const std::string& where);

struct Interval {
  double lower, upper;
};
/// Bounds of the k-th of `count` varying components: the person's inside the physical ones. `start` is its value.
Interval boundsOf(const BoundControl& bound, int k, int count, double start, const std::string& where);

}  // namespace carom::editing_detail
