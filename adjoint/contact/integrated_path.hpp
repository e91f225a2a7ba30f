// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "adjoint/contact/path_inputs.hpp"
#include "adjoint/scene/body_model.h"

namespace carom::adjoint_detail {

/// Bounds over a stretch of a path.
struct PathBounds {
  Vec3 acceleration = Vec3::Zero();  ///< m/s^2, of the centre of mass at the start of the stretch
  double variation = 0;              ///< how far it may differ from that, m/s^2
  bool straight = true;              ///< it is constant
  double spin = 0, spin_rate = 0;    ///< |w| rad/s, |w'| rad/s^2
};

/// A motion in lasting contact that has no closed form: it is integrated as far as somebody looks. Times are those of the
/// motion, s.
class IntegratedPath {
 public:
  virtual ~IntegratedPath() = default;
  virtual std::unique_ptr<IntegratedPath> clone() const = 0;
  /// Reads the model of its body, which is the same, here from now on.
  virtual void useModel(const BodyModel& model) = 0;

  /// Integrates on, until t or until one step more than is known. Throws NotComputable where it cannot go on.
  virtual void extendTo(double t) = 0;
  /// Up to here it is known.
  virtual double knownUntil() const = 0;
  /// Nothing of it comes later than that.
  virtual bool ended() const = 0;
  /// Steps so far.
  virtual std::size_t steps() const = 0;

  virtual State stateAt(double t) const = 0;
  virtual Vec3 positionAt(double t) const = 0;
  virtual Vec3 velocityAt(double t) const = 0;
  /// d(state)/dt; of two steps that meet at t the one before.
  virtual StateDerivative rateAt(double t) const = 0;
  /// Over all that is known.
  virtual PathBounds bounds() const = 0;
  /// Whether a contact slips on it, and whether one goes round the body.
  virtual bool slides() const = 0;
  virtual bool rolls() const = 0;
};

}  // namespace carom::adjoint_detail
