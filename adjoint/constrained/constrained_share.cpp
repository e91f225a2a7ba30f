// SPDX-License-Identifier: MIT
#include "adjoint/constrained/constrained_share.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "adjoint/contact/interior_point.hpp"
#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/symmetric_eigen.hpp"

namespace carom::adjoint_detail {
namespace {

using Eigen::Index;

// No push is looked for beyond so many times the forces: two contacts between which a body is wedged bear any.
constexpr double kMostPush = 1e6;
constexpr double kSamePush = 1e-16;
// Rooms that differ by a smaller share of the forces are the same.
constexpr double kSameRoom = 1e-12;
// Contacts nearer to each other than this share of their arms are at one point: the line between them is rounding.
constexpr double kSamePoint = 1e-9;
// The interior point goes on until the room is known to this share of the forces, or no better.
constexpr double kRoomKnown = 1e-15;
constexpr int kRoomSteps = 60, kNoBetter = 4;
// Forces across the normal that are a smaller share of all forces have no direction.
constexpr double kAtApex = 1e-6;

Vec3 acrossNormal(const Vec3& n, const Vec3& f) { return f - n.dot(f) * n; }

// The smaller of two concave functions is concave: its maximum is where its slope changes sign.
ConstrainedShare shareOfPair(const ShareSide& a, const ShareSide& b, const Vec3& along) {
  const double size = std::max(a.force.norm(), b.force.norm());
  const auto roomOfA = [&](double push) { return a.room(-push * along); };
  const auto roomOfB = [&](double push) { return b.room(push * along); };
  const auto slopeOfA = [&](double push) { return a.slope(-push * along, -along); };
  const auto slopeOfB = [&](double push) { return b.slope(push * along, along); };
  const auto slopeAt = [&](double push) { return roomOfA(push) < roomOfB(push) ? slopeOfA(push) : slopeOfB(push); };
  double low = -kMostPush * size, high = kMostPush * size;
  while (high - low > kSamePush * size) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) break;
    (slopeAt(middle) > 0 ? low : high) = middle;
  }
  ConstrainedShare share;
  share.push = {-low * along, low * along};
  const double room_a = roomOfA(low), room_b = roomOfB(low);
  const double slope_a = slopeOfA(low), slope_b = slopeOfB(low), turn = slope_a - slope_b;
  if (std::abs(room_a - room_b) <= kSameRoom * size && slope_a * slope_b < 0) {
    share.weight = {-slope_b / turn, slope_a / turn};
  } else if (room_a < room_b) {
    share.weight = {1, 0};
  } else {
    share.weight = {0, 1};
  }
  for (const std::size_t i : {0u, 1u}) {
    const ShareSide& side = i == 0 ? a : b;
    const Vec3 f_t = acrossNormal(side.n, side.force + share.push[i]);
    const double length = f_t.norm();
    share.turn.push_back(length > 0 ? Vec3(-share.weight[i] / length * f_t) : Vec3(Vec3::Zero()));
  }
  return share;
}

// Columns of an orthonormal basis of the forces without sum and moment; three rows a contact.
Eigen::MatrixXd forcesWithoutEffect(const std::vector<ShareSide>& sides) {
  double length = 0;
  for (const ShareSide& side : sides) length = std::max(length, side.r.norm());
  if (!(length > 0)) length = 1;
  const auto n = static_cast<Index>(sides.size());
  Eigen::MatrixXd W(6, 3 * n);
  for (Index k = 0; k < n; ++k)
    W.middleCols<3>(3 * k) << Mat3::Identity(), skew(sides[static_cast<std::size_t>(k)].r) / length;
  const ThinSvd svd(W);
  Index rank = 0;
  while (rank < svd.s.size() && svd.s[rank] > kSamePoint * svd.s[0]) ++rank;
  const Eigen::MatrixXd range = svd.V.leftCols(rank);
  const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(3 * n, 3 * n) - range * range.transpose();
  return SymmetricEigen<double>(left).vectors.rightCols(3 * n - rank);
}

