// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_path.hpp"

namespace carom::adjoint_detail {

/// How the pose of a support has gone since the start of a path: (x, theta) there, and V and W, by which it varies now.
struct SupportFlow {
  bool moves = false;
  double now = 0;                     ///< s
  double elapsed = 0;                 ///< s
  Mat3 turned = Mat3::Identity();     ///< theta by that at the start
  Mat3 by_spin = Mat3::Zero();        ///< theta by W
  /// At time t, where it moves uniformly from `start` on.
  static SupportFlow of(const Support& support, double start, double t);
  /// (x, theta) by a column of its pose or, from 6 on, of its velocities.
  Eigen::Matrix<double, 6, 1> poseBy(int column) const;
};

/// How the state of a kinematic body at a time goes with what the scene says of it; its L is its angular velocity.
class SupportStart {
 public:
  SupportStart(const Body& body, const BodyModel& model, const SupportFlow& flow) : body_(body), model_(model), flow_(flow) {}
  StateDerivative tangent(const BodyDerivative& dbody) const;
  /// Its adjoint: adds to that of the body.
  void pullback(StateDerivative bar, BodyDerivative& body_bar) const;

 private:
  const Body& body_;
  const BodyModel& model_;
  SupportFlow flow_;
};
/// Of a support that moves uniformly, at time t.
SupportStart fromSceneStart(const Motion& motion, int body, const Support& support, double t);

/// Columns of a body that others are in contact with, and that contacts do not move: position and orientation (a rotation vector) at the
/// start of a path, 6, and dimensions; of one that moves velocity and angular velocity, 6; of one whose surface moves the velocities of
/// that, 6.
struct SupportColumns {
  int body, pose, sizes, size_count;
  int velocity = -1, surface = -1;  ///< -1: it has none

  /// From `first` on; gives where the next ones begin.
  int place(int first) {
    pose = first, sizes = first + 6;
    first += 6 + size_count;
    for (int* of : {&velocity, &surface})
      if (*of >= 0) *of = first, first += 6;
    return first;
  }
  /// How its pose now goes with a column; nothing where it does not. `flow`: of the support.
  std::optional<Eigen::Matrix<double, 6, 1>> poseBy(int column, const SupportFlow& flow) const {
    const bool in_pose = column >= pose && column < pose + 6;
    if (in_pose && !flow.moves) return Eigen::Matrix<double, 6, 1>::Unit(column - pose);
    if (in_pose) return flow.poseBy(column - pose);
    if (velocity >= 0 && column >= velocity && column < velocity + 6) return flow.poseBy(6 + column - velocity);
    return std::nullopt;
  }
  bool hasSize(int column) const { return column >= sizes && column < sizes + size_count; }
  /// The support at SupportFlow::now, with its rates along the columns first, first + 1, ...
  template <class Number>
  SupportInstant<Number> instant(const Support& support, int first, int columns, const SupportFlow& flow) const;
};

/// All that a path in lasting contact depends on, in columns: its start (x, theta, v, L), then gravity, mass, inertia
/// (three moments and yz, xz, xy), the dimensions of the body; SupportColumns of each body that it is in contact with; the friction of
/// each contact.
struct ConstrainedInputs {
  static constexpr int kStart = 12, kGravity = 12, kMass = 15, kInertia = 16, kProducts = 19, kSizes = 22;
  using Partner = SupportColumns;
  int size_count = 0, friction = 0, count = 0;
  std::vector<Partner> partners;
  std::vector<std::size_t> partner_of;  // of each contact

  ConstrainedInputs(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, const State& start);

  /// Of a derivative of a pair's geometry what belongs to a column; nothing where that does not move the pair. `flow`: of the support.
  std::optional<Eigen::Matrix<double, 7, 1>> columnOf(const ContactJacobian& J, const PersistentContact& contact, std::size_t k,
                                                      int column, const SupportFlow& flow) const;
  /// The support of contact k, with its rates along the columns first, first + 1, ...
  template <class Number>
  SupportInstant<Number> supportOf(const Support& support, std::size_t k, int first, int columns, const SupportFlow& flow) const {
    return partners[partner_of[k]].instant<Number>(support, first, columns, flow);
  }

  /// The chain rule where the state has the derivative `state`, 12 rows, by the inputs: rows by all inputs.
  static Eigen::MatrixXd chained(const Eigen::MatrixXd& rows, const Eigen::MatrixXd& state) {
    Eigen::MatrixXd sum = rows.leftCols<kStart>() * state;
    sum.rightCols(rows.cols() - kStart) += rows.rightCols(rows.cols() - kStart);
    return sum;
  }
};

/// How the inputs at the start of a path would change over time with the supports that move, as these do at time t: nothing but
/// their poses, which go at V and W. Throws NotComputable where one is given and may accelerate.
Eigen::VectorXd timeShift(const ConstrainedScene& scene, const ConstrainedInputs& inputs, double t);
/// Of one support.
void shiftSupport(const Support& support, const SupportColumns& columns, double t, Eigen::VectorXd& shift);

inline Eigen::Matrix<double, 12, 1> asVector(const StateDerivative& d) {
  return (Eigen::Matrix<double, 12, 1>() << d.x, d.theta, d.v, d.L).finished();
}
inline StateDerivative asState(const Eigen::Matrix<double, 12, 1>& v) {
  StateDerivative d;
  d.x = v.head<3>(), d.theta = v.segment<3>(3), d.v = v.segment<3>(6), d.L = v.tail<3>();
  return d;
}

template <class Number>
SupportInstant<Number> SupportColumns::instant(const Support& support, int first, int columns, const SupportFlow& flow) const {
  const SupportInstant<double> at = support.at(flow.now);
  SupportInstant<Number> now;
  now.x = at.x.cast<Number>(), now.R = at.R.cast<Number>(), now.v = at.v.cast<Number>(), now.w = at.w.cast<Number>();
  now.a = at.a.cast<Number>(), now.alpha = at.alpha.cast<Number>();
  now.has_belt = at.has_belt, now.center = at.center.cast<Number>();
  now.surface_velocity = at.surface_velocity.cast<Number>();
  now.surface_angular_velocity = at.surface_angular_velocity.cast<Number>();
  for (int lane = 0; lane < columns; ++lane) {
    const int column = first + lane, by_velocity = column - velocity, by_surface = column - surface;
    const auto i = static_cast<std::size_t>(lane);
    if (const auto by = poseBy(column, flow)) {
      setRates(now.x, Vec3(by->template head<3>()), i);
      setRates(now.R, Mat3(skew(Vec3(by->template tail<3>())) * at.R), i);
    }
    if (velocity >= 0 && by_velocity >= 0 && by_velocity < 6) (by_velocity < 3 ? now.v[by_velocity] : now.w[by_velocity - 3]).rate[i] = 1;
    if (surface >= 0 && by_surface >= 0 && by_surface < 6)
      (by_surface < 3 ? now.surface_velocity[by_surface] : now.surface_angular_velocity[by_surface - 3]).rate[i] = 1;
  }
  return now;
}

}  // namespace carom::adjoint_detail
