// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "adjoint/constrained/constrained_inputs.hpp"

namespace carom::adjoint_detail {

/// Where the columns of supports and of the friction at contacts come from, forward and reverse.
class ContactColumns {
 public:
  explicit ContactColumns(const Motion& motion) : motion_(motion) {}
  /// Those of a body that contacts do not move, from time t on.
  void addSupport(const SupportColumns& columns, const Support& support, double t);
  /// That of a contact of bodies a and b.
  void addFriction(int column, int a, int b);

  void tangent(const SceneTangent& dscene, Eigen::VectorXd& d) const;
  /// Its adjoint: adds to that of the scene.
  void pullback(const Eigen::VectorXd& bar, SceneGradient& scene_bar) const;

 private:
  struct Friction {
    int column, a, b;  // materials; -1 for none
    double by_a, by_b;
  };
  struct Supporting {
    SupportColumns columns;
    std::optional<SupportStart> start;  // of one that moves as the scene says
  };

  const Motion& motion_;
  std::vector<Supporting> supports_;
  std::vector<Friction> friction_;
};

}  // namespace carom::adjoint_detail
