// SPDX-License-Identifier: MIT
#include "editing/edit_result.h"

namespace carom {

const char* nameOf(EditStatus status) {
  constexpr const char* kNames[] = {
      "solved", "solved_sequence_changed", "infeasible", "not_converged", "out_of_time", "cancelled", "bad_start"};
  return kNames[static_cast<int>(status)];
}

}  // namespace carom
