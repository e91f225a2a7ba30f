#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "editing/edit.h"
#include "editing/jacobian.h"

/// Points, and how one is improved. Internal to editing/.
namespace carom {

/// One evaluated point of a search.
struct EditPoint {
  Eigen::VectorXd changes, values;
  Motion motion;  ///< a little further than the constraints reach
  RowValues rows;
  std::string signature;     ///< of the events that count
  Eigen::VectorXd validity;  ///< h >= 0
  double violation = 0;      ///< largest scaled residual or lack of validity
  double objective = 0;
  std::optional<Eigen::MatrixXd> row_jacobian, validity_jacobian;  ///< by changes, dimensionless; on demand
};
using EditPointPtr = std::shared_ptr<EditPoint>;

/// Why a search must end early.
enum class Halt { none, out_of_time, cancelled };

/// Evaluates points, remembers the best, and watches the clock and the callback.
class EditSearch {
 public:
  EditSearch(const EditProblem& problem, const EditOptions& options);

  const EditProblem& problem() const { return problem_; }
  const EditOptions& options() const { return options_; }
  const Eigen::VectorXd& lower() const { return lower_; }
  const Eigen::VectorXd& upper() const { return upper_; }

  /// Simulates at the start. Throws InputError where the scene cannot be simulated at all.
  EditPointPtr evaluateStart();
  /// Null when time is up, when the scene of this point cannot be simulated, or a row is not available. The last few
  /// points are kept, so that asking again is free.
  EditPointPtr evaluate(const Eigen::VectorXd& changes);
  /// Fills in the point's derivatives.
  void differentiate(EditPoint& point) const;

  /// The best point so far: within the tolerance the smallest change, else the smallest violation.
  const EditPointPtr& best() const { return best_; }
  bool reached(const EditPoint& point) const { return point.violation <= options_.tolerance; }
  bool reached() const { return best_ && reached(*best_); }

  /// Counts a step and asks the callback whether to go on.
  bool step(double objective, double violation);
  int iterations() const { return iterations_; }
  int iterationsLeft() const { return options_.max_iterations - iterations_; }
  Halt halt() const { return halt_; }
  bool goesOn() const { return halt_ == Halt::none && iterationsLeft() > 0; }
  std::optional<std::chrono::steady_clock::time_point> deadline() const { return deadline_; }

 private:
  EditPointPtr simulatePoint(const Eigen::VectorXd& changes, double until) const;
  void consider(const EditPointPtr& point);
  bool expired();

  const EditProblem& problem_;
  const EditOptions& options_;
  std::optional<std::chrono::steady_clock::time_point> deadline_;
  Eigen::VectorXd lower_, upper_;
  double until_;  ///< simulated first; further where a row is not found by then
  std::vector<EditPointPtr> recent_;
  EditPointPtr best_;
  int iterations_ = 0;
  Halt halt_ = Halt::none;
};

/// Gauss-Newton steps onto the constraints, each the smallest change that meets the linearised rows within the bounds.
/// Quadratic near a solution. With a signature, points of another impact sequence are refused. Returns the point with
/// the smallest violation that was met.
EditPointPtr projectOntoConstraints(EditSearch& search, EditPointPtr from, int max_steps,
                                    const std::string* signature = nullptr);

/// The step that projectOntoConstraints would take from a differentiated point.
Eigen::VectorXd smallestStep(const EditSearch& search, const EditPoint& point);

}  // namespace carom
