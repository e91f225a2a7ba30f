// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <stop_token>
#include <vector>

#include <Eigen/Core>

#include "adjoint/simulate/simulate.h"
#include "adjoint/simulate/simulate_along.h"
#include "editing/problem/controls/control_set.hpp"
#include "editing/problem/controls/validity_rows.hpp"
#include "editing/problem/rows/constraint_rows.hpp"
#include "editing/problem/rows/soft_terms.hpp"

/// The controls and constraints of an edit, bound to a scene, and its motions. Internal to editing/.
namespace carom::editing_detail {

/// Controls and constraints bound to a scene: what is varied, what is held, and what has to be simulated for it.
struct EditProblem {
  /// Throws InputError for a scene, controls or constraints that make no sense. `contacts` is kept by reference.
  EditProblem(const Scene& scene, ContactSource& contacts, double duration, const std::vector<Control>& controls,
              const std::vector<Constraint>& constraints, const OwnFunctions& own = {});

  ContactSource* contacts;
  ControlSet controls;
  SoftTerms soft;  ///< of the objective of `constraints`
  ConstraintSet constraints;
  ValidityRows validity;
  /// The unknowns of the edit: the changes of the controls, then the free times, t = from + y (scale).
  int unknowns() const { return controls.size() + times(); }
  int times() const { return static_cast<int>(constraints.freeTimes().size()); }
  Eigen::VectorXd valuesOf(const Eigen::VectorXd& unknowns) const;  ///< of the controls
  Eigen::VectorXd timesOf(const Eigen::VectorXd& unknowns) const;   ///< s
  Eigen::VectorXd unknownTimes(const Eigen::VectorXd& times) const;
  /// d(values, times)/d(unknowns), a diagonal.
  Eigen::VectorXd rates(const Eigen::VectorXd& unknowns) const;
  /// The derivative with respect to the changes of the controls, at some unknowns, from that with respect to scene parameters.
  Eigen::VectorXd byChanges(const SceneGradient& gradient, const Eigen::VectorXd& unknowns) const;
  Eigen::VectorXd lower() const;
  Eigen::VectorXd upper() const;
  /// 1/2 |changes of the controls|^2: the free times cost nothing.
  double change(const Eigen::VectorXd& unknowns) const;
  /// What is minimised: the change; or an objective of one's own by its scale, and the change as much as it weighs
  /// beside it. NaN where the rows do not have the objective.
  double objective(const Eigen::VectorXd& unknowns, const RowValues& rows) const;
  /// How much the change weighs in the objective.
  double changeWeight() const { return constraints.objective() ? change_weight : 1; }

  /// Whether the objective is a sum of squares: soft constraints, and the change.
  bool isLeastSquares() const { return !soft.empty() && !own_objective; }

  bool own_objective;        ///< the caller's own, whether or not there are soft constraints beside it
  double change_weight;      ///< beside an objective of one's own
  double duration;           ///< s, of the motion
  double horizon;            ///< s; nothing after it counts for the constraints
  /// Of motions that are tried: they end where nothing later counts for the constraints. Empty: at the horizon.
  std::function<bool(const Motion&)> stop_when;
  double least_duration = 0;  ///< s; then only after this, too
  std::vector<Asked> asked;  ///< as little as the rows and their derivatives need
  /// Of every motion, see SimulateOptions.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  std::stop_token stop;  ///< of motions that are tried; one that an answer is read from is simulated in any case
  std::stop_token abandon;  ///< of all of them: there will be no answer
  /// Throws EditAbandoned, by ThrownByUser, if that was requested.
  void leaveIfAbandoned() const;
  /// The same to be called within passes of derivatives (DerivativeTape); empty if it cannot be requested.
  std::function<void()> leaver() const;
};

/// From now on motions that are tried end where nothing later counts. The problem stays where it is in memory.
void endWhereNothingCounts(EditProblem& problem);

/// The motion of a scene of the problem, with everything that can be asked of it.
Motion simulateScene(const EditProblem& problem, const Scene& scene, double until);

/// How a motion is simulated.
struct Simulating {
  ContactSource* contacts = nullptr;  ///< null: that of the problem, which is for one thread at a time
  bool even_if_stopped = false;       ///< to the end although a stop was requested
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();  ///< beside that of the problem
  const Motion* baseline = nullptr;  ///< see SimulateOptions
  std::stop_token stop = {};         ///< in place of that of the problem, if it can be requested
  std::function<void(const SimulateProgress&)> progress = {};  ///< see SimulateOptions
};
/// Simulates up to a time, with no more detail than the problem asks for.
Motion simulateAt(const EditProblem& problem, const Eigen::VectorXd& values, double until, const Simulating& how = {});
/// The same along the impact sequence of another motion of the problem, see adjoint/simulate/simulate_along.h.
MotionAlong simulateAlong(const EditProblem& problem, const Eigen::VectorXd& values, const Motion& like, double until,
                          ContactSource* contacts = nullptr);

}  // namespace carom::editing_detail
