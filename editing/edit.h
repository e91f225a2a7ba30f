// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit_options.h"
#include "editing/edit_result.h"
#include "editing/motion_function.h"
#include "editing/nail.h"
#include "editing/nlp_evaluator.h"

namespace carom {

class Edit;
namespace editing_detail {
struct EditProblem;
EditProblem problemOf(const Edit& edit);
}

/// Finds the smallest weighted change of scene parameters such that the motion meets constraints:
///   minimise 1/2 sum (w_i z_i)^2  subject to  rows = targets, physical validity and bounds,
/// with z_i the change of a parameter in units of its natural scale (logarithmic for mass and moments of inertia); or
/// minimises a function of the motion. The result is verified: the resulting scene is simulated again, and residuals
/// are those of that motion. An edit has a name: nails refer to it, so what adds to one does not compile for a temporary.
class Edit {
 public:
  /// Keeps `contacts` by reference, and uses it for all simulations.
  Edit(const Scene& scene, ContactSource& contacts, double duration);
  /// With initial controls and constraints.
  Edit(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
       std::vector<Constraint> constraints);
  /// A duration is in seconds, no bool and no character.
  template <NoTime T>
  Edit(const Scene& scene, ContactSource& contacts, T duration) = delete;
  /// The same.
  template <NoTime T>
  Edit(const Scene& scene, ContactSource& contacts, T duration, std::vector<Control> controls,
       std::vector<Constraint> constraints) = delete;
  Edit(const Edit&) = delete;  // nails refer to their edit
  Edit& operator=(const Edit&) = delete;

  /// Adds controls: vary(velocity("hat"), elasticity("felt").within(0.2, 0.9)).
  template <class... Controls>
  Edit& vary(Controls... controls) & {
    (controls_.push_back(std::move(controls)), ...);
    return *this;
  }
  /// Adds a nail (a constraint) of a body, without targets yet.
  Nail nail(const std::string& body, When at) &;
  /// Requires that a body hits another one: edit.hit("cue", {.with = "yellow", .during = {{0.5, 1}}}).
  Edit& hit(const std::string& body, Hit hit) &;
  /// The same at any time.
  Edit& hit(const std::string& body, const std::string& with) &;
  /// Requires this impact sequence, see Constraint::sequence: edit.sequence({"cue red", "cue rail*", "...", "cue
  /// yellow"}).
  Edit& sequence(std::vector<std::string> impacts) &;
  /// Removes a nail.
  void unnail(const Nail& nail);

  /// Constrains a function of the motion to a value or a range (SI, in its own unit): one row in addition to the
  /// nails.
  Edit& require(MotionFunction function, Wanted wanted) &;
  /// Minimises function/scale + change_weight 1/2 sum (w_i z_i)^2 instead of the change alone; to maximise, negate
  /// the function. Finds a local minimum in the impact sequences that were searched; with change_weight 0, parameters
  /// that affect neither the function nor the rows are unspecified.
  Edit& minimise(MotionFunction function, double change_weight = 0) &;

  const std::vector<Control>& controls() const { return controls_; }  ///< parameters that may vary
  std::vector<Constraint> constraints() const;                        ///< those of the nails

  /// Throws InputError for invalid input, and what functions of the motion throw; everything else is a status and a
  /// message.
  EditResult solve(const EditOptions& options = {}) const;
  /// The same edit as a nonlinear program, for a solver of your own. `step_limit` is of each motion
  /// (SimulateOptions::step_limit). Throws as `solve` does.
  NlpEvaluator evaluator(std::size_t step_limit = std::numeric_limits<std::size_t>::max()) const;

 private:
  friend class Nail;
  friend editing_detail::EditProblem editing_detail::problemOf(const Edit& edit);
  EditResult solved(const EditOptions& options) const;
  struct Nailed {
    int id;
    Constraint constraint;
  };

  Scene scene_;
  ContactSource& contacts_;
  double duration_;
  std::vector<Control> controls_;
  std::vector<Nailed> nails_;
  std::vector<std::pair<MotionFunction, Wanted>> required_;
  std::optional<MotionFunction> minimised_;
  double change_weight_ = 0;
  int next_id_ = 0;
};

}  // namespace carom
