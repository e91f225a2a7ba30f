// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "editing/certificate.h"
#include "editing/sequence_changes.h"
#include "editing/why_not.h"

namespace carom {

/// Outcome of an edit.
enum class EditStatus {
  solved,                   ///< verified, in the initial impact sequence
  solved_sequence_changed,  ///< verified, with another impact sequence
  infeasible,               ///< proven: no motion meets the constraints
  not_converged,            ///< iteration limit, or no progress
  out_of_time,              ///< time budget exhausted
  cancelled,  ///< by the progress callback or a stop request: the best point so far, see EditResult::met
  bad_start,  ///< a constraint cannot be evaluated in the initial motion: after its end, or a missing impact
};
/// The word in answers: "solved", "infeasible", ...
const char* nameOf(EditStatus status);

/// One control parameter.
struct ChangedNumber {
  int control = -1;       ///< index of the Control
  std::string name;       ///< "velocity.x of 'hat'"
  std::string component;  ///< "x"
  double before = 0;      ///< SI, initially
  double after = 0;       ///< SI, in the result
  /// Fraction of the objective: (w z)^2 / sum, 0 if nothing changed. With Edit::minimise likewise, independent of
  /// change_weight.
  double share = 0;
  /// Of a number fitted to soft constraints (EditResult::fit): SI, of their errors as independent and equally likely in
  /// natural scales over weights. Empty where it is not determined; Fit::message has the reason.
  std::optional<double> standard_deviation = std::nullopt;
};

/// One constrained quantity, in the verified motion.
struct ConstrainedNumber {
  int constraint = -1;                      ///< index of the Constraint; -1: a function of Edit::require
  std::string name;                         ///< "position.x of 'hat' at 1.4 s"
  std::string component;                    ///< "position.x"
  double value = 0; ///< SI; NaN if it cannot be evaluated
  double target = 0;                        ///< SI; NaN for a range
  double error = 0; ///< SI; NaN if it cannot be evaluated
  double scaled_error = 0;                  ///< dimensionless
  double lower = 0;                         ///< lower bound, SI; -infinity if none
  double upper = 0;                         ///< upper bound, SI; infinity if none
};

/// Time at which a constraint `between` two times is met, a body constrained at rest comes to rest, a required impact
/// happens or a required sequence is complete, in the verified motion.
struct MetTime {
  int constraint = -1;                ///< index of the Constraint
  std::string name;                   ///< "'hat' between 1 s and 2 s", "'die' at rest", "'cue' hits 'red'"
  double from = 0;     ///< s, start of the interval
  double to = 0;       ///< s, end of the interval; at rest and of impacts: of the motion
  double time = 0;     ///< s
};

/// A fit to soft constraints: r their errors in natural scales, W their weights.
struct Fit {
  int rows = 0;               ///< errors; 0: there are no soft constraints
  /// Independent ones that neither hard constraints nor bounds hold, and the times that the fit chooses within spans.
  int parameters = 0;
  double sum_of_squares = 0;  ///< |W r|^2; NaN if an error cannot be evaluated
  /// sqrt(|W r|^2 / (rows - parameters)): of one error W r, as estimated from all. Empty if there are no more errors than
  /// parameters.
  std::optional<double> deviation = std::nullopt;
  std::string message;  ///< not empty: why some or all numbers have no standard deviation
};

/// An alternative whose objective exceeds that of the result by this factor is much_dearer.
inline constexpr double kMuchDearer = 10;

/// Another solution of an edit, verified like the result itself.
struct EditAlternative {
  Scene scene;                                   ///< with its new values
  std::vector<ChangedNumber> changed;            ///< parameters that changed
  double objective = 0;                          ///< 1/2 sum (w_i z_i)^2, or that of Edit::minimise
  bool much_dearer = false;                      ///< its objective exceeds kMuchDearer times that of the result
  double residual = 0;                           ///< largest |error|, SI
  double scaled_residual = 0;                    ///< the same, dimensionless
  std::vector<std::string> sequence; ///< one line per impact
  std::vector<SequenceChange> sequence_changes;  ///< from the initial motion, as in EditResult
};

/// Result of an edit.
struct EditResult {
  EditStatus status = EditStatus::not_converged;  ///< outcome
  std::string message;  ///< what happened, in sentences
  bool met = false;     ///< verified: all constraints are met in `motion`, in a cancelled edit too
  Scene scene;          ///< with its new values: the best point found, whatever the status
  Motion motion;        ///< of that scene, simulated again
  std::vector<ChangedNumber> changed;  ///< all control parameters
  std::vector<ConstrainedNumber> residuals;   ///< all constrained quantities
  std::vector<ConstrainedNumber> soft_residuals;  ///< all quantities of soft constraints; not in `residual`
  Fit fit;                     ///< to soft constraints
  std::vector<MetTime> times;  ///< of constraints `between` two times, at rest, hits, sequences
  double residual = 0;         ///< largest |error| of that motion, SI (mixed units: m, m/s, rad, rad/s, s)
  double scaled_residual = 0;  ///< the same, dimensionless; compared with EditOptions::tolerance
  double objective = 0;        ///< 1/2 sum (w_i z_i)^2 + 1/2 |W r|^2 of soft constraints, or that of Edit::minimise
  int iterations = 0;          ///< of all stages together
  double milliseconds = 0;     ///< wall time
  std::vector<std::string> sequence_before;  ///< of the initial motion, one line per impact
  std::vector<std::string> sequence_after;   ///< of the result, one line per impact
  bool signature_changed = false;  ///< whether impacts that can affect the constraints (up to the last one) differ
  /// Differences of the impacts from those of the initial motion, over both motions; those of signature_changed are
  /// marked (SequenceChange::matters).
  std::vector<SequenceChange> sequence_changes;
  /// Further solutions, if EditOptions::alternatives asks for several: each with another impact sequence, or with
  /// clearly different parameters; by increasing objective, those much_dearer last.
  std::vector<EditAlternative> alternatives;
  Reliability reliability;  ///< of the derivatives at the result, worst row
  /// Growth of the initial motion (docs/equations.md section 10): amplification of small changes of the initial
  /// states in the constrained quantities, relative to free flight; 0 if not measured, because there was nothing to
  /// solve or rows are dependent.
  double growth = 0;
  Certificate certificate;  ///< of that motion
  WhyNot why_not;           ///< if the edit is infeasible or did not converge

  /// Verified, with any impact sequence, and not cancelled.
  bool solved() const { return status == EditStatus::solved || status == EditStatus::solved_sequence_changed; }
};

}  // namespace carom
