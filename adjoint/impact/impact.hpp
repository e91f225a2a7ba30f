// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/impact/law.hpp"
#include "adjoint/motion/motion.h"

namespace carom {

/// An event with everything that its impulse depends on: for every contact the arms r = p - x of the bodies, u and K.
class ImpactAssembly {
 public:
  /// `event` has contacts, participants and their states before; both must outlive the assembly.
  ImpactAssembly(const Event& event, const std::vector<BodyModel>& models);

  const ImpactProblem& problem() const { return problem_; }

  /// v+ = v + sum s P/m, L+ = L + sum s r x P, with s = 1 on body a and -1 on b.
  std::vector<State> after(const Eigen::VectorXd& P) const;

  /// Tangent of (states before, arms' contact points and normals, coefficients, models) -> states after.
  /// `dcontact[k]` holds d(gap, normal, point) of contact k; the normal is the one that the impulse uses.
  std::vector<StateDerivative> tangent(const Eigen::VectorXd& P, const std::vector<StateDerivative>& dbefore,
                                       const std::vector<Eigen::Matrix<double, 7, 1>>& dcontact,
                                       const std::vector<PairCoefficients>& dpair,
                                       const std::vector<BodyModelDerivative>& dmodel) const;

  /// Adjoint of `tangent`: adds to the adjoints of contacts, coefficients and models (of participants); returns those
  /// of the states before.
  std::vector<StateDerivative> pullback(const Eigen::VectorXd& P, const std::vector<StateDerivative>& after_bar,
                                        std::vector<Eigen::Matrix<double, 7, 1>>& contact_bar,
                                        std::vector<PairCoefficients>& pair_bar,
                                        std::vector<BodyModelDerivative>& model_bar) const;

 private:
  // One body at one contact.
  struct Arm {
    int contact;
    int participant;
    double sign;
    Vec3 r;
  };
  struct MovingBody {
    const BodyModel* model;
    Mat3 R, A;      // principal axes to world; world inverse inertia
    Mat3 mobility;  // A, or 0 where impulses do not move the body
    Vec3 omega;
  };

  const Event& event_;
  const std::vector<BodyModel>& models_;
  bool wide_;  // doubles are too short for it, see WideImpact
  std::vector<MovingBody> bodies_;
  std::vector<Arm> arms_;
  ImpactProblem problem_;
};

/// Fills in impulses, mode, approach and margins of an event and gives the states of its participants after it. Throws
/// NotComputable where these are not finite numbers, and where a contact does not part as fast as its elasticity says.
void solveImpact(Event& event, const std::vector<BodyModel>& models, std::vector<State>& after);

}  // namespace carom
