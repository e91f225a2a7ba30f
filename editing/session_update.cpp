// SPDX-License-Identifier: MIT
#include "editing/session_update.h"

#include "adjoint/base/names.hpp"

namespace carom {

using namespace adjoint_detail;

const char* nameOf(SessionStage stage) {
  return nameIn({"kept", "predicted", "improved", "solved"}, stage);
}

const char* nameOf(SessionObstacle::Kind kind) {
  return nameIn({"none", "no_control_moves_it", "nails", "bounds", "border", "work", "clock"}, kind);
}

}  // namespace carom
