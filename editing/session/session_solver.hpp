// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/session/session_kink.hpp"
#include "editing/session/session_part.hpp"
#include "editing/session/session_step.hpp"
#include "editing/session_journal.h"
#include "editing/session_update.h"
#include "editing/solve/edit_evaluator.hpp"
#include "editing/strategy/samples.hpp"

/// One gesture as an edit whose targets move. Internal to editing/.
namespace carom::editing_detail {

class SessionSolver {
 public:
  /// Starts at `changes` of the controls, and the nearest free times. `goal` is the index of the constraint that gives
  /// way to all others, -1: none. Throws InputError for what makes no sense, or where the start lacks a constraint.
  /// `part`: `reference` is part of a scene, and its motions are not for showing.
  SessionSolver(const Scene& reference, ContactSource& contacts, double duration, const std::vector<Control>& controls,
                const std::vector<Constraint>& constraints, int goal, const Eigen::VectorXd& changes,
                const SessionOptions& options, bool part = false);

  const EditProblem& problem() const { return problem_; }
  EditPointPtr start() const { return start_; }
  EditPointPtr point() const { return point_; }
  int goal() const { return goal_; }
  bool atStart() const { return point_ == start_; }
  bool reached() const { return reached(*point_); }
  int iterations() const { return iterations_; }

  /// The motion that is shown: what nobody comes near is taken over from it (SimulateOptions::baseline).
  void takeOverFrom(std::shared_ptr<const Motion> shown) { known_ = std::move(shown); }
  /// Gives one target of the goal other numbers.
  void aim(int target, const std::vector<TargetNumber>& value);
  /// Other numbers or ranges in place of one another; what is free stays free.
  void aim(int target, const Target& moved);
  /// Comes nearer to the constraints and makes the change smaller, by differential updates. Where few of the bodies
  /// matter, it works with a scene of those alone, and what came of that is verified with all. `better` is called
  /// whenever a better point was found, of all bodies. `sparing`: a motion of many steps counts as several
  /// (SessionOptions::drag_steps).
  void improve(Budget& budget, const std::function<void()>& better = {}, bool sparing = false);
  /// Minimises the change, or searches further where the constraints are not met. Work is counted in iterations.
  void finish(Budget& budget);

  /// Largest scaled error of the rows that are not of the goal.
  double nailError(const RowValues& rows) const;

  /// Whether something that varies moves what the goal holds, to first order at the start.
  bool isMoved() const;

  /// What stands between the point and the constraints, as far as first derivatives tell.
  SessionObstacle obstacle();

 private:
  EditPointPtr evaluate(const Eigen::VectorXd& changes) const;
  EditPointPtr evaluateToShow(const Eigen::VectorXd& changes) const;
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

  // session_descent.cpp: with all bodies that there are
  void improveHere(Budget& budget);
  void descendFromBest(Budget& budget);
  void descend(EditPointPtr at, Budget& budget, int most);
  std::optional<Surroundings> surroundings(EditPoint& point) const;
  void lookElsewhere(Budget& budget);
  void finishHere(Budget& budget);

  // session_obstacle.cpp
  std::string nothingMoves() const;
  SessionObstacle obstacleHere();

  // session_division.cpp: with some of them
  void divide(const std::vector<bool>& moving);
  double priceOfAll() const;
  void improveDivided(Budget& budget);
  void shrinkPart();
  void startAt(const Eigen::VectorXd& changes);
  bool takeOverPart(Budget& budget);
  void simulateAnew();

  SessionOptions options_;
  EditProblem problem_;
  int goal_;
  Eigen::VectorXd lower_, upper_;
  double until_;
  EditPointPtr start_, point_;
  double nails_allowed_ = 0;  // nails that are not met may stay as far off as they are
  double longest_ = 1, ease_ = 1;
  std::vector<Kink> kinks_;       // met in this update
  bool holds_jumps_ = false;      // steps are held before boundaries where the motion jumps, once
  EditPointPtr beyond_;           // a step from the best point, with other impacts
  Eigen::VectorXd last_towards_;  // what would have made the change smallest, at the last step
  std::string last_signature_;
  int iterations_ = 0;
  int samples_ = 0;  // taken so far, in lookElsewhere
  std::function<void()> better_;  // of the improvement under way
  bool sparing_ = false;          // likewise

  bool is_part_;
  bool stays_whole_;      // too many bodies matter
  int since_growth_ = 0;  // updates
  ScenePart division_;
  std::unique_ptr<SessionSolver> part_;  // null: not divided
  std::shared_ptr<const Motion> known_;  // of all bodies: what those who matter do not come near is taken over
};

}  // namespace carom::editing_detail
