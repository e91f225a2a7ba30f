// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/impact/impact.hpp"
#include "adjoint/motion/motion.h"

namespace carom {

/// One event, linearised: impact law, contact geometry and guard (equations 5.1 to 5.3 of docs/equations.md).
/// The guard of a joint event is the mean gap of its contacts, weighted by their normal impulses.
class EventLinearization {
 public:
  EventLinearization(const Motion& motion, int event);

  struct Tangent {
    std::vector<StateDerivative> after;  ///< of the participants, at the fixed nominal time
    double time = 0;                     ///< d tau
  };
  /// `before`: of the participants at the fixed nominal time, just before; `dmodel`: one a body of the scene.
  Tangent tangent(const std::vector<StateDerivative>& before, const SceneTangent& dscene,
                  const std::vector<BodyModelDerivative>& dmodel) const;

  /// Adjoint just before the event from that just after (`after_bar`), plus adjoints of the state just before
  /// (`before_bar`) and of the time of the event (`time_bar`) that are read at the event itself.
  std::vector<StateDerivative> pullback(const std::vector<StateDerivative>& after_bar,
                                        const std::vector<StateDerivative>& before_bar, double time_bar,
                                        SceneGradient& scene_bar, std::vector<BodyModelDerivative>& model_bar) const;

  /// F- of a participant, d(state)/dt just before.
  const StateDerivative& rateBefore(int participant) const {
    return rate_before_[static_cast<std::size_t>(participant)];
  }
  const StateDerivative& rateAfter(int participant) const { return rate_after_[static_cast<std::size_t>(participant)]; }
  /// How far the event is from where it has no derivative by coefficients of friction that are 0: see
  /// frictionFromZeroMargin. 0 for several contacts, one of which is without friction; 1 where none is.
  double frictionFromZero() const;
  /// D = d(guard)/dt < 0, m/s.
  double guardRate() const { return D_; }

 private:
  using Vec7 = Eigen::Matrix<double, 7, 1>;
  using Vec12 = Eigen::Matrix<double, 12, 1>;
  struct Side {
    int body, participant;  // participant -1: a fixed body
  };
  struct ContactPart {
    Side a, b;
    double weight = 0;
    ContactJacobian jacobian;
    bool tilted = false;
    Eigen::Matrix<double, 3, 7> tilt;  // d(impulse normal) by (normal, tilt a, tilt b)
    int material_a = -1, material_b = -1;
  };

  // (x_a, theta_a, x_b, theta_b); a null scene: fixed bodies stay
  Vec12 poses(const ContactPart& part, const std::vector<StateDerivative>& before, const SceneTangent* dscene) const;
  // d(gap, normal, point)
  Vec7 contactTangent(const ContactPart& part, const std::vector<StateDerivative>& before,
                      const SceneTangent& dscene) const;
  void scatter(const ContactPart& part, const Vec7& bar, std::vector<StateDerivative>& before_bar,
               SceneGradient& scene_bar) const;

  const Motion& motion_;
  const Event& event_;
  ImpactAssembly assembly_;
  Eigen::VectorXd P_;
  std::vector<ContactPart> parts_;
  std::vector<StateDerivative> rate_before_, rate_after_;
  double D_ = 0;
};

}  // namespace carom
