#include "editing/session/session_kink.h"

#include <cmath>

#include <Eigen/SVD>

namespace carom {
namespace {

/// A kink changes the derivatives by more than this share of them; less is their curvature.
constexpr double kSharp = 0.02;
/// Other ranks of the change are smaller than this share of the first: else it is no kink but a jump.
constexpr double kOneRank = 0.3;

}  // namespace

std::optional<Kink> kinkBetween(const EditProblem& problem, const EditPoint& a, const EditPoint& b) {
  const Eigen::MatrixXd &Ja = *a.row_jacobian, &Jb = *b.row_jacobian;
  if (!Ja.allFinite() || !Jb.allFinite() || Ja.rows() == 0 || Ja.cols() == 0) return std::nullopt;
  Eigen::VectorXd jump = b.rows.values - a.rows.values;
  for (int i = 0; i < problem.constraints.size(); ++i)
    jump[i] /= problem.constraints.rows()[static_cast<std::size_t>(i)].scale;
  jump += Ja * a.changes - Jb * b.changes;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Ja - Jb, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& all = svd.singularValues();
  const double s = all[0], second = all.size() > 1 ? all[1] : 0;
  if (!(s > kSharp * Ja.norm()) || second > kOneRank * s) return std::nullopt;
  const Kink kink{svd.matrixV().col(0), svd.matrixU().col(0).dot(jump) / s};
  const double side_a = kink.normal.dot(a.changes) - kink.offset, side_b = kink.normal.dot(b.changes) - kink.offset;
  if (!(side_a * side_b < 0)) return std::nullopt;
  return kink;
}

}  // namespace carom
