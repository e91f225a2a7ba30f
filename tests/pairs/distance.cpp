// SPDX-License-Identifier: MIT
#include "tests/pairs/distance.h"

#include <algorithm>
#include <limits>

#include "tests/pairs/enumerate.h"
#include "tests/pairs/separation.h"

namespace carom::pairs {
namespace {

constexpr Real kTouchingBalls = 1e-15L;  // m; balls farther apart than this, which rounding cannot take away, part

class Least final : public Collector {
 public:
  Candidate best;
  void add(const Candidate& c) override {
    if (c.distance < cutoff || best.a.piece < 0) cutoff = c.distance, best = c;
  }
};

class Within final : public Collector {
 public:
  std::vector<Candidate> all;
  void add(const Candidate& c) override { all.push_back(c); }
};

bool nearerThan(const Solid::Ball& a, const Solid::Ball& b, Real distance) {
  const Real reach = a.radius + b.radius + distance;
  const Vector between = a.centre - b.centre;
  return reach > 0 && dot(between, between) < reach * reach;
}

bool ballsWithin(const Placed& A, std::size_t i, const Placed& B, std::size_t j, Real distance) {
  const auto &a = A.balls()[i], &b = B.balls()[j];
  const auto height = [](const Piece& half_space, const Solid::Ball& ball) {
    return dot(half_space.faces[0].normal, ball.centre - half_space.points[0]) - ball.radius;
  };
  if (isHalfSpace(A.pieces()[i])) return height(A.pieces()[i], b) < distance;
  if (isHalfSpace(B.pieces()[j])) return height(B.pieces()[j], a) < distance;
  return nearerThan(a, b, distance);
}

// The pieces whose balls are nearer to the ball of all of the other solid.
std::vector<std::size_t> nearTo(const Solid::Ball& whole, const Placed& A, Real distance) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < A.balls().size(); ++i)
    if (nearerThan(A.balls()[i], whole, distance)) near.push_back(i);
  return near;
}

}  // namespace

std::optional<Touch> Candidate::touch(const Placed& A, const Placed& B) const {
  return exact::touchOf(A.pieces()[a.piece].feature(a), B.pieces()[b.piece].feature(b), side, p, q);
}

Distance distanceOf(const Placed& A, const Placed& B, const Known& known) {
  Distance result;
  result.proven = kInfinite;
  Real least = known.at_most;
  std::optional<Vector> direction;  // at right angles to which the nearest pieces so far are apart
  const auto look = [&](std::size_t i, std::size_t j) {
    Least here;
    here.cutoff = least;
    enumerate(A.pieces()[i], static_cast<int>(i), B.pieces()[j], static_cast<int>(j), here);
    if (here.best.a.piece < 0) return;  // all features are farther apart than the nearest so far
    const Separation proof = separationOf(A, B, here.best);
    result.proven = std::min(result.proven, proof.width);
    if (here.cutoff < least || result.nearest.a.piece < 0)
      least = here.cutoff, result.nearest = here.best, direction = proof.normal;
  };
  const auto mayBeNearer = [&](std::size_t i, std::size_t j) {
    if (!ballsWithin(A, i, B, j, least)) return false;
    const Piece &a = A.pieces()[i], &b = B.pieces()[j];
    if (isHalfSpace(a) || isHalfSpace(b)) return true;
    if (direction && slab(a, b, *direction) > least) return false;
    const Vector between = A.balls()[i].centre - B.balls()[j].centre;
    return !(dot(between, between) > 0 && slab(a, b, unit(between)) > least);
  };
  const std::size_t first = known.hint ? known.hint->a.piece : 0, second = known.hint ? known.hint->b.piece : 0;
  look(first, second);
  for (const auto& [i, j] : piecesWithin(A, B, least))
    if ((i != first || j != second) && mayBeNearer(i, j)) look(i, j);
  return result;
}

std::vector<std::pair<std::size_t, std::size_t>> piecesWithin(const Placed& A, const Placed& B, Real distance) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  const std::vector<std::size_t> of_b = nearTo(A.whole(), B, distance);
  for (const std::size_t i : nearTo(B.whole(), A, distance))
    for (const std::size_t j : of_b)
      if (ballsWithin(A, i, B, j, distance)) pairs.emplace_back(i, j);
  return pairs;
}

std::optional<Candidate> nearestOfPieces(const Placed& A, std::size_t i, const Placed& B, std::size_t j,
                                         Real distance) {
  Least here;
  here.cutoff = distance;
  enumerate(A.pieces()[i], static_cast<int>(i), B.pieces()[j], static_cast<int>(j), here);
  if (here.best.a.piece < 0) return {};
  return here.best;
}

bool provenApart(const Placed& A, const Placed& B) {
  for (const auto& [i, j] : piecesWithin(A, B, kTouchingBalls)) {
    const std::optional<Candidate> nearest = nearestOfPieces(A, i, B, j, kInfinite);
    if (!nearest || !(separationOf(A, B, *nearest).width > 0)) return false;
  }
  return true;
}

std::vector<Candidate> candidatesWithin(const Placed& A, const Placed& B, Real distance) {
  Within found;
  found.cutoff = distance;
  for (const auto& [i, j] : piecesWithin(A, B, distance))
    enumerate(A.pieces()[i], static_cast<int>(i), B.pieces()[j], static_cast<int>(j), found);
  return found.all;
}

}  // namespace carom::pairs
