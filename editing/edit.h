// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "editing/certificate.h"
#include "editing/constraint.h"
#include "editing/control.h"
#include "editing/jacobian.h"
#include "editing/nail.h"
#include "editing/sequence_changes.h"
#include "editing/why_not.h"

namespace carom {

enum class EditStatus {
  solved,                   ///< verified, in the impact sequence of the start
  solved_sequence_changed,  ///< verified, but other impacts than before happen on the way
  infeasible,               ///< the constraints cannot all be met, or no way was found from anywhere that was tried
  not_converged,            ///< the limit of iterations, or no progress
  out_of_time,
  cancelled,  ///< by the progress callback, or a stop was requested
  bad_start,  ///< a constraint that the start's motion does not have: after its end, an impact not there
};
const char* nameOf(EditStatus status);

/// May an edit change which impacts happen?
enum class SequencePolicy {
  prefer_start,  ///< only where the start's sequence does not reach the constraints
  stay,          ///< never
};

struct EditProgress {
  int iteration = 0;
  double objective = 0;
  double violation = 0;  ///< dimensionless
};

/// How a motion with many impacts is taken.
enum class Shooting {
  automatic,  ///< whole, but in segments where small changes grow too far over it
  single,     ///< whole, from its start
  multiple,   ///< in segments, wherever there is a flight to cut
};

/// Where Ipopt takes the second derivatives of the rows from.
enum class SecondDerivatives {
  exact,          ///< adjoint/second_order/second_order.h
  secant,         ///< learnt from the gradients, row by row
  limited_memory  ///< Ipopt's own approximation
};

struct EditOptions {
  int max_iterations = 200;  ///< steps of all stages together; the one under way may add a few
  double time_budget_seconds = std::numeric_limits<double>::infinity();
  double tolerance = 1e-9;  ///< of every row, dimensionless (docs/equations.md section 6)
  SequencePolicy sequence = SequencePolicy::prefer_start;
  Shooting shooting = Shooting::automatic;
  SecondDerivatives second_derivatives = SecondDerivatives::exact;
  int alternatives = 1;  ///< distinct solutions that are looked for, see EditResult::alternatives
  int threads = 0;       ///< of the search across impact sequences; 0: all cores. The answer does not depend on it
  bool certify = true;   ///< fill in EditResult::certificate
  /// Of each motion, see SimulateOptions::step_limit: a point whose motion ends before its constraints is not taken.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  /// Once a stop is requested, from any thread, the edit ends with EditStatus::cancelled and the best that it has.
  std::stop_token stop;
  bool explain = true;   ///< fill in EditResult::why_not where the edit is infeasible or does not converge
  std::function<bool(const EditProgress&)> progress;  ///< false cancels; must not solve an edit itself
};

/// One number that was free to change.
struct ChangedNumber {
  int control = -1;       ///< index of the Control
  std::string name;       ///< "velocity.x of 'hat'"
  std::string component;  ///< "x"
  double before = 0, after = 0;
};

/// One number that was held, in the verified motion.
struct HeldNumber {
  int constraint = -1;                      ///< index of the Constraint
  std::string name;                         ///< "position.x of 'hat' at 1.4 s"
  std::string component;                    ///< "position.x"
  double value = 0, target = 0, error = 0;  ///< SI; NaN where the motion does not have it
  double scaled_error = 0;                  ///< dimensionless
  /// Allowed values, SI, infinite on a side that is open; `target` is NaN where they are a range, else equal to both.
  double lower = 0, upper = 0;
};

/// When a constraint at some time of a span is met, in the verified motion.
struct MetTime {
  int constraint = -1;                ///< index of the Constraint
  std::string name;                   ///< "'hat' between 1 s and 2 s"
  double from = 0, to = 0, time = 0;  ///< s
};

/// Another solution of an edit, simulated afresh like the result itself.
struct EditAlternative {
  Scene scene;
  std::vector<ChangedNumber> changed;
  double objective = 0;
  double residual = 0, scaled_residual = 0;
  std::vector<std::string> sequence;             ///< one line an impact
  std::vector<SequenceChange> sequence_changes;  ///< from the start's
};

struct EditResult {
  EditStatus status = EditStatus::not_converged;
  std::string message;  ///< what happened, in sentences
  Scene scene;          ///< with its new values: the best that was found, whatever the status
  Motion motion;        ///< of that scene, simulated afresh
  std::vector<ChangedNumber> changed;
  std::vector<HeldNumber> residuals;
  std::vector<MetTime> times;  ///< one for each constraint `between` two times
  double residual = 0;         ///< largest |error| of that motion, SI (m, m/s, rad, rad/s, s mixed)
  double scaled_residual = 0;  ///< the same, dimensionless: this is compared with EditOptions::tolerance
  double objective = 0;        ///< 1/2 sum (w_i z_i)^2
  int iterations = 0;
  double milliseconds = 0;
  std::vector<std::string> sequence_before, sequence_after;  ///< one line an impact
  bool signature_changed = false;  ///< impacts that can matter to the constraints (up to the last one) are others
  std::vector<SequenceChange> sequence_changes;  ///< which of them came, went, or moved to another feature
  /// Solutions besides this one, where EditOptions::alternatives asks for several: each of another impact sequence, or
  /// else clearly of other numbers; the smallest change first.
  std::vector<EditAlternative> alternatives;
  Reliability reliability;  ///< of the derivatives at the result, worst row
  /// How much further the held numbers move with a small change of the start's states than in a free flight as long,
  /// at the start of the edit; 0 where it was not measured (Shooting::single, or nothing to solve).
  double growth = 0;
  int segments = 0;         ///< that the motion was cut into (multiple shooting); 0: it was taken whole
  Certificate certificate;  ///< of that motion
  WhyNot why_not;           ///< where the edit is infeasible or did not converge

  bool solved() const { return status == EditStatus::solved || status == EditStatus::solved_sequence_changed; }
};

/// Finds the smallest weighted change of some numbers of a scene such that its motion meets constraints:
///   minimise 1/2 sum (w_i z_i)^2  subject to  rows = targets, physical validity and bounds,
/// with z_i the change of a number in units of its natural scale (logarithmic for mass and moments of inertia).
/// Nothing is claimed that was not verified: the resulting scene is simulated afresh, and residuals are of that motion.
class Edit {
 public:
  /// Keeps `contacts` by reference, and uses it for all simulations.
  Edit(const Scene& scene, ContactSource& contacts, double duration);
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
  Nail nail(const std::string& body, When at);
  void unnail(const Nail& nail);

  const std::vector<Control>& controls() const { return controls_; }
  std::vector<Constraint> constraints() const;

  /// Throws InputError for bad input; everything else is a status and a message.
  EditResult solve(const EditOptions& options = {}) const;
  /// The same controls and constraints as rows and derivatives, at the start.
  EditProblem problem() const;

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
