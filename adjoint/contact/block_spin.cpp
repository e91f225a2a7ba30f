// SPDX-License-Identifier: MIT
#include "adjoint/contact/block_spin.hpp"

#include <cmath>

#include "adjoint/numeric/decompositions.hpp"
#include "adjoint/numeric/gauss.hpp"

namespace carom::adjoint_detail {
namespace {

// What is left of a slip when the rest of its time is rounding.
constexpr double kNothingLeft = 1e-18;
// Stretches of the clock, of the inverse of the rates on it: 12 nodes are exact over them.
constexpr double kReach = 3;
// Two rates whose decays differ by less: a difference over theirs is taken as an integral between them.
constexpr double kAlike = 1;
// A pull by more of the weight is none that a contact can have.
constexpr double kNoLoad = 1e-10;

using Eigen::Index;

// The loads of least norm at arms, in which friction works along one direction: they carry the weight, and keep the block
// from tilting.
struct Loads {
  Loads(const PathInputs<double>& of, const std::vector<Vec3>& at, const Vec3& d)
      : in(of), arms(at), direction(d), push(of.normal - of.friction * d), rows(3, static_cast<Index>(at.size())) {
    const Vec3 moments = in.J.diagonal();
    A = in.R * moments.cwiseInverse().asDiagonal() * in.R.transpose();
    across = in.normal.unitOrthogonal();
    double length = 0;
    for (const Vec3& r : arms) length = std::max(length, r.norm());
    unit = in.mass * length;
    for (std::size_t k = 0; k < arms.size(); ++k) rows.col(static_cast<Index>(k)) << 1, tilts(arms[k].cross(push));
    inverse = Mat3(rows * rows.transpose()).inverse();
    pressing = leastNorm(Vec3(in.mass * pressingGravity(in), 0, 0));
  }

  /// What a moment tilts, in the unit of what lifts.
  Vec2 tilts(const Vec3& moment) const {
    const Vec3 spin = A * moment * unit;
    return {across.dot(spin), in.normal.cross(across).dot(spin)};
  }
  // A block stands on three corners at least, not in one line.
  Eigen::VectorXd leastNorm(const Vec3& of_rows) const { return rows.transpose() * (inverse * of_rows); }
  std::size_t least() const {
    Index at = 0;
    pressing.minCoeff(&at);
    return static_cast<std::size_t>(at);
  }
  /// alpha: at every contact the friction turns by d.r spin/u, and the loads follow.
  double decay() const {
    const Vec3 side = -in.friction * in.normal.cross(direction);
    Vec3 moment = Vec3::Zero(), left;
    for (std::size_t k = 0; k < arms.size(); ++k)
      moment += direction.dot(arms[k]) * pressing[static_cast<Index>(k)] * arms[k].cross(side);
    left << 0, tilts(moment);
    const Eigen::VectorXd follow = leastNorm(Vec3(-left));
    for (std::size_t k = 0; k < arms.size(); ++k) moment += follow[static_cast<Index>(k)] * arms[k].cross(push);
    return -in.normal.dot(A * moment);
  }

  const PathInputs<double>& in;
  const std::vector<Vec3>& arms;
  Vec3 direction, push, across;
  Mat3 A, inverse;
  double unit;
  Eigen::Matrix<double, 3, Eigen::Dynamic> rows;
  Eigen::VectorXd pressing;
};

class Turning {
 public:
  Turning(const PathInputs<double>& in, const std::vector<BlockSupport>& supports)
      : in_(in), supports_(supports), path_(GlidePath<double>::block(in)), lever_(in.friction * in.reach) {
    for (const BlockSupport& s : supports) {
      steady_ = steady_ && (s.follows - Mat3::Identity()).isZero(1e-12);
      arms_.push_back(s.arm);
    }
  }

  BlockSpin after(double elapsed, bool at_end) const {
    const GlideSlip<double>& slip = path_.slip();
    if (!(slip.friction() > 0)) return {elapsed, 1, Vec3::Zero(), Vec3::Zero()};
    if (!slip.moving()) return {};  // it is nothing as soon as there is slip
    return steady_ && slip.straight() ? straight(elapsed, at_end) : curved(elapsed, at_end);
  }

