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
  Scene scene;                           ///< as written
  double duration = 1;  ///< s
  std::vector<Control> controls;         ///< what may change
  std::vector<Constraint> constraints;   ///< what is held
  std::string folder;                 ///< that file names in the scene are relative to; empty: the current folder
  std::string name = {};              ///< for people; nothing is computed from it
  std::string notes = {};             ///< for people, too
  std::string schema = {};            ///< member "$schema", where an editor finds the schema; never opened here
};

}  // namespace carom
