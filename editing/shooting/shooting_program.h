// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "editing/shooting/segments.h"
#include "editing/solve/edit_search.h"
#include "editing/solve/nonlinear_program.h"
#include "editing/solve/patience.h"

/// An edit by multiple shooting as a sparse nonlinear program. Internal to editing/.
namespace carom {

/// minimise 1/2 |y|^2, y the changes of the edit's controls, subject to the edit's rows, validity and bounds, and for
/// every node (docs/equations.md section 10)
///   s_k(t_k; z_(k-1)) - s_k = 0                  the state at the end of the segment before it is that at the node;
///   (1 - r) (t_k - a) - r (b - t_k) = 0          the node keeps its place between the impacts at a and b around it.
/// Each segment depends on its own node alone, so that Jacobian and Hessian are those of the segments, in blocks.
class ShootingProgram final : public NonlinearProgram {
 public:
  /// `rows` are of those of the edit that hold a number. The start is the motion of `from` that was cut.
  ShootingProgram(EditSearch& search, const EditPoint& from, const Segments& segments, const std::vector<int>& rows);

  int variables() const override { return segments_.variables.size; }
  int constraints() const override { return static_cast<int>(rows_.size()) + search_.problem().validity.size(); }
  Bounds bounds() const override;
  Eigen::VectorXd start() const override { return start_; }
  bool objective(const Eigen::VectorXd& x, double& f) override;
  bool gradient(const Eigen::VectorXd& x, Eigen::VectorXd& df_dx) override;
  bool constraintValues(const Eigen::VectorXd& x, Eigen::VectorXd& g) override;
  std::vector<Place> jacobianPlaces() const override;
  bool jacobianEntries(const Eigen::VectorXd& x, Eigen::VectorXd& entries) override;
  bool hasHessian() const override { return true; }
  std::vector<Place> hessianPlaces() const override;
  bool hessianEntries(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers,
                      Eigen::VectorXd& entries) override;
  /// Also stops where the violation hardly falls any more, as EditProgram does.
  bool iteration(const Iteration& i) override { return patience_.allows(search_, i); }

 private:
  struct SegmentTerm {
    int segment = 0, row = 0;
    double factor = 0;
  };
  struct ProgramRow {
    std::vector<SegmentTerm> terms;
    Affine linear;
    double lower = 0, upper = 0;
  };
  struct Point {
    Eigen::VectorXd x;
    std::vector<SegmentPointPtr> segments;
    bool differentiated = false;
  };
  void addHeldRow(int segment, int row, int held);
  void addNodeRows(std::size_t node);
  Point* at(const Eigen::VectorXd& x);
  void differentiate(Point& point);
  Eigen::VectorXd controlValues(const Eigen::VectorXd& x) const;

  EditSearch& search_;
  const Segments& segments_;
  Eigen::VectorXd start_;
  std::vector<ProgramRow> rows_;
  std::vector<Point> recent_;
  Patience patience_;
};

}  // namespace carom
