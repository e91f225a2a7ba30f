// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/contact/glide_path.hpp"

namespace carom::adjoint_detail {

/// A contact that a block slides on.
struct BlockSupport {
  Vec3 arm = Vec3::Zero();    ///< m, from the centre of mass, at the start
  Mat3 follows = Mat3::Identity();  ///< d(point)/d(centre of mass): 1 of a corner of its own, less where edges cross
};

/// What a spin about the normal makes of a block that slides without turning, to first order, 1 rad/s of it at the start.
struct BlockSpin {
  double turn = 0, spin = 0;                 ///< rad and rad/s about the normal
  Vec3 x = Vec3::Zero(), v = Vec3::Zero();   ///< m and m/s
};

/// The friction of a block that turns a little works against the slip of every corner, and so turns the block back and
/// to the side (11.28): with the direction d of its slip, e = n x d, its speed u, its height h and c = mu g_n,
///   spin' = -alpha(d) spin/u,   dv' = -c (dv_e + mu h spin)/u e.
/// `elapsed`: from the start; `at_end`: at the end of its slip, the limit from before.
BlockSpin blockSpin(const PathInputs<double>& in, const std::vector<BlockSupport>& supports, double elapsed, bool at_end);

/// alpha, m/s^2, from the loads of least norm at the arms of its contacts (11.22), of which those that would pull are off.
double spinDecay(const PathInputs<double>& in, const std::vector<Vec3>& arms, const Vec3& direction);

}  // namespace carom::adjoint_detail
