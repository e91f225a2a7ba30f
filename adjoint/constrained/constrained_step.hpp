// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "adjoint/numeric/gauss.hpp"
#include "adjoint/constrained/constrained_instant.hpp"

namespace carom::adjoint_detail {

/// A row each of x, theta, v and L: rotation vectors from the orientation at the start of a step.
using ConstrainedVector = Eigen::Matrix<double, 12, 1>;
using ConstrainedSlopes = Eigen::Matrix<double, 12, Gauss::kNodes>;

/// d(theta)/dt of a rotation vector at angular velocity w.
Vec3 rotationRate(const Vec3& theta, const Vec3& w);

/// A stretch of a path in lasting contact: polynomials in time, of degree 12.
struct ConstrainedStep {
  double start = 0, length = 0;  ///< s
  State from;                    ///< at the start
  ConstrainedSlopes slopes;             ///< coefficients of d/dt of (x, theta, v, L)
  /// Of each contact that slides the unit direction of its slip at the nodes.
  std::vector<std::array<Vec3, Gauss::kNodes>> slip;
  std::vector<char> frozen;      ///< of each contact: the direction stays, as its slip ends here

  ConstrainedVector changeAt(double t) const { return length * slopes * Gauss::integrals((t - start) / length).transpose(); }
  ConstrainedVector slopeAt(double t) const { return slopes * Gauss::values((t - start) / length).transpose(); }
  State stateAt(double t) const { return moved(from, changeAt(t)); }
  std::vector<Vec3> slipAtNode(int node) const;
  /// The same at any time, as polynomials: of unit length, and along the plane of the contact, as nearly as these are good.
  void placeSlips(double t, std::vector<Vec3>& slip) const;

  static State moved(const State& from, const ConstrainedVector& change);
};

/// The steps of a path one after the other, which its copies share.
class ConstrainedSteps {
 public:
  class Iterator {
   public:
    explicit Iterator(const std::shared_ptr<const ConstrainedStep>* at) : at_(at) {}
    const ConstrainedStep& operator*() const { return **at_; }
    Iterator& operator++() { return ++at_, *this; }
    bool operator==(const Iterator&) const = default;

   private:
    const std::shared_ptr<const ConstrainedStep>* at_;
  };

  bool empty() const { return steps_.empty(); }
  std::size_t size() const { return steps_.size(); }
  const ConstrainedStep& operator[](std::size_t i) const { return *steps_[i]; }
  const ConstrainedStep& front() const { return *steps_.front(); }
  const ConstrainedStep& back() const { return *steps_.back(); }
  Iterator begin() const { return Iterator(steps_.data()); }
  Iterator end() const { return Iterator(steps_.data() + steps_.size()); }
  void add(ConstrainedStep step) { steps_.push_back(std::make_shared<const ConstrainedStep>(std::move(step))); }

 private:
  std::vector<std::shared_ptr<const ConstrainedStep>> steps_;
};

/// Steps of one path, by Gauss collocation with the directions of slip at the nodes as unknowns: where slip begins or
/// ends they decide everything, and a slope that had them follow the velocity would be stiff there.
class ConstrainedStepper {
 public:
  ConstrainedStepper(const ConstrainedScene& scene, const std::vector<PersistentContact>& contacts, bool redundant);
  ~ConstrainedStepper();

  /// Where a step begins.
  struct Start {
    State state;
    double time = 0;
    std::vector<Vec3> slip;      ///< of each contact its direction
    std::vector<char> frozen;    ///< see ConstrainedStep
  };
  /// A step of a given length; nothing where its equations were not solved. `like`: a step that begins or ends where this
  /// one begins, from which it is guessed; or none.
  std::optional<ConstrainedStep> tried(const Start& start, double length, const ConstrainedStep* like);
  /// What its polynomials leave out, as a share of what may be left out.
  double errorOf(const ConstrainedStep& step) const;

 private:
  struct Nodes;
  ConstrainedSlopes guess(ConstrainedStep& step, const ConstrainedStep* like);
  void extrapolate(ConstrainedStep& step, const ConstrainedStep& like, ConstrainedSlopes& F);
  bool solve(ConstrainedStep& step, ConstrainedSlopes& F);
  ConstrainedSlopes evaluate(ConstrainedStep& step, const ConstrainedSlopes& change);
  void slopesAt(std::size_t node, const ConstrainedStep& step, const State& state, const Vec3& theta, ConstrainedSlopes& F);
  double turnSlips(ConstrainedStep& step, ConstrainedSlopes& next, bool anew);

  const ConstrainedScene& scene_;
  const std::vector<PersistentContact>& contacts_;
  bool redundant_;
  std::unique_ptr<Nodes> nodes_;
};

}  // namespace carom::adjoint_detail
