// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "adjoint/flight/flight_triaxial.hpp"
#include "adjoint/flight/variation_pass.hpp"

namespace carom::adjoint_detail {

namespace {

/// Radians below which eta would be a difference of nearly equal numbers, and series are short.
constexpr double kLeastTurn = 0.3;

/// Gauss and Legendre's rule of 16 points on [-1, 1]: the points on one side, and their weights.
constexpr std::array<std::pair<double, double>, 8> kGauss = {{{0.9894009349916499, 0.027152459411754096},
                                                              {0.9445750230732326, 0.062253523938647894},
                                                              {0.8656312023878318, 0.09515851168249279},
                                                              {0.755404408355003, 0.12462897125553388},
                                                              {0.6178762444026438, 0.14959598881657674},
                                                              {0.45801677765722737, 0.16915651939500254},
                                                              {0.2816035507792589, 0.18260341504492358},
                                                              {0.09501250983763744, 0.1894506104550685}}};

}  // namespace

Vec3 TriaxialRotation::bodyMomentumAt(double elapsed) const {
  if (closed_form_ && elapsed > endOfSegments()) return L_.norm() * closed_form_->directionAt(elapsed);
  const Segment& s = segmentAt(elapsed);
  const double h = elapsed - s.start;
  std::array<double, 4> u = s.u_psi[kOrder];
  for (std::size_t k = kOrder; k-- > 0;)
    for (std::size_t i = 0; i < 4; ++i) u[i] = u[i] * h + s.u_psi[k][i];
  return L_.norm() * Vec3(u[0], u[1], u[2]);
}

// In pieces of 5/4 of the distance of the nearest pole of M in complex time the rule leaves 1e-17. Segments are a seventh
// of it, and two of them one piece.
Vec3 TriaxialRotation::squaresOver(double elapsed, const Vec3& start) const {
  Vec3 sum = Vec3::Zero();
  const double distance = closed_form_ ? 1.25 * closed_form_->poleDistance() : elapsed;
  const double pieces = std::ceil(elapsed / distance), half = 0.5 * elapsed / pieces;
  const auto add = [&](double t, double weight) {
    const Vec3 M = bodyMomentumAt(t);
    sum += weight * half * (M - start).cwiseProduct(M + start);
  };
  for (double piece = 0; piece < pieces; ++piece) {
    const double middle = (2 * piece + 1) * half;
    for (const auto& [point, weight] : kGauss) add(middle - point * half, weight), add(middle + point * half, weight);
  }
  return sum;
}

// Equal steps suit what is periodic: n of them to the distance of the pole leave exp(-2 pi n). From where the squares are
// even, half of them are the others again.
Vec3 TriaxialRotation::squaresOfPeriod(double period, const Vec3& start) const {
  constexpr double kSteps = 7;
  const double half = std::ceil(0.5 * kSteps * period / closed_form_->poleDistance());
  Vec3 sum = Vec3::Zero();
  for (double i = 0; i <= half; ++i) {
    const Vec3 M = L_.norm() * closed_form_->directionAt(closed_form_->evenTime() + 0.5 * period * i / half);
    sum += (i == 0 || i == half ? 0.5 : 1) * (M - start).cwiseProduct(M + start);
  }
  return sum * (period / half);
}

std::optional<RotationStretch<double>> TriaxialRotation::stretchOver(double elapsed, double times) const {
  if (!(L_.norm() * D_.maxCoeff() * elapsed > times * kLeastTurn)) return std::nullopt;
  if (!closed_form_ && segments_.size() > kSegments) return std::nullopt;  // where the closed form is singular
  const Mat3 end = orientationAt(elapsed).toRotationMatrix(), start = q_.toRotationMatrix();
  RotationStretch<double> s;
  s.D = D_;
  s.start = start.transpose() * L_, s.end = end.transpose() * L_;
  s.turned = end.transpose() * start;
  s.elapsed = elapsed;
  s.squares.setZero();
  if (!VariationPass<double>(s).isRegular(times)) return std::nullopt;
  double rest = elapsed;
  if (closed_form_) {
    const double period = 0.5 * closed_form_->period(), count = std::floor(elapsed / period);  // of the squares
    rest = std::max(0.0, std::fma(-period, count, elapsed));
    if (count > 0) s.squares = count * squaresOfPeriod(period, s.start);
  }
  s.squares += squaresOver(rest, s.start);
  return s;
}

RotationSensitivity TriaxialRotation::closedSensitivity(const RotationStretch<double>& stretch, bool products) const {
  const VariationPass<double> pass(stretch);
  const Mat3 R0 = q_.toRotationMatrix(), Rh = R0 * stretch.turned.transpose(), RG = Rh * pass.turnByStart();
  RotationSensitivity S;
  S.dtheta_dL = RG * R0.transpose();
  S.dtheta_dtheta = Mat3::Identity() + RG * skew(stretch.start) * R0.transpose();
  S.dtheta_dI = Rh * pass.turnByInertia();
  if (products) S.dtheta_dproducts = Rh * pass.turnByProducts();
  return S;
}

}  // namespace carom::adjoint_detail
