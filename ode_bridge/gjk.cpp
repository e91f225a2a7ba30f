// SPDX-License-Identifier: MIT
#include "ode_bridge/gjk.hpp"

#include <cmath>
#include <limits>

namespace carom::ode_bridge_detail {
namespace {

constexpr int kMostSimplexRounds = 80;
constexpr double kClose = 1e-8;  // share of the distance that bounds may differ by

// A point of the difference a - b, with where it comes from.
struct Corner {
  Vec3 w, a, b;
};

// A subset of the corners and the weights of the point of its hull nearest to the origin.
struct Mix {
  int count = 0;
  std::array<int, 4> of{};
  std::array<double, 4> weight{};
  Vec3 nearest = Vec3::Zero();
  double square = std::numeric_limits<double>::infinity();
};

class Simplex {
 public:
  void add(const Corner& c) { corners_[static_cast<std::size_t>(count_++)] = c; }
  int count() const { return count_; }
  const Corner& operator[](int i) const { return corners_[static_cast<std::size_t>(i)]; }
  bool has(const Vec3& w) const {
    for (int i = 0; i < count_; ++i)
      if ((*this)[i].w == w) return true;
    return false;
  }

  // The nearest point by trying every subset that has the corner added last, which any nearer point needs: never misled
  // by a flat simplex, which a case analysis can be.
  Mix nearest() const {
    Mix best;
    const int last = count_ - 1;
    point(last, best);
    for (int i = 0; i < last; ++i) segment(i, last, best);
    for (int i = 0; i < last; ++i)
      for (int j = i + 1; j < last; ++j) triangle(i, j, last, best);
    if (count_ == 4) tetrahedron(best);
    return best;
  }

  void keep(const Mix& mix) {
    std::array<Corner, 4> kept;
    for (int i = 0; i < mix.count; ++i)
      kept[static_cast<std::size_t>(i)] = (*this)[mix.of[static_cast<std::size_t>(i)]];
    corners_ = kept;
    count_ = mix.count;
  }

 private:
  void offer(const Mix& mix, Mix& best) const {
    if (mix.square < best.square) best = mix;
  }

  void point(int i, Mix& best) const {
    const Vec3& w = (*this)[i].w;
    offer({1, {i}, {1}, w, w.squaredNorm()}, best);
  }

  void segment(int i, int j, Mix& best) const {
    const Vec3 &p = (*this)[i].w, &q = (*this)[j].w, d = q - p;
    const double length = d.squaredNorm();
    if (!(length > 0)) return;
    const double t = -p.dot(d) / length;
    if (!(t > 0 && t < 1)) return;
    // from the end that is nearer to the foot, so that little cancels
    const Vec3 foot = t <= 0.5 ? Vec3(p + t * d) : Vec3(q - (q.dot(d) / length) * d);
    offer({2, {i, j}, {1 - t, t}, foot, foot.squaredNorm()}, best);
  }

  void triangle(int i, int j, int k, Mix& best) const {
    const Vec3 &p = (*this)[i].w, &q = (*this)[j].w, &r = (*this)[k].w;
    const Vec3 n = (q - p).cross(r - p);
    const double square = n.squaredNorm();
    if (!(square > 1e-28 * (q - p).squaredNorm() * (r - p).squaredNorm())) return;
    const double u = n.dot(q.cross(r)) / square, v = n.dot(r.cross(p)) / square, s = n.dot(p.cross(q)) / square;
    if (!(u > 0 && v > 0 && s > 0)) return;
    const Vec3 foot = n * (n.dot(p) / square);
    offer({3, {i, j, k}, {u, v, s}, foot, foot.squaredNorm()}, best);
  }

  void tetrahedron(Mix& best) const {
    const Vec3 &p = (*this)[0].w, &q = (*this)[1].w, &r = (*this)[2].w, &s = (*this)[3].w;
    const double volume = (q - p).dot((r - p).cross(s - p));
    const double scale = (q - p).norm() * (r - p).norm() * (s - p).norm();
    if (!(std::abs(volume) > 1e-14 * scale)) return;  // flat: its triangles say all
    const double a = q.dot(r.cross(s)) / volume, b = -p.dot(r.cross(s)) / volume, c = p.dot(q.cross(s)) / volume;
    const double d = -p.dot(q.cross(r)) / volume;
    // where rounding decides the volume, the weights do not add up
    if (!(std::abs(a + b + c + d - 1) <= 1e-6)) return;
    if (a > 0 && b > 0 && c > 0 && d > 0) offer({4, {0, 1, 2, 3}, {a, b, c, d}, Vec3::Zero(), 0}, best);
  }

  int count_ = 0;
  std::array<Corner, 4> corners_;
};

}  // namespace

CoreDistance coreDistance(const PlacedPiece& a, const PlacedPiece& b, const Vec3& guess) {
  const Mat3 &Ra = a.body->k.R, &Rb = b.body->k.R;
  const Vec3 D = a.body->k.x - b.body->k.x;
  // the corner of a - b that lies least along a direction
  const auto corner = [&](const Vec3& direction) {
    const Vec3 p = D + Ra * supportOf(a.solid(), *a.piece, -(Ra.transpose() * direction)).at;
    const Vec3 q = Rb * supportOf(b.solid(), *b.piece, Rb.transpose() * direction).at;
    return Corner{p - q, p, q};
  };
  CoreDistance result;
  Simplex simplex;
  Mix mix;
  simplex.add(corner(guess));
  double shortest = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMostSimplexRounds; ++round) {
    const Mix found = simplex.nearest();
    if (round > 0 && !(found.square < shortest)) break;
    if (found.count == 4 && result.lower > 0) break;  // a direction is known along which they are apart
    mix = found;
    shortest = found.square;
    simplex.keep(mix);
    if (mix.count == 4 || !(shortest > 0)) {
      result.overlap = true;
      break;
    }
    const double length = std::sqrt(shortest);
    const Vec3 n = mix.nearest / length;
    const Corner next = corner(n);
    if (const double bound = n.dot(next.w); bound > result.lower || round == 0) result.lower = bound, result.normal = n;
    if (length - n.dot(next.w) <= kClose * length || simplex.has(next.w)) break;
    simplex.add(next);
  }
  result.from_b_to_a = mix.nearest;
  result.upper = std::sqrt(mix.square);
  result.count = mix.count;
  result.at_a.setZero();
  result.at_b.setZero();
  for (int i = 0; i < mix.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    result.of_a[k] = simplex[i].a;
    result.of_b[k] = simplex[i].b;
    result.at_a += mix.weight[k] * simplex[i].a;
    result.at_b += mix.weight[k] * simplex[i].b;
  }
  return result;
}

}  // namespace carom::ode_bridge_detail