 private:
  double decayAt(double xi, const Vec3& direction) const {
    if (steady_) return spinDecay(in_, arms_, direction);
    std::vector<Vec3> arms;
    const Vec3 moved = path_.centerOf(path_.slip().onClock(xi), path_.slip().timeAt(xi)).x - in_.x;
    for (const BlockSupport& s : supports_) arms.push_back(s.arm + (s.follows - Mat3::Identity()) * moved);
    return spinDecay(in_, arms, direction);
  }

  // On the clock of the slip all of it is exponential.
  BlockSpin straight(double elapsed, bool at_end) const {
    const GlideSlip<double>& slip = path_.slip();
    const Vec3 direction = path_.directionAt(0);
    const double u = slip.start().norm(), c = slip.friction(), slows = c - slip.slope().dot(direction);
    const double alpha = decayAt(0, direction), side = -c * lever_;
    BlockSpin out;
    if (at_end) {
      out.turn = u / (alpha + slows);
      out.x = in_.normal.cross(direction) * (side * u / ((alpha + slows) * (c + slows)));
      return out;
    }
    const double xi = clockOf(elapsed / u, slows);
    out.turn = u * decayIntegral(alpha + slows, xi);
    out.spin = elementary::exp(-alpha * xi);
    // (exp(-alpha xi) - exp(-c xi))/(c - alpha), and its integral over u dxi
    double velocity = 0, place = 0;
    if (std::abs(c - alpha) * xi > kAlike) {
      velocity = (out.spin - elementary::exp(-c * xi)) / (c - alpha);
      place = (decayIntegral(alpha + slows, xi) - decayIntegral(c + slows, xi)) / (c - alpha);
    } else {
      const Gauss& gauss = Gauss::get();
      for (int i = 0; i < Gauss::kNodes; ++i) {
        const double rate = alpha + gauss.node[i] * (c - alpha);
        velocity += gauss.weight[i] * xi * elementary::exp(-rate * xi);
        place += gauss.weight[i] * firstMoment(rate + slows, xi);
      }
    }
    out.v = in_.normal.cross(direction) * (side * velocity);
    out.x = in_.normal.cross(direction) * (side * u * place);
    return out;
  }
  // -log(1 - slows t)/slows, smooth where it does not slow down.
  static double clockOf(double t, double slows) {
    const double share = slows * t;
    if (std::abs(share) > 0.1) return -elementary::log(1 - share) / slows;
    double sum = 0;
    for (int k = 18; k >= 0; --k) sum = sum * share + 1.0 / (k + 1);
    return t * sum;
  }
  // Integral of y exp(-rate y) over [0, xi].
  static double firstMoment(double rate, double xi) {
    if (std::abs(rate * xi) > 0.5) return (decayIntegral(rate, xi) - xi * elementary::exp(-rate * xi)) / rate;
    double sum = 0, term = 1;
    for (int k = 0; k < 20; ++k) sum += term / (k + 2), term *= -rate * xi / (k + 1);
    return xi * xi * sum;
  }

  // By Gauss collocation on the clock. dv = p d + q e, of which d and e turn at theta' = g.e.
  struct State {
    double xi = 0, log_spin = 0, p = 0, q = 0;
    double bend = 0;  // integral of spin theta'
    BlockSpin sum;  // turn and x
  };
  BlockSpin curved(double elapsed, bool at_end) const {
    const GlideSlip<double>& slip = path_.slip();
    const double c = slip.friction(), a = slip.slope().norm(), start = slip.start().norm();
    const double stop = at_end ? std::numeric_limits<double>::infinity() : slip.xiAt(elapsed);
    State now;
    while (now.xi < stop && !(slip.speedAt(now.xi) < kNothingLeft * start)) {
      const double decay = decayAt(now.xi, directionOn(now.xi));
      through(std::min(kReach / (a + c + std::abs(decay)), stop - now.xi), now);
    }
    if (at_end) {  // there is only p; that of the energy-like c |s| + s.g, whose rate is constant (11.5)
      now.sum.v = path_.directionAt(elapsed) * (-c * lever_ * now.bend / (c + a));
      return now.sum;
    }
    const Vec3 d = directionOn(now.xi), e = in_.normal.cross(d);
    now.sum.v = d * now.p + e * now.q;
    now.sum.spin = elementary::exp(now.log_spin);
    return now.sum;
  }
  Vec3 directionOn(double xi) const { return path_.slip().slipAt(xi) / path_.slip().speedAt(xi); }

