// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"

namespace carom {

/// A scene document: the scene, how long it is simulated, and the edit asked for.
struct Document {
  Scene scene;
  double duration = 1;  ///< s
  std::vector<Control> controls;
  std::vector<Constraint> constraints;
  std::string folder;                 ///< that file names in the scene are relative to; empty: the current folder
  std::string name = {}, notes = {};  ///< for people; nothing is computed from them
  std::string schema = {};            ///< member "$schema", where an editor finds the schema; never opened here
};

}  // namespace carom
