// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/edit_options.h"
#include "editing/problem/edit_problem.hpp"
#include "editing/solve/budget.hpp"

/// Points of an edit and their evaluation. Internal to editing/.
namespace carom::editing_detail {

/// An impact that is held may come later than at the start: so much of its time is simulated at first.
inline constexpr double kMarginAfterLast = 1.25;

/// One evaluated point of an edit.
struct EditPoint {
  Eigen::VectorXd changes;  ///< all unknowns: of the controls, then of the free times
  Eigen::VectorXd values;   ///< of the controls
  Motion motion;            ///< a little further than the constraints reach
  RowValues rows;
  std::string signature;     ///< of the events that count
  Eigen::VectorXd validity;  ///< h >= 0
  double violation = 0;      ///< largest scaled residual or lack of validity
  double objective = 0;      ///< what is minimised: EditProblem::objective
  std::optional<Eigen::VectorXd> objective_gradient;  ///< of an objective of one's own, without the change; on demand
  std::optional<Eigen::MatrixXd> row_jacobian, validity_jacobian;  ///< with respect to all unknowns, dimensionless; on demand
  std::string not_computable;  ///< why there are no derivatives of the rows; their Jacobian is not a number then
};
using EditPointPtr = std::shared_ptr<EditPoint>;

/// How the motion of a point is made.
struct MotionMaker {
  Simulating how;
  EditPointPtr like = nullptr;  ///< not null: its impact sequence is followed (adjoint/simulate/simulate_along.h)
  bool keep_lacking = false;    ///< motions that lack impacts, which rows wait for, are points too
};

/// Simulates up to a time and reads the rows. `nearest_times`: the free times of `unknowns` do not count, they are
/// chosen afresh. Throws InputError for a scene that makes no sense; null where a sequence cannot be followed.
EditPointPtr pointAt(const EditProblem& problem, const Eigen::VectorXd& unknowns, double until, bool nearest_times,
                     const MotionMaker& maker = {});
/// The same for a trial: null where the scene makes no sense (bodies overlap, moments are impossible) or a row is not
/// available, not even up to the horizon of the problem.
EditPointPtr trialAt(const EditProblem& problem, const Eigen::VectorXd& unknowns, double until, bool nearest_times,
                     const MotionMaker& maker = {});
/// Reads the rows of a point's motion again, when targets are other ones than before.
void readRows(const EditProblem& problem, EditPoint& point);
/// Of the motion of a trial, see SimulateOptions::step_limit: so many times those of the start.
std::size_t mostStepsBeside(const EditPoint& start);
/// Fills in the point's derivatives. False where they cannot be computed: no step can be made from there.
bool differentiate(const EditProblem& problem, EditPoint& point);
/// Fills in that of an objective of one's own, with respect to all unknowns.
void differentiateObjective(const EditProblem& problem, EditPoint& point);

/// Evaluates points of one edit, caches the last few, remembers the best, and watches the clock and the callback.
class EditEvaluator {
 public:
  EditEvaluator(const EditProblem& problem, const EditOptions& options);

  const EditProblem& problem() const { return problem_; }
  const EditOptions& options() const { return options_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  /// Simulates at the start. Throws InputError where the scene cannot be simulated at all.
  EditPointPtr evaluateStart();
  /// Null when time is up, when the scene of this point cannot be simulated, or a row is not available. The last few
  /// points are kept, so that asking again is free.
  /// `nearest_times`: the free times of `changes` do not count, they are chosen afresh.
  EditPointPtr evaluate(const Eigen::VectorXd& changes, bool nearest_times = false);
  /// The same for any thread, with motions made in the way that is given; nothing is remembered.
  EditPointPtr make(const Eigen::VectorXd& changes, bool nearest_times, const MotionMaker& maker) const;
  /// Motions of trials end after some multiple of the work that the start took: from now on after twice as much.
  void allowLongerMotions();
  /// An evaluator of the same problem that makes its motions in another way. It remembers its own points, counts on from
  /// here and has the same deadline. In a thread of its own it must be `silent`: then it does not ask the callback.
  EditEvaluator branch(const MotionMaker& maker, bool silent) const;
  /// Counts on from where a branch ended.
  void adopt(const EditEvaluator& branch) { budget_ = branch.budget_; }
  /// Remembers a point if it is the best so far. Its motion must be a simulated one.
  void consider(const EditPointPtr& point);

  /// Fills in the point's derivatives. False where they cannot be computed: no step can be made from there.
  bool differentiate(EditPoint& point) const;

  /// The best point so far: within the tolerance the smallest change, else the smallest violation. By value: what goes
  /// on from it finds better ones, and it must stay alive meanwhile.
  EditPointPtr best() const { return best_; }
  bool reached(const EditPoint& point) const { return point.violation <= options_.tolerance; }
  bool reached() const { return best_ && reached(*best_); }

  /// Counts a step and asks the callback whether to go on.
  bool step(double objective, double violation);
  /// Counts steps that branches took at the same time, as many as the longest of them.
  void count(int steps) { budget_.count(steps); }
  int iterations() const { return budget_.done(); }
  int iterationsLeft() const { return budget_.left(); }
  /// What it and its branches have done, in steps of simulations (SimulateOptions::step_limit): the same everywhere.
  double work() const { return static_cast<double>(work_->load(std::memory_order_relaxed)); }
  /// Counts reverse passes.
  void countPasses(std::size_t passes) const;
  Halt halt() const { return budget_.halt(); }
  /// The callback ended it, or a stop has been requested, whether or not that has ended anything yet.
  bool isCancelled() const { return halt() == Halt::cancelled || options_.stop.stop_requested(); }
  bool goesOn() const { return halt() == Halt::none && iterationsLeft() > 0; }
  double secondsLeft() const { return budget_.secondsLeft(); }

 private:
  const EditProblem& problem_;
  const EditOptions& options_;
  Budget budget_;
  Eigen::VectorXd lower_, upper_;
  double until_;  ///< simulated first; further where a row is not found by then
  std::size_t step_limit_ = std::numeric_limits<std::size_t>::max();  ///< of the motion of a trial
  std::vector<EditPointPtr> recent_;
  EditPointPtr best_;
  MotionMaker maker_;
  bool silent_ = false;
  std::shared_ptr<std::atomic<std::size_t>> work_ = std::make_shared<std::atomic<std::size_t>>(0);  // of branches, too
};

}  // namespace carom::editing_detail
