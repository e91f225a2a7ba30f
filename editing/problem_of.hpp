// SPDX-License-Identifier: MIT
#pragma once

#include "editing/problem/edit_problem.hpp"

namespace carom {
class Edit;
}

/// The parts of an edit. Internal to carom.
namespace carom::editing_detail {

/// Rows and derivatives of the controls and constraints of an edit.
EditProblem problemOf(const Edit& edit);

}  // namespace carom::editing_detail