// The interior point knows the room to rounding, the duals z of the cones s to its root. Where a cone is at its border they are along its
// reflection, z = lambda (1, -s_t/|s_t|), which leaves D^T z = b with one unknown each.
Eigen::VectorXd polishedDuals(const Eigen::MatrixXd& D, const Eigen::VectorXd& b, const Eigen::VectorXd& s, const Eigen::VectorXd& z) {
  const Index cones = z.size() / 3;
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(z.size(), z.size());
  Index unknowns = 0;
  for (Index k = 0; k < cones; ++k) {
    const Eigen::Vector3d of = s.segment<3>(3 * k);
    const double across = of.tail<2>().norm();
    if (!(z[3 * k] > of[0] - across)) continue;  // inside: 0
    if (across > kAtApex) {
      basis.block<3, 1>(3 * k, unknowns++) << 1, -of.tail<2>() / across;
    } else {
      for (Index i = 0; i < 3; ++i) basis(3 * k + i, unknowns++) = 1;
    }
  }
  basis.conservativeResize(Eigen::NoChange, unknowns);
  if (unknowns == 0) return z;
  const Eigen::VectorXd polished = basis * CompleteOrthogonal(D.transpose() * basis, kSameRoom).solve(b);
  const auto left = [&](const Eigen::VectorXd& of) { return (D.transpose() * of - b).norm(); };
  return polished.allFinite() && left(polished) <= left(z) ? polished : z;
}

// The most s such that all cones keep that room: a program of second order in s and the forces without effect.
ConstrainedShare shareOfMany(const std::vector<ShareSide>& sides) {
  const auto n = static_cast<Index>(sides.size());
  double size = 0;
  for (const ShareSide& side : sides) size = std::max(size, side.force.norm());
  if (!(size > 0)) size = 1;
  const Eigen::MatrixXd without = forcesWithoutEffect(sides);
  const Index free = without.cols();
  Eigen::MatrixXd D(3 * n, free + 1);
  Eigen::VectorXd a(3 * n), b = Eigen::VectorXd::Zero(free + 1);
  std::vector<Mat3> rows;  // mu n and two directions across it
  for (Index k = 0; k < n; ++k) {
    const ShareSide& side = sides[static_cast<std::size_t>(k)];
    Mat3 row;
    const Vec3 t = side.n.unitOrthogonal();
    row << side.friction * side.n.transpose(), t.transpose(), side.n.cross(t).transpose();
    rows.push_back(row);
    D.middleRows<3>(3 * k) << row * without.middleRows<3>(3 * k), -Vec3::UnitX();
    a.segment<3>(3 * k) = row * side.force / size;
  }
  b[free] = -1;
  InteriorPoint point(D, a, b, std::vector<int>(sides.size(), 3));
  InteriorPoint best = point;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0, since = 0; i < kRoomSteps && since < kNoBetter; ++i) {
    point.step();
    if (!std::isfinite(point.gap()) || !point.unknowns().allFinite()) break;
    if (point.gap() < kRoomKnown) {
      best = point;
      break;
    }
    // Where many shares are as good, rounding takes it away again.
    const double off = std::max(point.gap(), point.unbalanced());
    since = off < least ? 0 : since + 1;
    if (since == 0) least = off, best = point;
  }
  ConstrainedShare share;
  const Eigen::VectorXd duals = polishedDuals(D, b, D * best.unknowns() + a, best.duals());
  const Eigen::VectorXd push = size * (without * best.unknowns().head(free));
  for (Index k = 0; k < n; ++k) {
    share.push.push_back(push.segment<3>(3 * k));
    const Vec3 z = duals.segment<3>(3 * k);
    share.weight.push_back(z[0]);
    share.turn.push_back(rows[static_cast<std::size_t>(k)].bottomRows<2>().transpose() * z.tail<2>());
  }
  return share;
}

}  // namespace

double ShareSide::room(const Vec3& push) const {
  const Vec3 f = force + push;
  return friction * n.dot(f) - acrossNormal(n, f).norm();
}

double ShareSide::slope(const Vec3& push, const Vec3& along) const {
  const Vec3 f_t = acrossNormal(n, force + push), by = acrossNormal(n, along);
  const double length = f_t.norm();
  return friction * n.dot(along) - (length > 0 ? f_t.dot(by) / length : 0);
}

std::optional<ConstrainedShare> bestShare(const std::vector<ShareSide>& sides) {
  if (sides.size() < 2) return std::nullopt;
  if (sides.size() > 2) return shareOfMany(sides);
  const Vec3 between = sides[1].r - sides[0].r;
  const double arm = std::max(sides[0].r.norm(), sides[1].r.norm());
  if (!(between.norm() > kSamePoint * arm)) return shareOfMany(sides);
  return shareOfPair(sides[0], sides[1], between.normalized());
}

}  // namespace carom::adjoint_detail
