// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/derivative/derivative_tape.h"
#include "adjoint/derivative/event_linearization.hpp"
#include "adjoint/impact/law.hpp"

/// Gradients of numbers that are read at an impact. Internal to editing/.
namespace carom::editing_detail {

using namespace adjoint_detail;

/// d of a number by what is known just before an event: poses, velocities and spins of its bodies, contact geometry,
/// mass properties and coefficients. `gradient` turns it into the derivative with respect to all scene parameters.
class EventBars {
 public:
  /// `tape` must outlive it.
  EventBars(DerivativeTape& tape, int event);

  /// By (gap, normal, point) of a contact, at the moved poses of its bodies.
  void addContact(int contact, const Eigen::Matrix<double, 7, 1>& bar);
  /// By the relative velocity u of a contact (docs/equations.md, section 4), moving surfaces counted in.
  void addVelocity(int contact, const Vec3& u_bar);
  /// By the matrix K of a contact (docs/equations.md section 4), and by the normal of the impulse and the coefficients.
  void addLaw(int contact, const Mat3& K_bar, const Vec3& impulse_normal_bar, const PairCoefficients& pair_bar);
  /// By the rotation (world vector) and the centre of mass of a body; of a fixed body its written pose.
  void addPose(int body, const Vec3& x_bar, const Vec3& theta_bar);
  void addSize(int body, const Eigen::VectorXd& size_bar);
  /// By the time of the event.
  void addTime(double time_bar);

  /// Relative velocity, K and the problem's other numbers at a contact.
  Vec3 velocityAt(int contact) const;
  Mat3 matrixAt(int contact) const;
  Pose poseOf(int body) const;

  /// One reverse pass.
  SceneGradient gradient() const;

 private:
  DerivativeTape& tape_;
  const Motion& motion_;
  const Event& event_;
  const EventPass<double>& pass_;
  ImpactProblemDerivative problem_;                    // by what the law sees
  std::vector<Eigen::Matrix<double, 7, 1>> contacts_;  // by the contacts themselves
  std::vector<StateSeed> seeds_;                       // of the participants
  SceneGradient direct_;
};

}  // namespace carom::editing_detail
