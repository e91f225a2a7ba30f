// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "tests/reference/constrained_solve.h"

namespace carom::reference {

/// A corner of a body on a plane that stands still: what holds it there.
struct ConstrainedCorner {
  RVec at;      ///< from the centre of mass, principal axes
  RVec normal;  ///< of the plane, unit, towards the body
  Real offset;  ///< of the plane: normal.p
  Real friction;
  bool sticks = true;   ///< it does not move; or it slides
  bool begins = false;  ///< it slides from no slip on
  RVec slip;            ///< then: which way, about
};
struct ConstrainedBody {
  Real mass;
  RVec inertia, gravity;
};
/// Centre of mass, principal to world axes, world angular velocity.
struct ConstrainedState {
  RVec x;
  RMat R = RMat::identity();
  RVec v, spin;
};

/// Two corners of an edge begin to slip straight across it: their directions decide together, and one order later, which
/// these series do not know.
struct SlipsTogether : std::runtime_error {
  SlipsTogether() : std::runtime_error("slips that begin together are not determined order by order") {}
};

/// With all gaps 0, no speed along the normals, and none at corners that stick or begin to slip: moved as little as
/// possible, as measured by the mass (11.13, 11.24).
ConstrainedState projected(const ConstrainedBody& body, const std::vector<ConstrainedCorner>& corners, ConstrainedState state);
/// The part of it that moves the pose.
ConstrainedState withoutGaps(const ConstrainedBody& body, const std::vector<ConstrainedCorner>& corners, ConstrainedState state);

/// Taylor series in time of a body that corners hold, from Newton's and Euler's equations in the axes of the body, in which
/// its corners and its inertia stand still. Where a slip begins u is 0, and its direction at every order is what makes
/// it go along itself.
class ConstrainedSeries {
 public:
  ConstrainedSeries(const ConstrainedBody& body, std::vector<ConstrainedCorner> corners, const ConstrainedState& start, int order, const Real& tolerance);

  /// How long the series is good for.
  const Real& longest() const { return longest_; }
  ConstrainedState at(const Real& t) const;
  RVec force(std::size_t k, const Real& t) const { return sum(f_[k], t); }  ///< at a corner, axes of the body
  Real pressing(std::size_t k, const Real& t) const { return dot(force(k, t), normal(k, t)); }
  RVec normal(std::size_t k, const Real& t) const { return sum(normal_[k], t); }  ///< axes of the body
  RVec slip(std::size_t k, const Real& t) const { return sum(u_[k], t); }  ///< axes of the body
  RVec direction(std::size_t k, const Real& t) const { return sum(d_[k], t); }
  RVec slipRate(std::size_t k) const { return u_[k][1] + cross(w_[0], u_[k][0]); }
  const std::vector<ConstrainedCorner>& corners() const { return corners_; }
  /// About the state there; slips that began go on.
  void advance(const Real& t) { start(at(t)), expand(); }

 private:
  using Line = std::vector<Real>;
  using Curve = std::vector<RVec>;
  struct Unknown {
    std::size_t corner;
    int axis;  // of a force that sticks; -1: N of one that slides
  };

  void start(const ConstrainedState& state);
  void expand();
  void place(std::size_t j);
  bool rubs(std::size_t k) const { return !corners_[k].sticks && corners_[k].friction != 0; }
  bool begins(std::size_t k) const { return first_ && rubs(k) && corners_[k].begins; }
  void direct(std::size_t j, std::size_t k);
  std::optional<std::size_t> pivot() const;
  void directAround(std::size_t j, std::size_t k, std::size_t pivot);
  void directFromRest(std::size_t j, std::size_t k, const Real& turn);
  void beginSlips(std::size_t j, const std::vector<std::size_t>& which);
  void findFirstDirections(const std::vector<std::size_t>& which);
  bool isAtLimit(const std::vector<std::size_t>& which);
  Real across(std::size_t j, std::size_t k) const;
  void push(std::size_t j);
  void fillMatrix(std::size_t j);
  void solve(std::size_t j);
  void go(std::size_t j);
  void findLongest();
  RVec answer(std::size_t at, std::size_t by, const RVec& force) const;
  static RVec sum(const Curve& c, const Real& t);
  static Real convolved(const Curve& a, const Curve& b, std::size_t j, std::size_t from = 0);
  static RVec crossed(const Curve& a, const Curve& b, std::size_t j);

  ConstrainedBody body_;
  std::vector<ConstrainedCorner> corners_;
  std::size_t order_;
  Real tolerance_, longest_;
  RVec inverse_;
  bool first_ = true;
  std::vector<Unknown> unknowns_;
  Curve x_, v_, w_, Iw_, gravity_, gyro_, force_, moment_;  // v, w, ...: axes of the body
  std::array<Curve, 3> row_;                                // of R
  std::vector<Curve> normal_, u_, free_, d_, push_, f_;            // of the corners
  std::vector<int> round_;                                          // about the pivot: 1 or -1
  std::vector<Line> length_;                                        // of the slips
  std::vector<std::vector<Curve>> moved_;  // of every unknown, at every corner
  std::vector<std::vector<Line>> B_;
  std::vector<Line> right_, y_, lambda_;
  ConstrainedSolve solver_;
  RealRows answer_;  // of what goes across a slip that begins, to turns of its direction
};

}  // namespace carom::reference
