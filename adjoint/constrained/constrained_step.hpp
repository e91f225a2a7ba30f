// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "adjoint/constrained/constrained_instant.hpp"
#include "adjoint/flight/trajectory.hpp"
#include "adjoint/numeric/gauss.hpp"

namespace carom::adjoint_detail {

/// A row each of x, theta, v and L: rotation vectors from the orientation at the start of a step.
using ConstrainedVector = Eigen::Matrix<double, 12, 1>;
using ConstrainedSlopes = Eigen::Matrix<double, 12, Gauss::kNodes>;

/// d(theta)/dt of a rotation vector at angular velocity w.
Vec3 rotationRate(const Vec3& theta, const Vec3& w);

/// When a stretch of a path in lasting contact is, and how its contacts slip on it.
struct ContactStep {
  double start = 0, length = 0;  ///< s
  /// Of each contact that slides the unit direction of its slip at the nodes.
  std::vector<std::array<Vec3, Gauss::kNodes>> slip;
  std::vector<char> frozen;      ///< of each contact: the direction stays, as its slip ends here

  std::vector<Vec3> slipAtNode(int node) const;
  /// The same at any time, as polynomials: of unit length, and along the plane of the contact, as nearly as these are good.
  void placeSlips(double t, std::vector<Vec3>& slip) const;

  /// The state of a body after a change of (x, theta, v, L).
  static State moved(const State& from, const ConstrainedVector& change);
  /// The same a little beyond what is known of a path: at its velocities.
  static State goingOn(const State& from, const BodyModel& model, double elapsed);
};

/// Widens bounds over a path by a step with these coefficients of its slopes.
void widen(TrajectoryBounds& bounds, const ConstrainedSlopes& slopes, double length);

/// A stretch of a path in lasting contact: polynomials in time, of degree 12.
struct ConstrainedStep : ContactStep {
  State from;                    ///< at the start
  ConstrainedSlopes slopes;             ///< coefficients of d/dt of (x, theta, v, L)

  ConstrainedVector changeAt(double t) const { return length * slopes * Gauss::integrals((t - start) / length).transpose(); }
  ConstrainedVector slopeAt(double t) const { return slopes * Gauss::values((t - start) / length).transpose(); }
  State stateAt(double t) const { return moved(from, changeAt(t)); }
};

/// The steps of a path one after the other, which its copies share.
template <class Step>
class PathSteps {
 public:
  class Iterator {
   public:
    explicit Iterator(const std::shared_ptr<const Step>* at) : at_(at) {}
    const Step& operator*() const { return **at_; }
    Iterator& operator++() { return ++at_, *this; }
    bool operator==(const Iterator&) const = default;

   private:
    const std::shared_ptr<const Step>* at_;
  };

  bool empty() const { return steps_.empty(); }
  std::size_t size() const { return steps_.size(); }
  const Step& operator[](std::size_t i) const { return *steps_[i]; }
  const Step& front() const { return *steps_.front(); }
  const Step& back() const { return *steps_.back(); }
  Iterator begin() const { return Iterator(steps_.data()); }
  Iterator end() const { return Iterator(steps_.data() + steps_.size()); }
  void add(Step step) { steps_.push_back(std::make_shared<const Step>(std::move(step))); }

  /// Whether a path along them goes on from its start.
  bool move() const { return !empty() && front().length > 0; }
  /// Of two steps that meet at t the one before. `known`: their end; a polynomial is good for about its length beyond it: rather
  /// that of a longer step before.
  const Step& at(double t, double known) const {
    std::size_t low = 0, high = size();
    while (high - low > 1) {  // the last one that starts before t
      const std::size_t middle = (low + high) / 2;
      (steps_[middle]->start < t && steps_[middle]->length > 0 ? low : high) = middle;
    }
    if (t > known)
      while (low > 0 && steps_[low]->length < t - known && steps_[low - 1]->length > steps_[low]->length) --low;
    return *steps_[low];
  }

 private:
  std::vector<std::shared_ptr<const Step>> steps_;
};
using ConstrainedSteps = PathSteps<ConstrainedStep>;

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
