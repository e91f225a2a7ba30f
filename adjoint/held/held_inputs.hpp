// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/held/held_path.hpp"

namespace carom::adjoint_detail {

/// All that a path in lasting contact depends on, in columns: its start (x, theta, v, L), then gravity, mass, inertia
/// (three moments and yz, xz, xy), the dimensions of the body; of each body that it is in contact with position and
/// orientation (a rotation vector), 6, and dimensions; the friction of each contact.
struct HeldInputs {
  static constexpr int kStart = 12, kGravity = 12, kMass = 15, kInertia = 16, kProducts = 19, kSizes = 22;
  struct Partner {
    int body, pose, sizes, size_count;
  };
  int size_count = 0, friction = 0, count = 0;
  std::vector<Partner> partners;
  std::vector<std::size_t> partner_of;  // of each contact

  HeldInputs(const HeldScene& scene, const std::vector<HeldContact>& contacts, const State& start);

  /// Of a derivative of a pair's geometry what belongs to a column; nothing where that does not move the pair.
  std::optional<Eigen::Matrix<double, 7, 1>> columnOf(const ContactJacobian& J, const HeldContact& contact, std::size_t k,
                                                      int column) const;
};

}  // namespace carom::adjoint_detail
