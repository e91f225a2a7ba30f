// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/motion/motion.h"
#include "editing/constraint.h"
#include "editing/problem/rows/bound_function.hpp"
#include "editing/problem/rows/least_in_time.hpp"
#include "editing/problem/rows/quantities.hpp"
#include "editing/problem/rows/region_rows.hpp"
#include "editing/problem/rows/required_impacts.hpp"
#include "editing/problem/rows/shape_clearance.hpp"
#include "editing/wanted.h"

namespace carom::editing_detail {

using namespace adjoint_detail;

/// What the caller of an edit brings along: rows of one's own, and what is minimised in place of the change.
struct OwnFunctions {
  struct Row {
    MotionFunction function;
    Wanted wanted;
  };
  std::vector<Row> rows;
  std::optional<MotionFunction> objective;
  double change_weight = 0;  ///< of the change that is minimised beside `objective`
};

/// One number that a constraint holds: equal to a target, or within a range.
struct Row {
  int constraint = -1;          ///< index of the Constraint; -1: a row of one's own
  int own = -1;                 ///< index into OwnFunctions::rows; -1: of a constraint
  int target_index = 0;         ///< of its Target; -1: of a region
  int region = -1;              ///< index of its Region; -1: of a target
  int component = 0;            ///< of the quantity, or of the region
  const QuantityKind* kind = nullptr;  ///< null: of a region, or one's own
  std::string name;             ///< "position.x", "time", "avoid"
  double target = 0;            ///< SI; 0 for orientation rows; NaN for a range
  double lower = 0, upper = 0;  ///< allowed values, SI; both `target` where that is a number
  double scale = 1;             ///< residual / scale is dimensionless

  bool isRange() const { return !(lower == upper); }
  /// Holds over a span of its own, whatever the time of the constraint.
  bool overSpan() const { return region >= 0 || (kind && kind->over_span); }
};

/// " m/s": the unit of a row, after a number; empty where that has none, or is one's own.
std::string unitOf(const Row& row);

/// A time that a constraint `between` two times leaves to the edit: an unknown beside the controls.
struct FreeTime {
  int constraint = -1;
  double from = 0, to = 0;  ///< s
  double scale = 1;         ///< natural time of the body, s
};

/// When a constraint holds whose time the edit chooses, in a span, or the motion, at rest.
struct ConstrainedTime {
  int constraint = -1;
  double from = 0, to = 0;  ///< s, in which it may hold
  double time = 0;          ///< s
};

/// What there is to know of the derivative of one row, besides its seeds.
struct RowNote {
  std::string doubt;          ///< not empty: why it cannot be trusted, a clause
  bool second_order = true;   ///< second derivatives are known
  SeedRates seed_rates = {};  ///< of rows that bring their own; may be empty
};

/// Values of all rows for one motion, SI.
struct RowValues {
  bool available = true;      ///< false: some row does not exist in this motion
  std::string message;        ///< which, and why
  std::vector<LackingImpact> lacking;  ///< impacts that were required and are not there
  Eigen::VectorXd times;      ///< of the free times, at which rows were read, s
  Eigen::VectorXd values;     ///< NaN where not available
  Eigen::VectorXd residuals;  ///< value - target; of a range how far outside, negative below it
  Eigen::VectorXd scaled;     ///< residual / scale
  /// Derivative of each value with respect to the states of bodies, a sum; empty where not available.
  std::vector<std::vector<StateSeed>> seeds;
  std::vector<RowNote> notes;  ///< one a row
  std::optional<RowReading> objective;  ///< of one's own, where there is one and the motion has it
};

/// Which constraints a set has rows of; those that it leaves out keep their index.
enum class RowsOf { hard, soft };

/// The constraints of an edit as rows. Which rows there are depends on the constraints alone, not on the motion.
class ConstraintSet {
 public:
  /// Throws InputError naming "/constraints/<i>": unknown words and bodies, targets that are not numbers, nothing held,
  /// `time` at a time, ... Sizes and speeds of `scene` give the scales; `duration` ends spans that are open.
  ConstraintSet(const Scene& scene, const std::vector<Constraint>& constraints,
                double duration = std::numeric_limits<double>::infinity(), const OwnFunctions& own = {},
                RowsOf which = RowsOf::hard);

  /// All that were given; one that the set leaves out has neither targets nor regions.
  const std::vector<Constraint>& constraints() const { return constraints_; }
  const std::vector<Row>& rows() const { return rows_; }
  const std::vector<FreeTime>& freeTimes() const { return free_times_; }
  int size() const { return static_cast<int>(rows_.size()); }
  /// What is minimised in place of the change; null: the change.
  const BoundFunction* objective() const { return objective_ ? &*objective_ : nullptr; }
  /// Indices of the rows that hold a number, and of those that hold a range.
  const std::vector<int>& equations() const { return equations_; }
  const std::vector<int>& ranges() const { return ranges_; }

  /// Reads all rows in a motion, with the free times given, or else at the nearest ones. Rows that the motion does not
  /// have (the n-th impact does not come, the body does not come to rest, or the time lies after its end) make the
  /// result unavailable, with a sentence; they are not an error.
  RowValues evaluate(const Motion& motion) const { return evaluate(motion, nearestTimes(motion)); }
  RowValues evaluate(const Motion& motion, const Eigen::VectorXd& times) const;
  /// The same with an instant for each free time, which may be an event.
  RowValues evaluate(const Motion& motion, std::span<const Instant> instants) const;
  /// When constraints hold whose time is not given: those at some time of a span, and those at rest that the motion
  /// has.
  std::vector<ConstrainedTime> constrainedTimes(const Motion& motion, const Eigen::VectorXd& times) const;
  /// For each free time one at which its constraint is most nearly met, among many.
  Eigen::VectorXd nearestTimes(const Motion& motion) const;
  /// What a constraint between two times misses by if it is read at a time, half the sum of squares of its scaled
  /// residuals, and the rate of that there.
  ValueInTime missInTime(const Motion& motion, int constraint, double time) const;
  /// Bodies whose states the rows of a constraint are read from.
  std::vector<int> bodiesRead(int constraint) const;

