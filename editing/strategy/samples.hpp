// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <vector>

#include <Eigen/Core>

/// Points spread evenly, the same ones every time. Internal to editing/.
namespace carom::editing_detail {

/// A sequence of low discrepancy: point k has the coordinates frac(1/2 + (k + 1) / g^j), where g^(m+1) = g + 1 (the
/// R_m sequence; for m = 1 g is the golden ratio), m = 2 d: onSphere needs as many. Every beginning of it covers the
/// unit cube evenly.
class EvenPoints {
 public:
  explicit EvenPoints(Eigen::Index dimensions);
  /// In [0, 1)^d.
  Eigen::VectorXd inCube(int k) const;
  /// Of length 1, in directions that are spread evenly: normal numbers of the points of a sequence, by Box and Muller.
  Eigen::VectorXd onSphere(int k) const;

 private:
  Eigen::VectorXd steps_;  // 1 / g^j, m of them
  Eigen::Index dimensions_;
};

/// Changes rounded to 1e-9, to recognise points that differ by rounding alone.
class RoundedPoint {
 public:
  explicit RoundedPoint(const Eigen::VectorXd& numbers);
  auto operator<=>(const RoundedPoint&) const = default;

 private:
  std::vector<double> rounded_;
};

/// What is known around a point: Gauss-Newton's step there, and an orthonormal basis of the directions that change no
/// row to first order (columns; may have none).
struct Surroundings {
  Eigen::VectorXd at, step;
  Eigen::MatrixXd free;
};

/// How far samples reach, in natural scales times the weights.
struct SampleReach {
  double length = 3;
  bool of_known = false;  ///< a change of this length is known, and smaller ones are looked for
};

/// A part of `count` of one endless sequence of samples, from number `first` on, all within the bounds. They take
/// turns: points of boxes around `centre` with half widths from a hundredth of the reach to all of it, or, where smaller changes
/// than a known one are looked for, with lengths from a third of it on; single numbers changed; from each of `around` on, a
/// share of the step and something along the free directions; and, where smaller changes than a known one are looked for,
/// changes nearly within the span of the gradients at each of `around`, which is all that is perpendicular to `free`.
std::vector<Eigen::VectorXd> samples(const Eigen::VectorXd& centre, const std::vector<Surroundings>& around,
                                     const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, int first, int count,
                                     const SampleReach& reach = {});

/// Three of four points get the values of `start` where these have no influence, as far as is known (none: all may): the mass of
/// a body that meets only fixed ones changes nothing, nor does the elasticity of a wall that none comes to.
void keepInMost(std::vector<Eigen::VectorXd>& places, const Eigen::VectorXd& start, const std::vector<char>& has_influence);

}  // namespace carom::editing_detail
