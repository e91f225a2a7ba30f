// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit_options.h"
#include "editing/edit_result.h"
#include "editing/motion_function.h"
#include "editing/nail.h"

namespace carom {

namespace editing_detail {
struct EditProblem;
}

/// Finds the smallest weighted change of some numbers of a scene such that its motion meets constraints:
///   minimise 1/2 sum (w_i z_i)^2  subject to  rows = targets, physical validity and bounds,
/// with z_i the change of a number in units of its natural scale (logarithmic for mass and moments of inertia); or the
/// change that makes a function of the motion small.
/// Nothing is claimed that was not verified: the resulting scene is simulated afresh, and residuals are of that motion.
class Edit {
 public:
  /// Keeps `contacts` by reference, and uses it for all simulations.
  Edit(const Scene& scene, ContactSource& contacts, double duration);
  /// With controls and constraints that are there from the start.
  Edit(const Scene& scene, ContactSource& contacts, double duration, std::vector<Control> controls,
       std::vector<Constraint> constraints);
  Edit(const Edit&) = delete;  // nails refer to their edit
  Edit& operator=(const Edit&) = delete;

  /// Lets numbers vary: vary(velocity("hat"), elasticity("felt").within(0.2, 0.9)).
  template <class... Controls>
  Edit& vary(Controls... controls) {
    (controls_.push_back(std::move(controls)), ...);
    return *this;
  }
  /// A new nail of a body, which holds nothing yet.
  Nail nail(const std::string& body, When at);
  /// A body hits another one, as `hit` says: edit.hit("cue", {.with = "yellow", .during = {{0.5, 1}}}).
  Edit& hit(const std::string& body, Hit hit);
  /// The same at any time.
  Edit& hit(const std::string& body, const std::string& with);
  /// Impacts come in this order, see Constraint::sequence: edit.sequence({"cue red", "cue rail*", "...", "cue yellow"}).
  Edit& sequence(std::vector<std::string> impacts);
  /// Removes a nail.
  void unnail(const Nail& nail);

  /// Holds a function of the motion to a value, or within a range (SI, in its own unit): one more row, beside the nails.
  Edit& require(MotionFunction function, Wanted wanted);
  /// Minimises function/scale + change_weight 1/2 sum (w_i z_i)^2 in place of the change alone. What one wants large is
  /// made small with the other sign. Found is a minimum nearby, in the impact sequences that were looked at; without
  /// weight of the change, numbers that matter neither to it nor to the rows are where they happened to be left.
  Edit& minimise(MotionFunction function, double change_weight = 0);

  const std::vector<Control>& controls() const { return controls_; }  ///< what may vary
  std::vector<Constraint> constraints() const;                        ///< what the nails hold

  /// Throws InputError for bad input, and what functions of the motion throw; everything else is a status and a message.
  EditResult solve(const EditOptions& options = {}) const;
  /// The same controls and constraints as rows and derivatives, at the start; for the command.
  editing_detail::EditProblem problem() const;

 private:
  friend class Nail;
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