  /// How the weights of a row's seeds change when the states that they are read from change at `rates`, one a seed;
  /// `times` as for evaluate.
  std::vector<StateSeed> seedRates(const Motion& motion, const Eigen::VectorXd& times, int row,
                                   std::span<const BodyStateRate> rates) const;
  /// What the row of a region reads where a ball is kept, and where the shape is.
  std::optional<Clearance> clearance(const Motion& motion, int row) const;
  std::optional<ShapeClearance> clearanceOfShape(const Motion& motion, int row) const;
  /// When a row of a region is least, s; nothing where the motion ends before its span does.
  std::optional<double> timeOfClearance(const Motion& motion, int row) const;
  /// How the time at which a row over a span reads the motion moves with the controls; empty where it stays, or moves
  /// with an event.
  Eigen::VectorXd timeRate(DerivativeTape& tape, int row, std::span<const ReadingDirection> controls) const;

  /// How far a value lies outside what a row allows, SI; negative below, 0 inside.
  double residual(int row, double value) const;

  /// Nothing after this time counts: the last time nailed, or `duration` when an impact is.
  double horizon(double duration) const;
  /// Whether it depends on the motion up to when it has to be known.
  bool waits() const;
  /// Whether something is held at rest, of which only the end of the motion tells that it stays so.
  bool holdsAtRest() const;
  /// Whether a motion has the impacts that are waited for, as far as it is known; what is held at rest waits for its
  /// end.
  bool hasWhatItWaitsFor(const Motion& motion) const;
  /// The last time that is held besides, s.
  double leastDuration() const;
  /// What of a motion counts for the constraints: its events up to the last of them, and the time of that. Without
  /// free times their spans count whole.
  struct Extent {
    std::size_t events = 0;
    double time = 0;
  };
  Extent extentIn(const Motion& motion, const Eigen::VectorXd& times = {}) const;
  /// When a required impact happens, or a required sequence is complete; null where it does not. And whether all that is
  /// waited for is there.
  std::optional<double> timeOfAwaited(const Motion& motion, int constraint) const;
  bool hasAllAwaited(const Motion& motion) const;
  /// Bodies whose orientation some row depends on directly.
  std::vector<bool> asksOrientation() const;

  /// Puts other numbers and ranges in the place of one target, whose free components stay the same ones.
  void setTarget(int constraint, int target, Target moved);

  /// "position.x of 'hat' at 1.4 s", "time of 'mug' at its impact 3 with 'floor'".
  std::string describeRow(int row) const;
  /// "'hat' at 1.4 s"
  std::string describeConstraint(int constraint) const;

 private:
  struct Bound {
    int body = -1;
    int with = -1;
    int relative_to = -1;
    int free_time = -1;                      ///< index into free_times_
    std::vector<const QuantityKind*> kinds;  ///< of each target
    std::vector<int> to;                     ///< the other body of each, or -1
    std::vector<std::pair<double, double>> during;  ///< s, of each; of a quantity over a span
    bool at_instant = false;                 ///< some target is read when the constraint says
    std::vector<BoundRegion> regions;
    std::optional<BoundHit> hit;
    std::optional<BoundSequence> sequence;
  };
  struct Reading {
    bool available = false;
    std::string message;
    const Motion* motion = nullptr;
    Instant instant;
    double time = 0;
    BodyState own, other;  ///< of the body, and of the one it is seen from
    BodyState seen;        ///< what targets are about
  };
  void bind(const Scene& scene, int index, double duration);
  void bindImpacts(const Scene& scene, int index, const std::string& where);
  /// The instant of a constraint that waits for an event, if it is there.
  std::optional<Instant> awaited(const Motion& motion, int constraint) const;
  bool waitsForEvent(int constraint) const;
  LackingImpact lacking(const Motion& motion, int constraint) const;
  const Target& targetOf(const Row& row) const;
  void addTargetRows(const Scene& scene, int index, int target);
  void sortRows();
  void addOwnRow(const Scene& scene, int index, const OwnFunctions::Row& own, double duration);
  void addRegionRows(const Scene& scene, int index, int region, double duration);
  Reading read(const Motion& motion, int constraint, double free_time) const;
  Reading readAt(const Motion& motion, int constraint, const Instant& instant) const;
  void readRow(int row, const Reading& reading, RowValues& out) const;
  void bindTarget(const Scene& scene, int index, int target, double duration);
  RowReading readMotionQuantity(const Reading& reading, int row) const;
  RowReading readOverSpan(const Motion& motion, int row) const;
  void putReading(int row, RowReading reading, RowValues& out) const;
  void readRegion(const Motion& motion, int row, RowValues& out) const;
  const BoundRegion& regionOf(int row) const;
  void readObjective(const Motion& motion, RowValues& out) const;
  double missAt(const Motion& motion, int constraint, double time) const;
  RowValues unread() const;
  RowValues evaluateWith(const Motion& motion, const std::function<Reading(int)>& read_constraint) const;

  int body_count_ = 0;
  std::vector<Constraint> constraints_;
  std::vector<Bound> bound_;
  std::vector<Row> rows_;
  std::vector<int> equations_, ranges_;
  std::vector<FreeTime> free_times_;
  std::vector<BoundFunction> own_;  ///< of the rows of one's own
  std::optional<BoundFunction> objective_;
};

}  // namespace carom::editing_detail
