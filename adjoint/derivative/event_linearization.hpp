// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/event_pass.hpp"

namespace carom::adjoint_detail {

/// One event of a motion, linearised, in doubles: its reverse pass is that of EventPass. The guard of a joint event is
/// the mean gap of its contacts, weighted by their normal impulses.
class EventLinearization : public EventPass<double> {
 public:
  EventLinearization(const Motion& motion, int event);

  struct Tangent {
    std::vector<StateDerivative> after;  ///< of the participants, at the fixed nominal time
    double time = 0;                     ///< d tau
  };
  /// `before`: of the participants at the fixed nominal time, just before; `dmodel`: one a body of the scene.
  Tangent tangent(const std::vector<StateDerivative>& before, const SceneTangent& dscene,
                  const std::vector<BodyModelDerivative>& dmodel) const;

  /// How far the event is from where it has no derivative with respect to coefficients of friction that are 0.
  FromZero frictionFromZero() const;

 private:
  double guardTangent(const std::vector<StateDerivative>& before, const SceneTangent& dscene,
                      const std::vector<BodyModelDerivative>& dmodel) const;
};

}  // namespace carom::adjoint_detail
