// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/base/types.h"
#include "adjoint/motion/motion.h"

namespace carom {

/// What an impact law sees: contacts k with unit normals n_k (b to a), relative velocities u_k before the impact and
/// the matrix K of 3x3 blocks with u+ = u + K P for impulses P (on a). All in world axes.
struct ImpactProblem {
  Eigen::MatrixXd K;                   ///< 3N x 3N, kg^-1
  Eigen::VectorXd u;                   ///< 3N, m/s
  std::vector<Vec3> normal;            ///< N
  std::vector<PairCoefficients> pair;  ///< N
  /// A kinematic body takes part: u need not be in the range of what impulses can change.
  bool driven = false;

  int contacts() const { return static_cast<int>(normal.size()); }
};

/// Tangent or adjoint of an ImpactProblem, field by field.
struct ImpactProblemDerivative {
  Eigen::MatrixXd K;
  Eigen::VectorXd u;
  std::vector<Vec3> normal;
  std::vector<PairCoefficients> pair;

  explicit ImpactProblemDerivative(int contacts)
      : K(Eigen::MatrixXd::Zero(3 * contacts, 3 * contacts)),
        u(Eigen::VectorXd::Zero(3 * contacts)),
        normal(static_cast<std::size_t>(contacts), Vec3::Zero()),
        pair(static_cast<std::size_t>(contacts)) {}
};

/// Impulses, and the branch that was taken.
struct ImpactSolution {
  Eigen::VectorXd P;  ///< 3N, N s, on a
  ImpactMode mode = ImpactMode::frictionless;
  double stick_slip_margin = 1;  ///< see Margins
};

/// The same for one contact, of fixed size.
struct ContactProblem {
  Mat3 K;
  Vec3 u, normal;
  PairCoefficients pair;
};
struct ContactSolution {
  Vec3 P;
  ImpactMode mode = ImpactMode::frictionless;
  double stick_slip_margin = 1;
};
ContactSolution solveFrictionless(const ContactProblem& problem);  ///< 4.1
ContactSolution solveFriction(const ContactProblem& problem);      ///< 4.2

/// Of a contact without friction: how far it is from where the impulse has no derivative by the coefficient of friction
/// at 0, because a body that does not slip there sticks with the least friction. |P_t|/P_n of the untruncated impulse.
double frictionFromZeroMargin(const ContactProblem& problem);

/// The only contact of a problem.
inline ContactProblem onlyContact(const ImpactProblem& p) { return {p.K, p.u, p.normal[0], p.pair[0]}; }

/// One row of the table of impact laws. tangent and pullback differentiate the branch that solve takes.
struct ImpactLaw {
  const char* name;
  ImpactSolution (*solve)(const ImpactProblem&);
  Eigen::VectorXd (*tangent)(const ImpactProblem&, const ImpactProblemDerivative& dproblem);
  void (*pullback)(const ImpactProblem&, const Eigen::VectorXd& P_bar, ImpactProblemDerivative& problem_bar);
};

extern const ImpactLaw kFrictionlessLaw;  ///< 4.1, one contact, friction 0
extern const ImpactLaw kFrictionLaw;      ///< 4.2, one contact
extern const ImpactLaw kJointLaw;         ///< 4.3, several contacts

/// A contact without friction is one that slides with a coefficient of 0: a motion varies smoothly from the one to the
/// other.
inline ImpactMode branchOf(ImpactMode mode) { return mode == ImpactMode::frictionless ? ImpactMode::slide : mode; }

/// The law that a problem falls under.
inline const ImpactLaw& lawFor(const ImpactProblem& problem) {
  if (problem.contacts() > 1) return kJointLaw;
  return lawOf(problem.pair[0]) == Law::friction ? kFrictionLaw : kFrictionlessLaw;
}

}  // namespace carom
