// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adjoint/base/work_count.h"
#include "adjoint/flight/arc.h"
#include "adjoint/motion/start_overlap.h"
#include "adjoint/scene/scene.h"

namespace carom {

/// A frozen pair of features (vertex of a on face of b, edge on edge, ...). The numbers mean something only to the
/// ContactSource that made them; equal numbers are the same features.
struct FeaturePair {
  std::int16_t kind = -1;  ///< row of the source's table of gaps
  std::int32_t a = -1;     ///< feature of the first body
  std::int32_t b = -1;     ///< feature of the second body
  std::int16_t sign = 1;   ///< side or branch of the pair, where the gap needs one (edge-edge, rims)
  bool operator==(const FeaturePair&) const = default;
};

/// Position of the centre of mass (of a fixed body: of the shape's origin) and R_WG, shape axes to world.
struct Pose {
  Vec3 x = Vec3::Zero();
  Mat3 R = Mat3::Identity();
};

/// Gap [m], unit normal pointing from b to a, and contact point, all in world axes.
struct ContactPoint {
  double gap = 0;
  Vec3 normal = Vec3::UnitZ();
  Vec3 point = Vec3::Zero();
};

/// d(gap, normal, point), 7 rows: by (x_a, theta_a, x_b, theta_b), theta a world rotation vector, and by the dimensions
/// of both shapes at fixed poses (a centre of mass that moves in the shape counts here).
struct ContactJacobian {
  Eigen::Matrix<double, 7, 12> pose = Eigen::Matrix<double, 7, 12>::Zero();
  Eigen::Matrix<double, 7, Eigen::Dynamic> size_a, size_b;
};

/// A direction in which poses and dimensions of two shapes change: rates of (x_a, theta_a, x_b, theta_b), theta a world
/// rotation vector, and of the dimensions; no dimensions given: they stay.
struct PairTangent {
  Eigen::Matrix<double, 12, 1> pose = Eigen::Matrix<double, 12, 1>::Zero();
  Eigen::VectorXd size_a, size_b;
};

/// The smooth gap of frozen feature pairs, for the shapes of one scene. Immutable: a Motion keeps it.
class ContactGeometry {
 public:
  virtual ~ContactGeometry() = default;
  virtual ContactPoint contact(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const = 0;
  virtual ContactJacobian jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const = 0;
  /// Second derivatives: the rate of every entry of `jacobian` along each direction.
  virtual std::vector<ContactJacobian> jacobianRates(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B,
                                                     std::span<const PairTangent> directions) const = 0;
  /// Such as "vertex 3 on face +z", in the order a, b.
  virtual std::string describe(int a, int b, const FeaturePair& f) const = 0;
};

/// The first impact of a pair: gap = 0 with a decreasing gap. Without features (kind -1) the bodies come to overlap
/// from then on, and no features say how they meet: the motion cannot go on.
struct PredictedImpact {
  double time = 0;
  FeaturePair features;
};

/// Who may touch whom, and when: collision detection as the simulator sees it.
class ContactSource {
 public:
  virtual ~ContactSource() = default;

  /// Takes over the shapes of a scene. Throws InputError when two bodies overlap at the start, unless the source was made
  /// for a scene in which those of these names do.
  virtual void begin(const Scene& scene) = 0;

  /// The pairs that overlap at the start of the scene that was begun, in increasing order; bodies that never collide
  /// (see mayCollide) are not among them.
  virtual std::vector<StartOverlap> overlaps() const { return {}; }

  /// The first time in [from, until] at which bodies a and b do not overlap; none where they do all the time.
  virtual std::optional<double> parting(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) {
    (void)a, (void)b, (void)arc_a, (void)arc_b, (void)until;
    return from;
  }

  /// Body `body` follows `arc` from `from` on; the source may have to look at it up to `until`.
  virtual void setPath(int body, const Arc& arc, double from, double until) = 0;

  /// Time up to which `neighbours(body)`, asked for at time t, holds for a moving body on its present path; then it is
  /// to be asked for again. A body that the list lacks asks for itself before it comes near, so this holds whatever
  /// the paths of the others. Later than t; infinite where the lists hold for the whole of the paths.
  virtual double window(int body, double t) {
    (void)body, (void)t;
    return std::numeric_limits<double>::infinity();
  }

  /// Bodies that may touch the moving body `body` on the paths set so far and within its window, in increasing order;
  /// may name too many, never too few.
  virtual void neighbours(int body, std::vector<int>& out) = 0;

  /// First impact of bodies a and b in [from, until] on the given arcs, which are those of the paths set last. Extends
  /// the arcs as far as it looks. Bodies that touch at `from` and do not approach are not an impact.
  virtual std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                                     double until) = 0;

  /// All feature pairs of a and b with a gap of at most `reach` at time t, at which the bodies touch: more than one
  /// where an edge or a face lies on a face. May stay empty in a source whose bodies touch in one point only.
  virtual std::vector<FeaturePair> touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t, double reach) {
    (void)a, (void)b, (void)arc_a, (void)arc_b, (void)t, (void)reach;
    return {};
  }

  virtual std::shared_ptr<const ContactGeometry> geometry() const = 0;

  /// An independent source of the same kind, for use in another thread once `begin` was called; null where there is
  /// none.
  virtual std::unique_ptr<ContactSource> another() const { return nullptr; }

  /// Where the steps of `begin`, `firstImpact` and `parting` are counted; null: nowhere. They let its WorkEnded through.
  void countIn(WorkCount* work) { work_ = work; }

 protected:
  WorkCount* work() const { return work_; }

 private:
  WorkCount* work_ = nullptr;
};

}  // namespace carom
