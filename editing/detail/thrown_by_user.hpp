// SPDX-License-Identifier: MIT
#pragma once

#include <exception>
#include <utility>

namespace carom::editing_detail {

/// What a function of the caller threw, or what is wrong with what it returned, on its way out of a solve: nothing on the
/// way takes it for a point that cannot be evaluated.
struct ThrownByUser {
  std::exception_ptr thrown;
};

/// Calls a function of the caller.
template <class Call>
auto guarded(Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const ThrownByUser&) {
    throw;
  } catch (...) {
    throw ThrownByUser{std::current_exception()};
  }
}

}  // namespace carom::editing_detail
