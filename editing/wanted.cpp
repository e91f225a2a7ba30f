// SPDX-License-Identifier: MIT
#include "editing/wanted.h"

#include <utility>

namespace carom {
namespace {

/// Component `i` of a target of `count`.
void put(const Wanted& wanted, std::size_t i, std::size_t count, Target& target) {
  target.value.resize(count, any);
  target.value[i] = wanted.value;
  if (!wanted.min.isFree()) target.min.resize(count, any), target.min[i] = wanted.min;
  if (!wanted.max.isFree()) target.max.resize(count, any), target.max[i] = wanted.max;
}

}  // namespace

Target targetOf(std::string quantity, const WantedVector& wanted) {
  Target target;
  target.quantity = std::move(quantity);
  put(wanted.x, 0, 3, target), put(wanted.y, 1, 3, target), put(wanted.z, 2, 3, target);
  return target;
}

Target targetOf(std::string quantity, const Wanted& wanted) {
  Target target;
  target.quantity = std::move(quantity);
  put(wanted, 0, 1, target);
  return target;
}

}  // namespace carom
