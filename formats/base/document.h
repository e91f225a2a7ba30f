// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/scene/scene.h"
#include "editing/constraint.h"
#include "editing/control.h"

namespace carom {

/// What was changed of a mesh file as it was read, so that it bounds a solid or a sheet.
struct FileRepair {
  std::string file;  ///< as errors name it
  std::string what;  ///< a phrase: "2 triangles with corners on one line dropped (the first at line 12)"
};

/// A scene document: the scene, its duration, and an edit.
struct Document {
  Scene scene;                           ///< as in the document
  Seconds duration = 1;                  ///< s
  std::vector<Control> controls;         ///< parameters that may change
  std::vector<Constraint> constraints;   ///< of the edit
  std::string folder;                 ///< to which file names in the scene are relative; empty: the current folder
  std::string name = {};              ///< for readers; affects no result
  std::string notes = {};             ///< for readers
  std::string schema = {};            ///< member "$schema", where an editor finds the schema; never opened here
  std::vector<FileRepair> repairs = {};  ///< of the mesh files that it names; not written
};

}  // namespace carom
