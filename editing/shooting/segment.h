// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/jacobian.h"
#include "editing/shooting/affine.h"

/// One stretch of a motion between two nodes, as an edit of its own. Internal to editing/.
namespace carom {

/// A segment at one point.
struct SegmentPoint {
  Eigen::VectorXd unknowns;  ///< of the segment's problem
  Eigen::VectorXd values;    ///< of its controls
  Motion motion;             ///< from the node on; its times count from there
  RowValues rows;
  std::optional<Eigen::MatrixXd> jacobian;  ///< d(row values)/d(unknowns), SI by dimensionless; on demand
};
using SegmentPointPtr = std::shared_ptr<SegmentPoint>;

/// What a row of a segment's problem is to the whole.
struct SegmentRow {
  enum class Role {
    held,          ///< a row of the edit
    end_state,     ///< a component of the state at the next node
    first_impact,  ///< the time of the impact after the node at its start
    last_impact,   ///< the time of the impact before the node at its end
  };
  Role role = Role::held;
  int index = -1;  ///< held: the row of the edit; end_state: which unknown of the next segment it is
};

/// An EditProblem over the time between two nodes: its controls are the states at its start and the edit's own
/// controls of other things; its rows those of the edit that fall into it, the state at its end, and times of impacts.
/// Motions follow the impact sequence of the one that was cut (adjoint/simulate/replay.h), so that rows are smooth.
class Segment {
 public:
  EditProblem problem;
  std::vector<Affine> unknowns;  ///< of `problem`, by the variables of the program
  std::vector<SegmentRow> rows;  ///< what each row of `problem` is
  Affine start;                  ///< s, when it begins
  std::optional<Affine> end;     ///< s; the last segment has none
  double horizon = 0;            ///< s, end of the whole edit
  bool reads_impacts = false;    ///< a row of the edit is read at an impact
  std::shared_ptr<const Motion> like;
  std::shared_ptr<ContactSource> contacts;  ///< its own, so that segments can be evaluated at the same time

  explicit Segment(EditProblem of) : problem(std::move(of)) {}

  /// Simulates what the segment will follow, from x, where the whole motion is the one that was cut; `from` and `until`
  /// are its times. False where these bodies meet other impacts than in the whole.
  bool follow(const Motion& whole, const Eigen::VectorXd& x, double from, double until, const std::vector<int>& bodies);

  Eigen::VectorXd unknownsAt(const Eigen::VectorXd& x) const;
  /// Null where it cannot be evaluated: an impact is left out, a time lies before the node.
  SegmentPointPtr evaluate(const Eigen::VectorXd& x) const;
  void differentiate(SegmentPoint& point) const;
  /// Second derivatives of weights . (row values) by the unknowns.
  Eigen::MatrixXd hessian(const SegmentPoint& point, const Eigen::VectorXd& weights) const;

 private:
  double until(const Eigen::VectorXd& x, const Eigen::VectorXd& times) const;
};

}  // namespace carom
