#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "adjoint/derivative_tape.h"
#include "adjoint/motion.h"
#include "editing/constraint.h"
#include "editing/quantities.h"

namespace carom {

/// One number that a constraint holds.
struct Row {
  int constraint = -1;  ///< index of the Constraint
  int target = 0;       ///< index of its Target
  int component = 0;    ///< of the quantity
  std::string name;     ///< "position.x", "time"
  double wanted = 0;    ///< target, SI; 0 for orientation rows
  double scale = 1;     ///< residual / scale is dimensionless
};

/// Values of all rows for one motion, SI.
struct RowValues {
  bool available = true;         ///< false: some row does not exist in this motion
  std::string message;           ///< which, and why
  Eigen::VectorXd values;        ///< NaN where not available
  Eigen::VectorXd residuals;     ///< value - wanted
  Eigen::VectorXd scaled;        ///< residual / scale
  std::vector<StateSeed> seeds;  ///< derivative of each value by the state of its body; body -1 where not available
};

/// The constraints of an edit as rows. Which rows there are depends on the constraints alone, not on the motion.
class ConstraintSet {
 public:
  /// Throws InputError naming "/constraints/<i>": unknown words and bodies, targets that are not numbers, nothing held,
  /// `time` at a time, ... Sizes and speeds of `scene` give the scales.
  ConstraintSet(const Scene& scene, const std::vector<Constraint>& constraints);

  const std::vector<Constraint>& constraints() const { return constraints_; }
  const std::vector<Row>& rows() const { return rows_; }
  int size() const { return static_cast<int>(rows_.size()); }

  /// Reads all rows in a motion. Rows that it does not have (the n-th impact does not come, or the time lies after its
  /// end) make the result unavailable, with a sentence; they are not an error.
  RowValues evaluate(const Motion& motion) const;

  /// Nothing after this time counts: the last time nailed, or `duration` when an impact is.
  double horizon(double duration) const;
  /// What of a motion counts for the constraints: its events up to the last of them, and the time of that.
  struct Extent {
    std::size_t events = 0;
    double time = 0;
  };
  Extent extentIn(const Motion& motion) const;
  /// Bodies whose orientation some row depends on directly.
  std::vector<bool> asksOrientation() const;

  /// "position.x of 'hat' at 1.4 s", "time of 'mug' at its impact 3 with 'floor'".
  std::string describeRow(int row) const;
  /// "'hat' at 1.4 s"
  std::string describeConstraint(int constraint) const;

 private:
  struct Bound {
    int body = -1;
    int with = -1;
    std::vector<const QuantityKind*> kinds;  ///< of each target
  };
  struct Reading {
    bool available = false;
    std::string message;
    Instant instant;
    double time = 0;
    BodyState state;
  };
  void bind(const Scene& scene, int index);
  void addRows(const Scene& scene, int index, int target);
  Reading read(const Motion& motion, int constraint) const;

  int body_count_ = 0;
  std::vector<Constraint> constraints_;
  std::vector<Bound> bound_;
  std::vector<Row> rows_;
};

}  // namespace carom