  void through(double h, State& now) const {
    constexpr int n = Gauss::kNodes;
    const Gauss& gauss = Gauss::get();
    const GlideSlip<double>& slip = path_.slip();
    const double c = slip.friction();
    Eigen::Matrix<double, n, 1> decay, turning, speed, spin;
    std::array<Vec3, n> along, across;
    for (int i = 0; i < n; ++i) {
      const double xi = now.xi + h * gauss.node[i];
      const auto at = static_cast<std::size_t>(i);
      speed[i] = slip.speedAt(xi);
      along[at] = slip.slipAt(xi) / speed[i], across[at] = in_.normal.cross(along[at]);
      turning[i] = slip.slope().dot(across[at]), decay[i] = decayAt(xi, along[at]);
    }
    const Eigen::Matrix<double, n, 1> decayed = gauss.integral * decay;
    for (int i = 0; i < n; ++i) spin[i] = elementary::exp(now.log_spin - h * decayed[i]);
    // slopes of p, then of q, at the nodes
    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(2 * n, 2 * n);
    Eigen::VectorXd r(2 * n);
    for (int i = 0; i < n; ++i) {
      r[i] = turning[i] * now.q;
      r[n + i] = -turning[i] * now.p - c * (now.q + lever_ * spin[i]);
      for (int j = 0; j < n; ++j) {
        const double by = h * gauss.integral(i, j);
        M(i, n + j) -= turning[i] * by;
        M(n + i, j) += turning[i] * by;
        M(n + i, n + j) += c * by;
      }
    }
    const Eigen::VectorXd slopes = PartialLu(M).solve(r);
    const Eigen::Matrix<double, n, 1> p = gauss.integral * slopes.head<n>() * h, q = gauss.integral * slopes.tail<n>() * h;
    for (int i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double share = h * gauss.weight[i] * speed[i];
      now.sum.turn += share * spin[i];
      now.sum.x += share * (along[at] * (now.p + p[i]) + across[at] * (now.q + q[i]));
    }
    now.bend += h * gauss.weight.dot(spin.cwiseProduct(turning).transpose());
    now.log_spin -= h * gauss.weight.dot(decay.transpose());
    now.p += h * gauss.weight.dot(slopes.head<n>().transpose());
    now.q += h * gauss.weight.dot(slopes.tail<n>().transpose());
    now.xi += h;
  }

  const PathInputs<double>& in_;
  const std::vector<BlockSupport>& supports_;
  GlidePath<double> path_;
  double lever_;
  std::vector<Vec3> arms_;
  bool steady_ = true;
};

}  // namespace

double spinDecay(const PathInputs<double>& in, const std::vector<Vec3>& arms, const Vec3& direction) {
  std::vector<Vec3> loaded = arms;
  while (true) {
    const Loads loads(in, loaded, direction);
    const std::size_t least = loads.least();
    if (loaded.size() <= 3 || !(loads.pressing[static_cast<Index>(least)] < -kNoLoad * in.mass * pressingGravity(in)))
      return loads.decay();
    loaded.erase(loaded.begin() + static_cast<std::ptrdiff_t>(least));  // it does not hold the block
  }
}

BlockSpin blockSpin(const PathInputs<double>& in, const std::vector<BlockSupport>& supports, double elapsed, bool at_end) {
  return Turning(in, supports).after(elapsed, at_end);
}

}  // namespace carom::adjoint_detail
