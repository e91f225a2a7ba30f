// SPDX-License-Identifier: MIT
#include "editing/edit_result.h"

#include "adjoint/base/names.hpp"

namespace carom {

using namespace adjoint_detail;

const char* nameOf(EditStatus status) {
  return nameIn(
      {"solved", "solved_sequence_changed", "infeasible", "not_converged", "out_of_time", "cancelled", "bad_start"},
      status);
}

}  // namespace carom
