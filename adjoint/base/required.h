// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <utility>

namespace carom {

/// A function that every row of a table must provide. Unlike a pointer it is never null: a row without it does not
/// compile.
template <class Signature>
class Required;

/// From its result and its arguments.
template <class Result, class... Arguments>
class Required<Result(Arguments...)> {
 public:
  /// From a function, or a lambda without captures.
  template <class Function>
    requires(std::convertible_to<Function, Result (*)(Arguments...)> && !std::same_as<Function, std::nullptr_t>)
  constexpr Required(Function function) : function_(function) {}

  /// Calls it.
  Result operator()(Arguments... arguments) const { return function_(std::forward<Arguments>(arguments)...); }

 private:
  Result (*function_)(Arguments...);
};

}  // namespace carom
