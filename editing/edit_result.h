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
  /// at the start of the edit; 0 where it was not measured: there was nothing to solve, or rows stand against each other.
  double growth = 0;
  Certificate certificate;  ///< of that motion
  WhyNot why_not;           ///< where the edit is infeasible or did not converge

  bool solved() const { return status == EditStatus::solved || status == EditStatus::solved_sequence_changed; }
};

}  // namespace carom
