// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

namespace carom {

/// Arithmetic types that are no time in seconds when they are written for one: whatever takes a time refuses them as it is
/// compiled. An int is one.
template <class T>
concept NoTime = std::same_as<T, bool> || std::same_as<T, char> || std::same_as<T, signed char> ||
                 std::same_as<T, unsigned char> || std::same_as<T, wchar_t> || std::same_as<T, char8_t> ||
                 std::same_as<T, char16_t> || std::same_as<T, char32_t>;

/// A time or a duration in a struct, s: converts from and to a number of seconds. Neither a bool nor a character is one.
class Seconds {
 public:
  constexpr Seconds() = default;  ///< 0
  /// Of a number, be it an int.
  template <class T>
    requires(std::is_arithmetic_v<T> && !NoTime<T>)
  constexpr Seconds(T seconds) : value_(static_cast<double>(seconds)) {}  // NOLINT: for {.during = {{0.5, 1}}}
  constexpr operator double() const { return value_; }  ///< s

 private:
  double value_ = 0;
};
/// First and last time, s.
using TimeSpan = std::pair<Seconds, Seconds>;

}  // namespace carom
