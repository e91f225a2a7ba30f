// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "adjoint/held/gauss.hpp"
#include "adjoint/held/held_dynamics.hpp"

namespace carom::adjoint_detail {

/// A row each of x, theta, v and L: rotation vectors from the orientation at the start of a step.
using HeldVector = Eigen::Matrix<double, 12, 1>;
using HeldSlopes = Eigen::Matrix<double, 12, Gauss::kNodes>;

/// A stretch of a path in lasting contact: polynomials in time, of degree 12.
struct HeldStep {
  double start = 0, length = 0;  ///< s
  State from;                    ///< at the start
  HeldSlopes slopes;             ///< coefficients of d/dt of (x, theta, v, L)
  /// Of each contact that slides the unit direction of its slip at the nodes.
  std::vector<std::array<Vec3, Gauss::kNodes>> slip;
  std::vector<char> frozen;      ///< of each contact: the direction stays, as its slip ends here

  HeldVector changeAt(double t) const { return length * slopes * Gauss::integrals((t - start) / length).transpose(); }
  HeldVector slopeAt(double t) const { return slopes * Gauss::values((t - start) / length).transpose(); }
  State stateAt(double t) const { return moved(from, changeAt(t)); }

  static State moved(const State& from, const HeldVector& change);
};

/// The body and its contacts at one instant of a path, in doubles.
struct HeldInstant {
  BodyInstant<double> body;
  std::vector<ContactInstant<double>> contacts;
  std::vector<double> gap_rate;

  Vec3 velocityAt(std::size_t k) const { return body.velocityAt(contacts[k].r); }
  Vec3 slipAt(std::size_t k) const {
    const Vec3 u = velocityAt(k), &n = contacts[k].n;
    return u - n.dot(u) * n;
  }
};

/// `slip`: a direction for each contact.
HeldInstant instantOf(const HeldScene& scene, const std::vector<HeldContact>& contacts, const State& state,
                      const std::vector<Vec3>& slip);

/// Steps of one path, by Gauss collocation with the directions of slip at the nodes as unknowns: where slip begins or
/// ends they decide everything, and a slope that had them follow the velocity would be stiff there.
class HeldStepper {
 public:
  HeldStepper(const HeldScene& scene, const std::vector<HeldContact>& contacts, bool redundant)
      : scene_(scene), contacts_(contacts), redundant_(redundant) {}

  /// A step of a given length; nothing where its equations were not solved. `slip`: of each contact its direction at the
  /// start; `before`: the step that ends where this one begins.
  std::optional<HeldStep> tried(const State& from, double start, double length, const std::vector<Vec3>& slip,
                                const std::vector<char>& frozen, const HeldStep* before) const;
  /// What its polynomials leave out, as a share of what may be left out.
  double errorOf(const HeldStep& step) const;

 private:
  struct Nodes;
  HeldSlopes guess(HeldStep& step, const HeldInstant& start, const HeldStep* before) const;
  bool solve(HeldStep& step, HeldSlopes& F, const HeldInstant& start) const;

  const HeldScene& scene_;
  const std::vector<HeldContact>& contacts_;
  bool redundant_;
};

}  // namespace carom::adjoint_detail
