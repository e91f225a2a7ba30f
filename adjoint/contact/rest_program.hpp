// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "adjoint/base/types.h"

namespace carom::adjoint_detail {

/// Bodies that nothing moves yet, under loads, at contacts with friction between each other and with what stands still.
struct RestProgram {
  struct Contact {
    int a = -1, b = -1;     ///< of the bodies, -1: what stands still
    Vec3 arm_a = Vec3::Zero(), arm_b = Vec3::Zero();  ///< from the centres of mass, as shares of `reach`
    Vec3 normal = Vec3::UnitZ();  ///< from b to a
    double friction = 0;    ///< mu
    double unit = 1;        ///< what is a large force there, N
  };
  std::vector<double> mass;   ///< kg, of each body: what is left of the loads counts as accelerations
  Eigen::VectorXd load;       ///< force and moment over reach, of each body, N
  std::vector<Contact> contacts;
};

/// Forces at the contacts, on a, and how well they hold the bodies.
struct RestForces {
  std::vector<Vec3> force;  ///< N
  /// What all cones of friction have room for: mu (n.f - room unit) >= |f_t| at every contact; at the most 1.
  double room = 0;
  /// What is left of the loads beyond rounding, as accelerations, m/s^2: the largest component.
  double unbalanced = 0;
};

/// Forces with sum_k H_k^T f_k = -load that stay within the cones of friction. Those of least norm where these do; else those
/// with the most room, by the program of the velocities y of the bodies that lets no contact close:
///   max (load + g).y over H_k y in the dual cone of k, g.y <= 1, with g = sum unit_k H_k^T n_k,
/// whose multipliers are forces: 6 unknowns a body, however many contacts there are. The room is negative where nothing
/// holds them.
RestForces restForces(const RestProgram& program);

/// Whether every motion of the bodies slips or opens a contact that bears a force above `least` N.
bool opposesEveryMotion(const RestProgram& program, const std::vector<Vec3>& force, double least);

}  // namespace carom::adjoint_detail
