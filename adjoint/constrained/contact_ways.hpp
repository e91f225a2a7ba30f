// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_dynamics.hpp"
#include "adjoint/constrained/constrained_instant.hpp"

namespace carom::adjoint_detail {

/// How a contact goes on: open, or closed and sticking, sliding on, or beginning to slip from no slip.
enum class Way : char { off, sticks, slides, begins };

/// The forces and accelerations of a body whose contacts go on in given ways, with the directions in which some begin to
/// slip: (11.19) to (11.23).
class ContactWays {
 public:
  struct Solved {
    std::vector<std::size_t> on;                  ///< of the candidates: those that are closed
    std::vector<ContactInstant<double>> contacts;
    bool redundant = false;
    std::optional<ConstrainedDynamics> forces;
    std::vector<Vec3> force;                      ///< of the share that leaves most room

    double pressing(std::size_t i) const { return contacts[i].n.dot(force[i]); }
  };

  /// `candidates` has to live as long. A slip that is not faster than `no_slip` is none.
  ContactWays(const ConstrainedScene& scene, const std::vector<PersistentContact>& candidates, const State& state, double no_slip);

 protected:
  bool rubs(std::size_t k) const { return candidates_[k].friction > 0; }
  Way closedWay(std::size_t k) const { return slips_[k] || !rubs(k) ? Way::slides : Way::sticks; }

  void solve(Solved& solved, const std::vector<Way>& ways, const std::vector<Vec3>& direction) const;
  /// The directions in which contacts begin to slip: those of the friction that held them last, then those in which they
  /// then move. False where these do not come to rest.
  bool solveBegins(Solved& solved, const std::vector<Way>& ways);
  /// Those of the friction that held them last, against it; nothing where that was none.
  std::optional<std::vector<Vec3>> pulledWays(Solved& solved, const std::vector<Way>& ways) const;
  /// The same from given directions.
  bool turnAll(Solved& solved, const std::vector<Way>& ways, std::vector<Vec3> direction);
  /// Whether what a contact has of slip changes: at the limit of friction it does not.
  bool accelerates(const Solved& solved, std::size_t i) const;

  const std::vector<PersistentContact>& candidates_;
  ConstrainedInstant now_;
  double pull_ = 0, force_ = 0;  // units of acceleration and force
  std::vector<char> slips_;
  std::vector<Vec3> direction_, used_;  // of slip: at the start, and as last solved

 private:
  void alongGrooves(const Solved& solved, const std::vector<Way>& ways, std::vector<Vec3>& direction) const;
  double turnBegins(const Solved& solved, const std::vector<Way>& ways, std::vector<Vec3>& direction) const;
};

}  // namespace carom::adjoint_detail
