// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <optional>

#include "adjoint/contact/glide_path.hpp"
#include "adjoint/contact/rest_path.hpp"
#include "adjoint/contact/roll_path.hpp"
#include "adjoint/flight/trajectory.hpp"
#include "adjoint/scene/body_model.h"

/// Lasting contact with one fixed face in closed form, in any kind of number: docs/equations.md, section 11.
namespace carom::adjoint_detail {

/// Calls f with the path of a form.
template <class S, class F>
auto withPath(PathForm form, const PathInputs<S>& in, F f) {
  switch (form) {
    case PathForm::glide_ball: return f(GlidePath<S>::ball(in));
    case PathForm::glide_block: return f(GlidePath<S>::block(in));
    case PathForm::roll_ball: return f(RollPath<S>::ball(in));
    case PathForm::roll_axle: return f(RollPath<S>::axle(in));
    case PathForm::rest:
    case PathForm::held: break;
  }
  return f(RestPath<S>{in});
}
inline bool glides(PathForm form) { return form == PathForm::glide_ball || form == PathForm::glide_block; }
template <class S>
GlidePath<S> glideOf(PathForm form, const PathInputs<S>& in) {
  return form == PathForm::glide_ball ? GlidePath<S>::ball(in) : GlidePath<S>::block(in);
}

/// A time after the start; of a glide not past the end of its slip, where it stays.
/// `turning`: with the orientation.
template <class S>
PathState<S> pathStateAt(PathForm form, const PathInputs<S>& in, const S& elapsed, bool turning = true) {
  return withPath<S>(form, in, [&](const auto& path) { return path.stateAt(elapsed, turning); });
}
/// The centre of mass alone.
template <class S>
PathCenter<S> pathCenterAt(PathForm form, const PathInputs<S>& in, const S& elapsed) {
  return withPath<S>(form, in, [&](const auto& path) { return path.centerAt(elapsed); });
}
/// d(state)/dt; at the end of slip the limit from before.
template <class S>
StateDerivativeOf<S> pathRateAt(PathForm form, const PathInputs<S>& in, const S& elapsed) {
  return withPath<S>(form, in, [&](const auto& path) { return path.rateAt(elapsed); });
}

/// How long a glide takes until its slip is 0: nothing where it never is, and for other forms.
template <class S>
std::optional<S> slipEnd(PathForm form, const PathInputs<S>& in) {
  if (!glides(form)) return std::nullopt;
  return glideOf(form, in).end();
}
/// There the slip is exactly 0: a ball rolls, a block rests. `form`: a glide that ends.
template <class S>
PathState<S> pathStateAtSlipEnd(PathForm form, const PathInputs<S>& in, bool turning = true) {
  return glideOf(form, in).stateAtEnd(turning);
}
/// Unit vector along the slip of a glide; at the end the limit. Zero where there is no slip, and no slope to start it.
template <class S>
V3<S> slipDirectionAt(PathForm form, const PathInputs<S>& in, const S& elapsed) {
  return glideOf(form, in).directionAt(elapsed);
}

/// Of a closed form.
TrajectoryBounds pathBounds(PathForm form, const PathInputs<double>& in, double from, double until);

/// A path in contact with one face, with what its derivative needs of the scene.
struct ContactPath {
  PathForm form = PathForm::rest;
  /// How little changes would move a body that is at rest: `rest` where they would not, or where that is not known.
  PathForm when_varied = PathForm::rest;
  /// At rest: nothing opposes some motion of it, and `when_varied` does not tell where that would go.
  bool loose = false;
  PathInputs<double> inputs;
  TrajectoryBounds bounds;  ///< over the whole arc
  int body = -1;      ///< which is on the path
  int face = -1;      ///< the fixed body that has the face
  Eigen::RowVectorXd reach_rates;  ///< of the reach by the dimensions of the body
  double start = 0;   ///< s
  /// Elapsed at the end of slip, where the slip is exactly 0; infinite where there is none.
  double slip_end = std::numeric_limits<double>::infinity();

  /// That whose derivatives are this one's.
  PathForm variedForm() const { return form == PathForm::rest ? when_varied : form; }
  /// At that end, start + slip_end, exactly slip_end.
  double elapsedAt(double t) const { return t < start + slip_end ? t - start : slip_end; }
  /// `turning`: with the orientation; else it stays that of the start.
  State stateAt(const State& start_state, double t, bool turning = true) const;
  /// Until then a number of series carry the orientation.
  double followedUntil(double series) const;
};

/// The first time in (0, until] at which weight.(x + ahead * slip direction) falls through `value`: nothing where it
/// does not. `ahead` is 0 for what does not slide.
std::optional<double> firstDescent(PathForm form, const PathInputs<double>& in, const Vec3& weight, double ahead,
                                   double value, double until);

}  // namespace carom::adjoint_detail
