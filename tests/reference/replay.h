// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom::reference {

/// One impact of the sequence that a replay follows. Time, point and normal (from b to a) need only be good enough to
/// recognise the features that touch; the replay finds their exact values itself.
struct Impact {
  double time = 0;
  int a = -1, b = -1;
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();
};
using Sequence = std::vector<Impact>;

/// The sequence by brute force: separations sampled densely along the replayed flights. Knows nothing of the product.
Sequence scout(const Scene& scene, double duration);

/// One number of a scene that can vary.
struct Knob {
  int kind = 0;   ///< row of the table in knobs.cpp
  int index = 0;  ///< body, material or tilt
  int component = 0;
  std::string name;  ///< such as "velocity[1].z"
};
/// In the order of the kinds.
std::vector<Knob> knobsOf(const Scene& scene);
/// The entry of a gradient or tangent that belongs to a knob.
double& entryOf(SceneDerivative& derivative, const Knob& knob);

/// One scalar of the motion: component 0..11 = position, rotation vector, velocity, angular velocity; 12 = time of the
/// event. Read at `time`, or just before `event` unless that is -1.
struct Row {
  int body = -1;
  int event = -1;
  double time = 0;
  int component = 0;
};
inline constexpr int kTimeComponent = 12;
std::string describe(const Row& row);

/// What the derivative does with impact times: they follow the causes, or (wrongly, to see that it matters) stay.
enum class ImpactTimes { follow, frozen };

/// A scene replayed in 50-digit arithmetic along a given impact sequence, with features and impact modes frozen.
/// Throws std::runtime_error where the sequence cannot be followed.
class Reference {
 public:
  Reference(const Scene& scene, const Sequence& sequence);
  ~Reference();
  Reference(Reference&&) noexcept;

  int events() const;
  double eventTime(int event) const;
  ImpactMode mode(int event) const;
  const std::string& features(int event) const;
  Vec3 impulse(int event) const;  ///< on body a
  BodyState stateAt(int body, double t) const;
  BodyState stateBefore(int event, int body) const;
  /// d(rows)/d(knob) by differences in the same arithmetic; their error is far below double rounding.
  std::vector<double> derivative(const Knob& knob, const std::vector<Row>& rows,
                                 ImpactTimes times = ImpactTimes::follow) const;
  /// For each of some knobs, the rate of `derivative(knob, rows)` as all knobs of the scene change along `direction`
  /// (one number a knob of knobsOf) and the times of rows that are read at a time at the rate `dtime`: by central
  /// differences of differences.
  std::vector<std::vector<double>> secondDerivatives(const std::vector<double>& direction, double dtime,
                                                     const std::vector<Knob>& knobs,
                                                     const std::vector<Row>& rows) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// Free rotation alone: orientation and sensitivities, of a body with R(0) = R(q) and world momentum L, at some times.
struct Rotation {
  Mat3 R;
  Mat3 dtheta_dtheta, dtheta_dL, dtheta_dI;  ///< each with the other two held; zero unless asked for
};
std::vector<Rotation> freeRotation(const Vec3& inertia, const Quat& q, const Vec3& L, const std::vector<double>& times,
                                   bool sensitivities);

}  // namespace carom::reference
