// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "editing/certificate.h"
#include "editing/sequence_changes.h"
#include "editing/why_not.h"

namespace carom {

/// How an edit ended.
enum class EditStatus {
  solved,                   ///< verified, in the impact sequence of the start
  solved_sequence_changed,  ///< verified, but other impacts than before happen on the way
  infeasible,               ///< it is proven that no motion meets the constraints
  not_converged,            ///< the limit of iterations, or no progress
  out_of_time,              ///< the time budget was used up
  cancelled,  ///< by the progress callback, or a stop was requested: the best so far, see EditResult::met
  bad_start,  ///< a constraint that the start's motion does not have: after its end, an impact not there
};
/// The word of the answers: "solved", "infeasible", ...
const char* nameOf(EditStatus status);

/// One number that was free to change.
struct ChangedNumber {
  int control = -1;       ///< index of the Control
  std::string name;       ///< "velocity.x of 'hat'"
  std::string component;  ///< "x"
  double before = 0;      ///< SI, at the start
  double after = 0;       ///< SI, in the result
  /// Of what all changes cost: (w z)^2 over the sum of them, 0 where nothing changed. With Edit::minimise too, whatever
  /// the change weighs beside the function.
  double share = 0;
};

/// One number that was held, in the verified motion.
struct HeldNumber {
  int constraint = -1;                      ///< index of the Constraint; -1: a function of Edit::require
  std::string name;                         ///< "position.x of 'hat' at 1.4 s"
  std::string component;                    ///< "position.x"
  double value = 0;                         ///< SI; NaN where the motion does not have it
  double target = 0;                        ///< SI; NaN where a range is allowed
  double error = 0;                         ///< SI; NaN where the motion does not have it
  double scaled_error = 0;                  ///< dimensionless
  double lower = 0;                         ///< least allowed value, SI; -infinity where it is open
  double upper = 0;                         ///< greatest allowed value, SI; infinity where it is open
};

/// When a constraint at some time of a span is met, or a body that is held at rest comes to rest, in the verified
/// motion.
struct MetTime {
  int constraint = -1;                ///< index of the Constraint
  std::string name;                   ///< "'hat' between 1 s and 2 s", "'die' at rest"
  double from = 0;     ///< s, begin of the span
  double to = 0;       ///< s, end of the span; at rest: of the motion
  double time = 0;     ///< s, when it is met
};

/// An alternative that costs more than this many times the result is much dearer.
inline constexpr double kMuchDearer = 10;

/// Another solution of an edit, simulated afresh like the result itself.
struct EditAlternative {
  Scene scene;                                   ///< with its new values
  std::vector<ChangedNumber> changed;            ///< what differs from the start
  double objective = 0;                          ///< 1/2 sum (w_i z_i)^2, or what Edit::minimise says
  bool much_dearer = false;                      ///< its changes cost more than kMuchDearer times those of the result
  double residual = 0;                           ///< largest |error|, SI
  double scaled_residual = 0;                    ///< the same, dimensionless
  std::vector<std::string> sequence;             ///< one line an impact
  std::vector<SequenceChange> sequence_changes;  ///< from the start's, as in EditResult
};

/// What came of an edit.
struct EditResult {
  EditStatus status = EditStatus::not_converged;  ///< how it ended
  std::string message;  ///< what happened, in sentences
  bool met = false;     ///< verified: all constraints are met in `motion`, in a cancelled edit too
  Scene scene;          ///< with its new values: the best that was found, whatever the status
  Motion motion;        ///< of that scene, simulated afresh
  std::vector<ChangedNumber> changed;  ///< all numbers that were free to change
  std::vector<HeldNumber> residuals;   ///< all numbers that were held
  std::vector<MetTime> times;  ///< one for each constraint `between` two times or at rest
  double residual = 0;         ///< largest |error| of that motion, SI (m, m/s, rad, rad/s, s mixed)
  double scaled_residual = 0;  ///< the same, dimensionless: this is compared with EditOptions::tolerance
  double objective = 0;        ///< 1/2 sum (w_i z_i)^2, or what Edit::minimise says
  int iterations = 0;          ///< steps of all stages together
  double milliseconds = 0;     ///< that it took
  std::vector<std::string> sequence_before;  ///< of the start, one line an impact
  std::vector<std::string> sequence_after;   ///< of the result, one line an impact
  bool signature_changed = false;  ///< impacts that can matter to the constraints (up to the last one) are others
  /// How the impacts differ from those of the start, from begin to end of both motions; those of signature_changed
  /// are marked (SequenceChange::matters).
  std::vector<SequenceChange> sequence_changes;
  /// Solutions besides this one, where EditOptions::alternatives asks for several: each of another impact sequence, or
  /// else clearly of other numbers; the smallest objective first, but what is much dearer last.
  std::vector<EditAlternative> alternatives;
  Reliability reliability;  ///< of the derivatives at the result, worst row
  /// How much further the held numbers move with a small change of the start's states than in a free flight as long,
  /// at the start of the edit; 0 where it was not measured: there was nothing to solve, or rows stand against each other.
  double growth = 0;
  Certificate certificate;  ///< of that motion
  WhyNot why_not;           ///< where the edit is infeasible or did not converge

  /// Verified, whatever the sequence, and not cancelled: it ended by itself.
  bool solved() const { return status == EditStatus::solved || status == EditStatus::solved_sequence_changed; }
};

}  // namespace carom
