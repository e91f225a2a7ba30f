// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace carom::test {

/// What became of one case that did not go well.
struct CaseFailure {
  std::size_t index = 0;
  std::string what;
};

/// Runs cases 0 to count - 1 in a child process, one after another. A case gives a sentence where something is wrong
/// with it, and else nothing; one that ends the process, or uses more than `cpu_seconds`, is a failure too, and the
/// next ones run in another child. `longest` is the most that any one used, s.
std::vector<CaseFailure> runIsolated(std::size_t count, const std::function<std::string(std::size_t)>& run,
                                     unsigned cpu_seconds, double* longest = nullptr);

}  // namespace carom::test
