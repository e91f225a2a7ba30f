// SPDX-License-Identifier: MIT
#include "adjoint/contact/ball_sensitivity.hpp"

#include "adjoint/contact/level_glide_turn.hpp"
#include "adjoint/contact/turn_integrals.hpp"

namespace carom::adjoint_detail {
namespace {

// Rates of a vector, and of a number, by the inputs of a path that a ball has: velocity, angular momentum, gravity and
// normal, then friction, mass, moment of inertia and radius.
using Sensitivity = Eigen::Matrix<double, 12, 27>;
using Rates = Eigen::Matrix<double, 3, 16>;
using RatesOfNumber = Eigen::Matrix<double, 1, 16>;
enum Input { kVelocity = 0, kMomentum = 3, kGravity = 6, kNormal = 9, kFriction = 12, kMass, kInertia, kReach };

struct Ball {
  const PathInputs<double>& in;
  const Vec3& n = in.normal;
  double I = ballInertia(in), k = I / (in.mass * in.reach * in.reach);

  // Of the part along the face of the vector that is the input `by`.
  Rates along(const Vec3& vector, Input by) const {
    Rates d = Rates::Zero();
    d.middleCols<3>(by) = Mat3::Identity() - n * n.transpose();
    d.middleCols<3>(kNormal) = -(n * vector.transpose());
    d.middleCols<3>(kNormal).diagonal().array() -= n.dot(vector);
    return d;
  }
  Rates spin() const {
    Rates d = Rates::Zero();
    d.middleCols<3>(kMomentum).diagonal().setConstant(1 / I);
    d.col(kInertia) = -in.L / (I * I);
    return d;
  }
  Rates slip() const {  // v - w x n r
    const Vec3 w = in.L / I;
    Rates d = along(in.v, kVelocity) + in.reach * (skew(n) * spin());
    d.middleCols<3>(kNormal) -= in.reach * skew(w);
    d.col(kReach) += n.cross(w);
    return d;
  }
  RatesOfNumber shareOfInertia() const {  // of log k
    RatesOfNumber d = RatesOfNumber::Zero();
    d[kInertia] = 1 / I, d[kMass] = -1 / in.mass, d[kReach] = -2 / in.reach;
    return d;
  }
};

struct Ends {
  Rates x, v, w;
  Vec3 spin;  // w itself
};

Sensitivity assembled(const Ball& ball, const Ends& end, const Mat3& E, const Rates& theta) {
  Sensitivity out;
  auto& J = out;
  J.setZero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.block<3, 3>(3, 3) = E;
  Rates L = ball.I * end.w;
  L.col(kInertia) += end.spin;
  const auto put = [&](const Rates& rates, int row) {
    J.block<3, 12>(row, 6) = rates.leftCols<12>();
    J.block<3, 2>(row, 18) = rates.middleCols<2>(kFriction);
    for (int i = 20; i < 23; ++i) J.block<3, 1>(row, i) = rates.col(kInertia) / 3;
    J.block<3, 1>(row, 26) = rates.col(kReach);
  };
  put(end.x, 0), put(theta, 3), put(end.v, 6), put(L, 9);
  return out;
}

Sensitivity rolling(const Ball& ball, double t, bool orientation) {
  const PathInputs<double>& in = ball.in;
  const double stopped = in.friction > 0 ? ball.k / (1 + ball.k) : 0;  // of the slip, at once
  const Vec3 &n = ball.n, along = alongFace(n, in.v), slip = along - (in.L / ball.I).cross(n) * in.reach;
  const Vec3 v0 = along - stopped * slip, a = alongFace(n, in.gravity) / (1 + ball.k);
  const Rates dv0 = ball.along(in.v, kVelocity) - stopped * ball.slip() - slip * (stopped * (1 - stopped) * ball.shareOfInertia());
  Rates da = ball.along(in.gravity, kGravity) / (1 + ball.k);
  da -= a * (ball.k / (1 + ball.k) * ball.shareOfInertia());
  const Vec3 pivot = n * (n.dot(in.L) / ball.I);
  Rates dpivot = Rates::Zero();
  dpivot.middleCols<3>(kMomentum) = n * n.transpose() / ball.I;
  dpivot.middleCols<3>(kNormal) = (n * in.L.transpose() + n.dot(in.L) * Mat3::Identity()) / ball.I;
  dpivot.col(kInertia) = -pivot / ball.I;
  // n x v/r
  const auto rolled = [&](const Vec3& v, const Rates& dv) {
    Rates d = skew(n) * dv / in.reach;
    d.middleCols<3>(kNormal) -= skew(v) / in.reach;
    d.col(kReach) -= n.cross(v) / (in.reach * in.reach);
    return d;
  };
  Ends end;
  const Vec3 v = v0 + a * t;
  end.x = dv0 * t + da * (0.5 * t * t);
  end.v = dv0 + da * t;
  end.w = rolled(v, end.v) + dpivot;
  end.spin = n.cross(v) / in.reach + pivot;
  if (!orientation) return assembled(ball, end, Mat3::Zero(), Rates::Zero());
  const TurnIntegrals<double> turn(n.cross(v0) / in.reach + pivot, n.cross(a) / in.reach, t);
  return assembled(ball, end, turn.E, turn.E * (turn.M0 * (rolled(v0, dv0) + dpivot) + turn.M1 * rolled(a, da)));
}

Sensitivity sliding(const Ball& ball, const GlidePath<double>& path, double elapsed, bool orientation) {
  const PathInputs<double>& in = ball.in;
  const Vec3 &n = ball.n, &s0 = path.slip().start(), &lever = path.lever(), &w0 = path.startSpin();
  const double c = path.slip().friction(), T = *path.end(), t = std::min(elapsed, T), x = t / T, y = 1 - x;
  const double share = ball.k / (1 + ball.k), by_lever = (1 - share) / in.reach;
  const Vec3 d = s0.normalized();

  const Rates dw0 = ball.spin(), ds0 = ball.slip();
  const Rates dv0 = ball.along(in.v, kVelocity), dg = ball.along(in.gravity, kGravity);
  const RatesOfNumber dshare = share * (1 - share) * ball.shareOfInertia();
  RatesOfNumber dc = -c / share * dshare;  // c = mu g_n/share
  dc[kFriction] += pressingGravity(in) / share;
  dc.segment<3>(kGravity) -= in.friction / share * n.transpose();
  dc.segment<3>(kNormal) -= in.friction / share * in.gravity.transpose();
  RatesOfNumber dby_lever = -dshare / in.reach;
  dby_lever[kReach] -= by_lever / in.reach;
  Rates dlever = n * dby_lever;
  dlever.middleCols<3>(kNormal).diagonal().array() += by_lever;

  // Along d the slip shrinks as it does; across, it keeps its share y, and a slope adds -T y log y.
  const RatesOfNumber ds0_along = d.transpose() * ds0, dg_along = d.transpose() * dg;
  const double bent = T * (x - bentSlip(x)), bent_covered = T * T * (0.5 * x * x - bentSlipIntegral(x));
  const double covered = t * (1 - 0.5 * x);
  const Rates ds = y * ds0 + bent * dg + d * (x * ds0_along + (t - bent) * dg_along - t * dc);
  const Rates dcovered = covered * ds0 + bent_covered * dg +
                         d * ((t - covered) * ds0_along + (0.5 * t * t - bent_covered) * dg_along - 0.5 * t * t * dc);
  Ends end;
  end.v = dv0 + t * dg + share * (ds - ds0 - t * dg) - s0 * (x * dshare);
  end.x = t * dv0 + 0.5 * t * t * dg + share * (dcovered - t * ds0 - 0.5 * t * t * dg) -
          s0 * ((t - covered) * dshare);
  end.w = dw0 + skew(lever) * (t * dg + ds0 - ds) - skew(Vec3(x * s0)) * dlever;
  end.spin = w0 + lever.cross(x * s0);
  if (!orientation) return assembled(ball, end, Mat3::Zero(), Rates::Zero());
  const LevelGlideTurn turn(w0, lever.cross(d) * c, d, t, T);
  const Rates drate = skew(lever) * (d * dc + (ds0 - d * ds0_along) / T) - skew(Vec3(s0 / T)) * dlever;
  const RatesOfNumber dg_across = n.cross(d).transpose() * dg;
  return assembled(ball, end, turn.E,
                   turn.E * (turn.M0 * dw0 + turn.M1 * drate - turn.bend * (by_lever * T * dg_across)));
}

}  // namespace

std::optional<Eigen::Matrix<double, 12, 27>> ballSensitivity(PathForm form, const PathInputs<double>& in,
                                                             double elapsed, bool orientation) {
  if (form == PathForm::roll_ball) return rolling({in}, elapsed, orientation);
  if (form != PathForm::glide_ball) return std::nullopt;
  const GlidePath<double> path = GlidePath<double>::ball(in);
  const bool level = carom::isZero(path.slip().slope()) && path.slip().friction() > 0;
  if (!level || !path.slip().moving() || !path.end()) return std::nullopt;
  return sliding({in}, path, elapsed, orientation);
}

}  // namespace carom::adjoint_detail
