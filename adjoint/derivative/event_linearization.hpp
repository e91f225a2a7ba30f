// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::adjoint_detail {

template <class S>
class EventPass;

/// One event, linearised: impact law, contact geometry and guard (equations 5.1 to 5.3 of docs/equations.md).
/// The guard of a joint event is the mean gap of its contacts, weighted by their normal impulses.
class EventLinearization {
 public:
  EventLinearization(const Motion& motion, int event);
  ~EventLinearization();

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

  /// F- and F+ of a participant, d(state)/dt just before and just after.
  const StateDerivative& rateBefore(int participant) const;
  const StateDerivative& rateAfter(int participant) const;
  /// How far the event is from where it has no derivative by coefficients of friction that are 0: see
  /// frictionFromZeroMargin. 0 for several contacts, one of which is without friction; 1 where none is.
  double frictionFromZero() const;
  /// D = d(guard)/dt < 0, m/s.
  double guardRate() const;
  /// The numbers of the linearisation.
  const EventPass<double>& pass() const { return *pass_; }

 private:
  const Motion& motion_;
  const Event& event_;
  std::unique_ptr<const EventPass<double>> pass_;
};

}  // namespace carom::adjoint_detail
