#include "tests/pairs/distance.h"

#include <algorithm>
#include <limits>

#include "tests/pairs/enumerate.h"
#include "tests/pairs/separation.h"

namespace carom::pairs {
namespace {

constexpr Real kInfinite = std::numeric_limits<Real>::infinity();

bool isHalfSpace(const Piece& piece) { return piece.kind == Piece::Kind::half_space; }

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

Real ballGap(const Placed& A, std::size_t i, const Placed& B, std::size_t j) {
  const auto &a = A.balls()[i], &b = B.balls()[j];
  const auto height = [](const Piece& half_space, const Solid::Ball& ball) {
    return dot(half_space.faces[0].normal, ball.centre - half_space.points[0]) - ball.radius;
  };
  if (isHalfSpace(A.pieces()[i])) return height(A.pieces()[i], b);
  if (isHalfSpace(B.pieces()[j])) return height(B.pieces()[j], a);
  return norm(a.centre - b.centre) - a.radius - b.radius;
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
    if (!(ballGap(A, i, B, j) < least)) return false;
    const Piece &a = A.pieces()[i], &b = B.pieces()[j];
    if (isHalfSpace(a) || isHalfSpace(b)) return true;
    if (direction && slab(a, b, *direction) > least) return false;
    const Vector between = A.balls()[i].centre - B.balls()[j].centre;
    return !(dot(between, between) > 0 && slab(a, b, unit(between)) > least);
  };
  const std::size_t first = known.hint ? known.hint->a.piece : 0, second = known.hint ? known.hint->b.piece : 0;
  look(first, second);
  for (std::size_t i = 0; i < A.pieces().size(); ++i)
    for (std::size_t j = 0; j < B.pieces().size(); ++j)
      if ((i != first || j != second) && mayBeNearer(i, j)) look(i, j);
  return result;
}

std::vector<Candidate> nearestOfPiecesWithin(const Placed& A, const Placed& B, Real distance) {
  std::vector<Candidate> all;
  for (std::size_t i = 0; i < A.pieces().size(); ++i)
    for (std::size_t j = 0; j < B.pieces().size(); ++j) {
      if (!(ballGap(A, i, B, j) < distance)) continue;
      Least here;
      here.cutoff = distance;
      enumerate(A.pieces()[i], static_cast<int>(i), B.pieces()[j], static_cast<int>(j), here);
      if (here.best.a.piece >= 0) all.push_back(here.best);
    }
  return all;
}

bool provenApart(const Placed& A, const Placed& B) {
  for (std::size_t i = 0; i < A.pieces().size(); ++i)
    for (std::size_t j = 0; j < B.pieces().size(); ++j) {
      if (ballGap(A, i, B, j) > 0) continue;
      Least here;
      here.cutoff = kInfinite;
      enumerate(A.pieces()[i], static_cast<int>(i), B.pieces()[j], static_cast<int>(j), here);
      if (here.best.a.piece < 0 || !(separationOf(A, B, here.best).width > 0)) return false;
    }
  return true;
}

std::vector<Candidate> candidatesWithin(const Placed& A, const Placed& B, Real distance) {
  Within found;
  found.cutoff = distance;
  for (std::size_t i = 0; i < A.pieces().size(); ++i)
    for (std::size_t j = 0; j < B.pieces().size(); ++j)
      if (ballGap(A, i, B, j) < distance)
        enumerate(A.pieces()[i], static_cast<int>(i), B.pieces()[j], static_cast<int>(j), found);
  return found.all;
}

}  // namespace carom::pairs
