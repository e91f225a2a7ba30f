// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>

namespace carom {

/// Arithmetic types that are no time in seconds when they are written for one: whatever takes a time refuses them as it is
/// compiled. An int is one.
template <class T>
concept NoTime = std::same_as<T, bool> || std::same_as<T, char> || std::same_as<T, signed char> ||
                 std::same_as<T, unsigned char> || std::same_as<T, wchar_t> || std::same_as<T, char8_t> ||
                 std::same_as<T, char16_t> || std::same_as<T, char32_t>;

}  // namespace carom
