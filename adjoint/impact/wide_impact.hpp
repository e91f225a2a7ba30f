// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/motion/motion.h"

namespace carom {

/// Whether doubles are too short for an impact: what an impulse gives its bodies, in speed and in spin at the contacts,
/// differs by more than 1e3: a velocity may lose that many digits, a derivative twice as many. Numbers of 32 digits take
/// over then, for the impact and all of its derivatives.
bool needsWide(const Event& event, const std::vector<BodyModel>& models);

/// The same of an event that was solved, or is to be.
inline bool usesWide(const Event& event, const std::vector<BodyModel>& models) {
  return event.wide || needsWide(event, models);
}

/// ImpactAssembly in these numbers: states in, states out.
class WideImpact {
 public:
  using Vec7 = Eigen::Matrix<double, 7, 1>;

  /// `event` has contacts, participants and their states before; both must outlive it.
  WideImpact(const Event& event, const std::vector<BodyModel>& models) : event_(event), models_(models) {}

  /// Fills in impulses, mode and margin of stick and slip; states of the participants after it.
  std::vector<State> solve(Event& event) const;
  std::vector<StateDerivative> tangent(const std::vector<StateDerivative>& dbefore, const std::vector<Vec7>& dcontact,
                                       const std::vector<PairCoefficients>& dpair,
                                       const std::vector<BodyModelDerivative>& dmodel) const;
  std::vector<StateDerivative> pullback(const std::vector<StateDerivative>& after_bar, std::vector<Vec7>& contact_bar,
                                        std::vector<PairCoefficients>& pair_bar,
                                        std::vector<BodyModelDerivative>& model_bar) const;

 private:
  const Event& event_;
  const std::vector<BodyModel>& models_;
};

}  // namespace carom
