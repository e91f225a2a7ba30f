#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/session/session_journal.h"
#include "editing/session/session_kink.h"
#include "editing/session/session_step.h"
#include "editing/solve/edit_search.h"

/// One gesture as an edit whose targets move. Internal to editing/.
namespace carom {

/// How much an update may still do: counted, so that it is the same everywhere, and watched by the clock for safety.
class Work {
 public:
  Work(int limit, double seconds, std::optional<int> cut_after);

  /// Takes one unit; false when there is none left.
  bool take();
  int done() const { return done_; }
  int left() const { return limit_ - done_; }
  bool cutByClock() const { return cut_; }

 private:
  int limit_, done_ = 0;
  bool cut_at_limit_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  bool cut_ = false;
};

class SessionSolver {
 public:
  /// Starts at `changes` of the controls, and the nearest free times. `goal` is the index of the constraint that gives
  /// way to all others, -1: none. Throws InputError for what makes no sense, or where the start lacks a constraint.
  SessionSolver(const Scene& reference, ContactSource& contacts, double duration, const std::vector<Control>& controls,
                const std::vector<Constraint>& constraints, int goal, const Eigen::VectorXd& changes,
                const SessionOptions& options);

  const EditProblem& problem() const { return problem_; }
  const EditPointPtr& point() const { return point_; }
  bool atStart() const { return point_ == start_; }
  bool reached() const { return reached(*point_); }
  int iterations() const { return iterations_; }

  /// Gives one target of the goal other numbers.
  void aim(int target, const std::vector<double>& value);
  /// Comes nearer to the constraints and makes the change smaller, by differential updates.
  void improve(Work& work);
  /// Minimises the change, or searches further where the constraints are not met. Work is counted in iterations.
  void finish(Work& work);

  /// Largest scaled error of the rows of the goal; of all others.
  double goalError(const RowValues& rows) const;
  double nailError(const RowValues& rows) const;

  /// How the impacts that count differ from where the gesture began: sentences; empty where they do not.
  std::string describeSequenceChange() const;
  /// What stands between the point and the constraints, as far as first derivatives tell: a sentence.
  std::string describeObstacle();

 private:
  EditPointPtr evaluate(const Eigen::VectorXd& changes) const;
  StepProblem stepProblem(EditPoint& point) const;
  bool reached(const EditPoint& point) const { return point.violation <= options_.tolerance; }
  double nailViolation(const EditPoint& point) const;
  double merit(const EditPoint& point) const;
  bool isBetter(const EditPoint& point) const;
  bool leads(const EditPoint& trial, const EditPoint& from, double eased) const;
  bool isSettled(const EditPoint& point, const Step& step) const;
  void keepIfBetter(const EditPointPtr& point);
  bool holdAtKink(EditPoint& at, EditPoint& trial);
  void learnEase(const EditPoint& at, const Step& step);

  SessionOptions options_;
  EditProblem problem_;
  int goal_;
  Eigen::VectorXd lower_, upper_;
  double until_;
  EditPointPtr start_, point_;
  double nails_allowed_ = 0;  // nails that are not met may stay as far off as they are
  double reach_ = 1, ease_ = 1;
  std::vector<Kink> kinks_;       // met in this update
  Eigen::VectorXd last_towards_;  // what would have made the change smallest, at the last step
  std::string last_signature_;
  int iterations_ = 0;
};

}  // namespace carom
