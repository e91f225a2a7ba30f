// SPDX-License-Identifier: MIT
#include "editing/problem/rows/quantities.hpp"

#include "adjoint/numeric/so3.hpp"
#include "adjoint/numeric/so3_rates.hpp"
#include "editing/problem/rows/closest_approach.hpp"
#include "editing/problem/rows/contact_place.hpp"
#include "editing/problem/rows/motion_quantities.hpp"

namespace carom::editing_detail {

using namespace adjoint_detail;

namespace {

Vec3 threeNumbers(const Target& target) { return {target.value[0], target.value[1], target.value[2]}; }

// position, velocity, angular velocity: a vector of the state itself.

template <Vec3 BodyState::*kField>
Vec3 fieldOf(const BodyState& state, double, const Target&) {
  return state.*kField;
}
template <Vec3 StateSeed::*kField>
StateSeed fieldSeed(const BodyState&, const Target&, int component) {
  StateSeed seed;
  (seed.*kField)[component] = 1;
  return seed;
}

// orientation: u = log(R R_target^T), so that du = J_l(u)^-1 theta.

Quat targetOrientation(const Target& target) {
  return Quat(target.value[0], target.value[1], target.value[2], target.value[3]).normalized();
}
Vec3 noTurn(const Target&) { return Vec3::Zero(); }
Vec3 turnFromTarget(const BodyState& state, double, const Target& target) {
  return logSO3(state.orientation * targetOrientation(target).conjugate());
}
StateSeed turnSeed(const BodyState& state, const Target& target, int component) {
  StateSeed seed;
  seed.orientation = leftJacobianInverse(turnFromTarget(state, 0, target)).row(component).transpose();
  return seed;
}

// d(J^-1) = -J^-1 dJ J^-1, du = J^-1 theta.
StateSeed turnSeedRate(const BodyState& state, const BodyStateRate& rate, const Target& target, int component) {
  const Vec3 u = turnFromTarget(state, 0, target);
  const Mat3 inverse = leftJacobianInverse(u);
  StateSeed seed;
  seed.orientation = -(inverse * leftJacobianRate(u, inverse * rate.orientation) * inverse).row(component).transpose();
  return seed;
}

// point: p = x + R b, so that dp = dx + theta x (R b).

Vec3 pointOf(const BodyState& state, double, const Target& target) {
  return state.position + state.orientation * target.body_point;
}
StateSeed pointSeed(const BodyState& state, const Target& target, int component) {
  StateSeed seed;
  const Vec3 axis = Vec3::Unit(component);
  seed.position = axis;
  seed.orientation = (state.orientation * target.body_point).cross(axis);
  return seed;
}

StateSeed pointSeedRate(const BodyState& state, const BodyStateRate& rate, const Target& target, int component) {
  StateSeed seed;
  seed.orientation = rate.orientation.cross(state.orientation * target.body_point).cross(Vec3::Unit(component));
  return seed;
}

// time of an impact

Vec3 oneNumber(const Target& target) { return {target.value[0], 0, 0}; }
Vec3 timeOf(const BodyState&, double time, const Target&) { return {time, 0, 0}; }
StateSeed timeSeed(const BodyState&, const Target&, int) {
  StateSeed seed;
  seed.time = 1;
  return seed;
}

const QuantityKind kPosition{
    .word = "position",
    .rows = 3,
    .numbers = 3,
    .scale = &NaturalScales::length,
    .target = threeNumbers,
    .value = fieldOf<&BodyState::position>,
    .seed = fieldSeed<&StateSeed::position>,
    .unit = "m",
};
const QuantityKind kOrientation{
    .word = "orientation",
    .rows = 3,
    .numbers = 4,
    .all_or_nothing = true,
    .turns = true,
    .target = noTurn,
    .value = turnFromTarget,
    .seed = turnSeed,
    .seed_rate = turnSeedRate,
    .from_target = true,
    .unit = "rad",
};
const QuantityKind kVelocity{
    .word = "velocity",
    .rows = 3,
    .numbers = 3,
    .of_rest = false,
    .scale = &NaturalScales::velocity,
    .target = threeNumbers,
    .value = fieldOf<&BodyState::velocity>,
    .seed = fieldSeed<&StateSeed::velocity>,
    .unit = "m/s",
};
// A spin is read in world axes, but the constant of a flight is the angular momentum.
const QuantityKind kAngularVelocity{
    .word = "angular_velocity",
    .rows = 3,
    .numbers = 3,
    .of_rest = false,
    .turns = true,
    .scale = &NaturalScales::angular_velocity,
    .target = threeNumbers,
    .value = fieldOf<&BodyState::angular_velocity>,
    .seed = fieldSeed<&StateSeed::angular_velocity>,
    .unit = "rad/s",
};
const QuantityKind kTime{
    .word = "time",
    .rows = 1,
    .numbers = 1,
    .all_or_nothing = true,
    .only_at_events = true,
    .scale = &NaturalScales::time,
    .target = oneNumber,
    .value = timeOf,
    .seed = timeSeed,
    .unit = "s",
};
const QuantityKind kPoint{
    .word = "point",
    .rows = 3,
    .numbers = 3,
    .turns = true,
    .scale = &NaturalScales::length,
    .target = threeNumbers,
    .value = pointOf,
    .seed = pointSeed,
    .seed_rate = pointSeedRate,
    .unit = "m",
};


// What depends on more than the state: see motion_quantities.hpp.

const QuantityKind kSpeed{
    .word = "speed",
    .rows = 1,
    .numbers = 1,
    .all_or_nothing = true,
    .of_rest = false,
    .scale = &NaturalScales::velocity,
    .target = oneNumber,
    .read = readSpeed,
    .positive = true,
    .unit = "m/s",
};
const QuantityKind kKineticEnergy{
    .word = "kinetic_energy",
    .rows = 1,
    .numbers = 1,
    .all_or_nothing = true,
    .of_rest = false,
    .turns = true,
    .scale = &NaturalScales::specific_energy,
    .target = oneNumber,
    .read = readKineticEnergy,
    .by_mass = true,
    .positive = true,
    .from_another = false,
    .unit = "J",
};
const QuantityKind kImpulse{
    .word = "impulse",
    .rows = 1,
    .numbers = 1,
    .all_or_nothing = true,
    .only_at_events = true,
    .of_rest = false,
    .scale = &NaturalScales::velocity,
    .target = oneNumber,
    .read = readImpulse,
    .by_mass = true,
    .positive = true,
    .from_another = false,
    .unit = "N s",
};
const QuantityKind kContact{
    .word = "contact",
    .rows = 3,
    .numbers = 3,
    .only_at_events = true,
    .of_rest = false,
    .turns = true,
    .scale = &NaturalScales::length,
    .target = threeNumbers,
    .read = readContactPlace,
    .from_another = false,
    .unit = "m",
};
const QuantityKind kHeight{
    .word = "height",
    .rows = 1,
    .numbers = 1,
    .all_or_nothing = true,
    .turns = true,
    .scale = &NaturalScales::length,
    .target = oneNumber,
    .read = readHeight,
    .of_shape = true,
    .from_another = false,
    .unit = "m",
};

const QuantityKind kDistance{
    .word = "distance",
    .rows = 1,
    .numbers = 1,
    .all_or_nothing = true,
    .turns = true,
    .scale = &NaturalScales::length,
    .target = oneNumber,
    .read = readDistanceRow,
    .positive = true,
    .from_another = false,
    .unit = "m",
    .to_another = true,
};
const QuantityKind kClosestApproach{
    .word = "closest_approach",
    .rows = 1,
    .numbers = 1,
    .all_or_nothing = true,
    .turns = true,
    .scale = &NaturalScales::length,
    .target = oneNumber,
    .read = readClosestApproachRow,
    .positive = true,
    .from_another = false,
    .unit = "m",
    .to_another = true,
    .over_span = true,
};

const QuantityKind* const kQuantityTable[] = {&kPosition, &kOrientation, &kVelocity,      &kAngularVelocity,
                                              &kTime,     &kPoint,       &kSpeed,         &kKineticEnergy,
                                              &kImpulse,  &kContact,     &kHeight,        &kDistance,
                                              &kClosestApproach};

}  // namespace

std::span<const QuantityKind* const> quantityKinds() { return kQuantityTable; }

const QuantityKind* findQuantityKind(const std::string& word) {
  for (const QuantityKind* kind : kQuantityTable) {
    if (word == kind->word) return kind;
  }
  return nullptr;
}

}  // namespace carom::editing_detail
