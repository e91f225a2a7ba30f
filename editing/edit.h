// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/edit_options.h"
#include "editing/edit_result.h"
#include "editing/nail.h"

namespace carom {

namespace editing_detail {
class EditProblem;
}

/// Finds the smallest weighted change of some numbers of a scene such that its motion meets constraints:
///   minimise 1/2 sum (w_i z_i)^2  subject to  rows = targets, physical validity and bounds,
/// with z_i the change of a number in units of its natural scale (logarithmic for mass and moments of inertia).
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
  /// Removes a nail.
  void unnail(const Nail& nail);

  const std::vector<Control>& controls() const { return controls_; }  ///< what may vary
  std::vector<Constraint> constraints() const;                        ///< what the nails hold

  /// Throws InputError for bad input; everything else is a status and a message.
  EditResult solve(const EditOptions& options = {}) const;
  /// The same controls and constraints as rows and derivatives, at the start; for the command.
  editing_detail::EditProblem problem() const;

 private:
  friend class Nail;
  struct Nailed {
    int id;
    Constraint constraint;
  };

  Scene scene_;
  ContactSource& contacts_;
  double duration_;
  std::vector<Control> controls_;
  std::vector<Nailed> nails_;
  int next_id_ = 0;
};

}  // namespace carom
