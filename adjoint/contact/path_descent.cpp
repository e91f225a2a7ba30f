// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/contact/contact_path.hpp"

namespace carom::adjoint_detail {
namespace {

// First root in (0, until] at which c0 + c1 t + c2 t^2 falls.
std::optional<double> fallOf(double c0, double c1, double c2, double until) {
  double root;
  const double discriminant = c1 * c1 - 4 * c2 * c0;
  if (c2 == 0) {
    if (!(c1 < 0)) return std::nullopt;
    root = -c0 / c1;
  } else {
    // It falls at the root where the slope is -sqrt(discriminant).
    if (!(discriminant > 0)) return std::nullopt;
    const double down = std::sqrt(discriminant);
    root = c1 < 0 ? 2 * c0 / (down - c1) : -(c1 + down) / (2 * c2);
  }
  if (!(root > 0 && root <= until)) return std::nullopt;
  return root;
}

// What falls, along a glide on a curve, on the clock of its slip, where all of it is smooth. Between two places it is
// nearer to its chord than the bound of its second derivative says: stretches that it cannot cross are passed over.
class CurvedDescent {
 public:
  CurvedDescent(const GlidePath<double>& path, const Vec3& weight, double ahead, double value)
      : path_(path), weight_(weight), ahead_(ahead), value_(value) {}

  std::optional<double> first(double until) const {
    const bool whole = path_.isPastEnd(until);
    const Place start = placeAt(0);
    if (!whole) return firstIn(start, placeAt(path_.slip().xiAt(until)), 0);
    // Beyond this the slip is nothing: what is left of the time is rounding.
    const double rate = path_.slip().friction() - path_.slip().slope().norm();
    const Place last = placeAt(40 / rate);
    if (const std::optional<double> found = firstIn(start, last, 0)) return found;
    const double end = *path_.end();
    if (last.y > 0 && heightAt(path_.centerAt(end).x, path_.directionAt(end)) <= 0) return end;
    return std::nullopt;
  }

 private:
  struct Place {
    double xi, t, y, speed, velocity;  // y: above the value; speed: of the slip; velocity: of the centre
  };

  double heightAt(const Vec3& x, const Vec3& direction) const {
    return weight_.dot(x) + ahead_ * weight_.dot(direction) - value_;
  }
  Place placeAt(double xi) const {
    const double t = path_.slip().timeAt(xi);
    const Slip<double> slip = path_.slip().onClock(xi);
    const PathCenter<double> center = path_.centerOf(slip, t);
    return {xi, t, heightAt(center.x, slip.direction), slip.s.norm(), center.v.norm()};
  }
  // Of d^2 y/d xi^2 between two places.
  double bend(const Place& a, const Place& b) const {
    const double slope = path_.slip().slope().norm(), friction = path_.slip().friction();
    const double speed = std::max(a.speed, b.speed), force = slope + friction;
    const double velocity = std::max(a.velocity, b.velocity) + force * (b.t - a.t);
    return weight_.norm() * (speed * force * (speed + velocity) + 2 * std::abs(ahead_) * slope * slope);
  }
  std::optional<double> firstIn(const Place& a, const Place& b, int depth) const {
    const double length = b.xi - a.xi, sag = bend(a, b) * length * length / 8;
    const double rounding = 1e-16 * (std::abs(value_) + std::abs(a.y) + std::abs(b.y));
    if (std::min(a.y, b.y) > sag || std::max(a.y, b.y) < -sag) return std::nullopt;
    if (depth == 60 || length <= 4e-16 * b.xi || sag <= rounding) {
      if (!(a.y > 0 && b.y <= 0)) return std::nullopt;
      return a.t + (b.t - a.t) * (a.y / (a.y - b.y));  // the chord
    }
    // Where it falls all the way there is one root, which Newton and halving find; else halves, the first one first.
    if (a.y > 0 && b.y <= 0 && -(b.y - a.y) > 4 * sag) return rootIn(a, b);
    const Place middle = placeAt(a.xi + 0.5 * length);
    if (const std::optional<double> found = firstIn(a, middle, depth + 1)) return found;
    return firstIn(middle, b, depth + 1);
  }
  double rootIn(Place a, Place b) const {
    for (int k = 0; k < 200 && b.xi - a.xi > 4e-16 * b.xi && a.t < b.t; ++k) {
      // The chord, drawn towards the end that has not moved; every third time the middle.
      const double share = k % 3 == 2 ? 0.5 : std::clamp(a.y / (a.y - b.y), 1e-3, 1 - 1e-3);
      const Place next = placeAt(a.xi + share * (b.xi - a.xi));
      if (next.xi <= a.xi || next.xi >= b.xi) break;
      (next.y > 0 ? a : b) = next;
    }
    return std::max(b.t, a.t);
  }

  const GlidePath<double>& path_;
  Vec3 weight_;
  double ahead_, value_;
};

struct Descent {
  Vec3 weight;
  double ahead, value, until;

  std::optional<double> operator()(const RestPath<double>&) const { return std::nullopt; }
  std::optional<double> operator()(const RollPath<double>& path) const {
    return along(path.centerAt(0), path.acceleration(), Vec3::Zero(), until);
  }
  std::optional<double> operator()(const GlidePath<double>& path) const {
    const double stop = path.end() ? std::min(until, *path.end()) : until;
    if (!path.slip().straight()) return CurvedDescent(path, weight, ahead, value).first(stop);
    const Vec3 direction = path.directionAt(0);
    return along(path.centerAt(0), path.acceleration(direction), direction, stop);
  }

 private:
  std::optional<double> along(const PathCenter<double>& start, const Vec3& acceleration, const Vec3& direction,
                              double stop) const {
    return fallOf(weight.dot(start.x) + ahead * weight.dot(direction) - value, weight.dot(start.v),
                  0.5 * weight.dot(acceleration), stop);
  }
};

}  // namespace

std::optional<double> firstDescent(PathForm form, const PathInputs<double>& in, const Vec3& weight, double ahead,
                                   double value, double until) {
  return withPath<double>(form, in, Descent{weight, ahead, value, until});
}

}  // namespace carom::adjoint_detail
