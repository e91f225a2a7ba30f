// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/constrained/constrained_step.hpp"

namespace carom::adjoint_detail {

/// The state at time t with all gaps 0, no speed along the normals, and none at contacts that stick or begin to slip: moved as
/// little as possible, as measured by the mass (11.13, 11.24). `stopped`: gets the impulses on the body that do that, N s, of each contact.
State constrainedStart(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, State state, double t, int rounds = 2,
                std::vector<Vec3>* stopped = nullptr);

/// Rows of n.u of each contact, or of u where there is no slip at the start, by (v, omega).
Eigen::Matrix<double, Eigen::Dynamic, 6> constrainedRows(const ConstrainedInstant& now, const std::vector<PersistentContact>& contacts);
/// What these rows come to where a contact goes with its support: u = 0 against that.
Eigen::VectorXd supportSpeeds(const ConstrainedInstant& now, const std::vector<PersistentContact>& contacts);
/// The same of the gaps by (x, theta).
Eigen::Matrix<double, Eigen::Dynamic, 6> gapRows(const ConstrainedInstant& now);
/// M^-1 C^T (C M^-1 C^T)^+, by which a change of (v, L), or of a pose, undoes that of rows C; of the pose: its own
/// (x, theta).
Eigen::Matrix<double, 6, Eigen::Dynamic> undoing(const ConstrainedInstant& now, const Eigen::Matrix<double, Eigen::Dynamic, 6>& C);

}  // namespace carom::adjoint_detail
