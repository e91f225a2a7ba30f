// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "adjoint/base/types.h"
#include "adjoint/base/work_count.h"
#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "adjoint/scene/scene.h"
#include "adjoint/second_order/second_order.h"

namespace carom {

class Edit;
class NlpPoint;

namespace editing_detail {
struct EditProblem;
struct NlpState;
struct NlpReading;
}

/// A variable of an edit as a nonlinear program: a control parameter, or the time of a constraint `between` two times.
struct NlpVariable {
  std::string name;       ///< "velocity.x of 'hat'", "time of 'hat' between 1 s and 2 s"
  std::string component;  ///< "x", "value"; of a time "time"
  int control = -1;       ///< index of its Control; -1: a time
  int constraint = -1;    ///< of a time: index of its Constraint; else -1
  /// SI: of the scene, moved into the bounds; of a time where its constraint is most nearly met in that motion.
  double start = 0;
  double lower = -kInfinity;  ///< lower bound, SI
  double upper = kInfinity;   ///< upper bound, SI
  /// SI: natural scale of a change at the start, over the weight of the control; of a time that of the body.
  double scale = 1;
  /// What its change costs, z^2 / 2: z = log(x / start) start / scale; otherwise z = (x - start) / scale. Times cost
  /// nothing.
  bool logarithmic = false;
};

/// A row of an edit as a nonlinear program: lower <= value <= upper; an equation has equal bounds. After the rows of
/// constraints and of Edit::require come those of physical validity: triangle inequalities of moments of inertia, cones
/// of tilts.
struct NlpRow {
  std::string name;           ///< "position.x of 'hat' at 1.4 s"
  int constraint = -1;        ///< index of its Constraint; -1: of Edit::require, or validity
  int control = -1;           ///< of validity: index of its Control; else -1
  double lower = -kInfinity;  ///< SI; of validity a little above 0, so that rounding leaves it valid
  double upper = kInfinity;   ///< SI
  double scale = 1;           ///< natural scale of the value, SI
};

/// First derivatives of all rows.
struct NlpJacobian {
  Eigen::MatrixXd entries;               ///< rows x variables, SI by SI
  std::vector<Reliability> reliability;  ///< of each row
};

/// First derivatives of the objective.
struct NlpGradient {
  Eigen::VectorXd entries;  ///< one per variable, by SI
  Reliability reliability;  ///< of an objective of Edit::minimise
};

/// An edit as a nonlinear program, for solvers other than Edit::solve:
///   minimise objective(x)  subject to  lower <= rows(x) <= upper  and the bounds of the variables,
/// with x in SI: one number per control parameter, then one per constraint `between` two times. Within one impact
/// sequence (NlpPoint::signature) all of it is smooth; where the sequence changes, rows may jump. Edit::evaluator makes it.
///
/// Thread-safe: points may be evaluated in several threads at a time (one after the other if the contact source has no
/// ContactSource::another). Independent of its Edit; it keeps the contact source by reference only in that case.
class NlpEvaluator {
 public:
  const std::vector<NlpVariable>& variables() const;  ///< x, in this order
  const std::vector<NlpRow>& rows() const;            ///< rows, in this order
  Eigen::VectorXd start() const;                      ///< NlpVariable::start of all variables
  Eigen::VectorXd lower() const;                      ///< lower bounds of all variables
  Eigen::VectorXd upper() const;                      ///< upper bounds of all variables

  /// Simulates the scene with these values, up to where nothing later counts, and reads all rows. Throws InputError if
  /// x has another size or a number that is not finite, and what functions of the motion throw; a point that cannot be
  /// evaluated says why (NlpPoint::available), as does one whose simulation was stopped. `stop` and `progress` are those
  /// of the simulation (SimulateOptions).
  NlpPoint at(const Eigen::VectorXd& x, std::stop_token stop = {},
              const std::function<void(const SimulateProgress&)>& progress = {}) const;
  /// The scene with these values of its parameters. Throws InputError like `at`.
  Scene sceneAt(const Eigen::VectorXd& x) const;

 private:
  friend class Edit;
  NlpEvaluator(const editing_detail::EditProblem& problem, std::size_t step_limit);
  std::shared_ptr<editing_detail::NlpState> state_;
};

/// One evaluated point of an NlpEvaluator: immutable, safe to read from several threads; derivatives are computed at
/// every call. Functions throw NotComputable, with the reason, if the point is not available or the derivative does not
/// exist in doubles, and InputError for arguments of the wrong size.
class NlpPoint {
 public:
  const Eigen::VectorXd& x() const;  ///< the variables

  /// Whether all rows and the objective exist: the scene is valid and the motion has all that they read.
  bool available() const;
  /// Why not, in a sentence; empty if available.
  const std::string& message() const;
  /// The motion, simulated as far as something counts. Throws NotComputable if the scene could not be simulated.
  const Motion& motion() const;
  /// The impact sequence as far as it counts: derivatives relate points with equal signatures.
  std::string signature() const;

  const Eigen::VectorXd& values() const;  ///< of all rows, SI
  /// What the edit minimises: 1/2 sum (w_i z_i)^2, or that of Edit::minimise.
  double objective() const;

  NlpGradient gradient() const;   ///< of the objective, by one reverse pass
  NlpJacobian jacobian() const;   ///< of all rows, by one reverse pass each

  /// Whether second derivatives are implemented for this motion and all rows (hasSecondOrder,
  /// RowReading::second_order).
  bool hasHessian() const;
  /// Second derivatives of objective_weight * objective + row_weights . rows: exact and symmetric. NotComputable
  /// without hasHessian, unless what has none has the weight 0.
  Eigen::MatrixXd hessian(double objective_weight, const Eigen::VectorXd& row_weights) const;
  /// The product of that matrix with a direction, for the cost of some reverse passes.
  Eigen::VectorXd hessianTimes(double objective_weight, const Eigen::VectorXd& row_weights,
                               const Eigen::VectorXd& direction) const;

 private:
  friend class NlpEvaluator;
  explicit NlpPoint(std::shared_ptr<const editing_detail::NlpReading> reading) : reading_(std::move(reading)) {}
  Eigen::MatrixXd secondDerivatives(double objective_weight, const Eigen::VectorXd& row_weights,
                                    const Eigen::MatrixXd& directions, RatesWanted wanted) const;
  std::shared_ptr<const editing_detail::NlpReading> reading_;
};

}  // namespace carom
