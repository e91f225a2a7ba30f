// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "editing/edit.h"
#include "python/src/derivatives.hpp"
#include "python/src/interruptible.hpp"

namespace carom::python {

/// An edit with what it keeps by reference.
class EditContent {
 public:
  EditContent(PyScene of, double duration, std::vector<Control> controls, std::vector<Constraint> constraints)
      : scene(std::move(of)),
        contacts(*scene.content),
        edit(scene.scene(), *contacts, duration, std::move(controls), std::move(constraints)) {}

  const PyScene scene;
  SceneContent::Contacts contacts;
  Edit edit;
  OneAtATime one;
  /// Functions of Python that the edit calls, which may refer to it: Python's collector has to see them.
  std::vector<std::shared_ptr<nb::object>> functions;
};

/// carom.Edit, and carom.Nail, which keeps its edit.
struct PyEdit {
  std::shared_ptr<EditContent> content;
};
struct PyNail {
  std::shared_ptr<EditContent> content;
  Nail nail;
  std::string text;  ///< "'ball', impact 2"
};

/// An argument for one component: None is free, a pair a range with an open side for None.
using WantedArgument =
    std::optional<std::variant<double, Wanted, std::pair<std::optional<double>, std::optional<double>>>>;
/// Throws InputError for NaN, which would mean free.
Wanted wantedOf(const WantedArgument& argument, const char* where);

/// An argument for a moment: a time, s, or a When.
using WhenArgument = std::variant<double, When>;
When whenOf(const WhenArgument& argument);
std::string whenText(const When& when);  ///< "at rest", "0.5 s"

/// Throws TypeError for what is no control.
std::vector<Control> controlsIn(const nb::args& arguments);

/// First and last second of an interval.
using Interval = std::optional<std::pair<double, double>>;

void bindControls(nb::module_& module);
void bindMoments(nb::module_& module);
void bindNails(nb::module_& module);
void bindEdits(nb::module_& module);
void bindSolve(nb::class_<PyEdit>& edit, nb::module_& module);
void bindMotionFunctions(nb::module_& module, nb::class_<PyEdit>& edit);
void bindEvaluator(nb::module_& module, nb::class_<PyEdit>& edit);
void bindEditResults(nb::module_& module);

/// carom.EditResult.
struct PyEditResult {
  EditResult result;  ///< without its motion
  PyScene scene;
  PyMotion motion;
  PyScene before;  ///< what was edited
};

}  // namespace carom::python
