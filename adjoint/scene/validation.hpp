// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>

#include "adjoint/scene/scene.h"

namespace carom::validation {

constexpr double kLargest = 1e9;         // collision detection and double precision both want magnitudes below this
constexpr double kLeastDivisor = 1e-150;  // of masses, densities and moments: derivatives divide by their squares
constexpr double kHeaviest = 1e60;  // kg, kg/m^3, kg m^2: cubes are finite, and scenes of micrometres or megametres fit

/// Place in the scene document, written as a JSON pointer only when a check fails. It points to the place around it,
/// which has to outlive it: `here / "size" / 0` inside a call, or every step a variable of its own.
class Place {
 public:
  Place() = default;
  friend Place operator/(const Place& around, const char* member) { return {&around, member, 0}; }
  friend Place operator/(const Place& around, const std::string& member) { return around / member.c_str(); }
  friend Place operator/(const Place& around, std::size_t index) { return {&around, nullptr, index}; }
  friend Place operator/(const Place& around, int index) { return around / static_cast<std::size_t>(index); }

  std::string pointer() const;

 private:
  Place(const Place* around, const char* member, std::size_t index) : around_(around), member_(member), index_(index) {}

  const Place* around_ = nullptr;
  const char* member_ = nullptr;
  std::size_t index_ = 0;
};

std::string text(double value);
std::string text(const Vec3& value);
[[noreturn]] void fail(const Place& where, const std::string& found, const std::string& expected);

void requireFinite(const Place& where, double value, double largest = kLargest);
void requireFinite(const Place& where, const Vec3& value);
void requireRange(const Place& where, double value, double lo, double hi);
void requirePositive(const Place& where, double value, double largest = kLargest);
/// A length of at least kLeastLength.
void requireLength(const Place& where, double value);
/// A mass (kg), a density or a moment of inertia that can be divided by, squared too, and is at most kHeaviest.
void requireDivisor(const Place& where, double value);
void requireUnit(const Place& where, const Quat& q);

/// Shape of a body, `where` being the body's place.
void validateShape(const Place& where, const Body& body);

}  // namespace carom::validation
