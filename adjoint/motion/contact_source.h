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

/// A pair of features (vertex of a on face of b, edge on edge, ...). The numbers are defined by the ContactSource
/// that created them; equal numbers are the same features.
struct FeaturePair {
  std::int16_t kind = -1;  ///< row of the source's table of gap functions
  std::int32_t a = -1;     ///< feature of the first body
  std::int32_t b = -1;     ///< feature of the second body
  std::int16_t sign = 1;   ///< side or branch of the pair, if the gap needs one (edge-edge, rims)
  bool operator==(const FeaturePair&) const = default;  ///< the same features
};

/// Position of the centre of mass (of a fixed body: of the shape's origin) and R_WG, shape axes to world.
struct Pose {
  Vec3 x = Vec3::Zero();      ///< m
  Mat3 R = Mat3::Identity();  ///< R_WG
};

/// Gap [m], unit normal pointing from b to a, and contact point, all in world axes.
struct ContactPoint {
  double gap = 0;               ///< m, negative if they overlap
  Vec3 normal = Vec3::UnitZ();  ///< unit, from b to a
  Vec3 point = Vec3::Zero();    ///< m
};

/// A direction of change of the poses and dimensions of two shapes: rates of (x_a, theta_a, x_b, theta_b), theta a
/// world rotation vector, and of the dimensions; empty: constant dimensions.
struct PairTangent {
  Eigen::Matrix<double, 12, 1> pose = Eigen::Matrix<double, 12, 1>::Zero();  ///< of the poses
  Eigen::VectorXd size_a;                                                    ///< of the dimensions of a
  Eigen::VectorXd size_b;                                                    ///< of the dimensions of b
};

/// Derivatives of (gap, normal, point), 7 rows, with respect to (x_a, theta_a, x_b, theta_b), theta a world rotation
/// vector, and to the dimensions of both shapes at fixed poses (including the shift of the centre of mass in the
/// shape).
struct ContactJacobian {
  Eigen::Matrix<double, 7, 12> pose = Eigen::Matrix<double, 7, 12>::Zero();  ///< with respect to the poses
  Eigen::Matrix<double, 7, Eigen::Dynamic> size_a;                           ///< with respect to the dimensions of a
  Eigen::Matrix<double, 7, Eigen::Dynamic> size_b;                           ///< with respect to the dimensions of b

  /// d(gap, normal, point) along a direction.
  Eigen::Matrix<double, 7, 1> along(const PairTangent& direction) const {
    Eigen::Matrix<double, 7, 1> d = pose * direction.pose;
    if (size_a.cols() > 0 && direction.size_a.size() > 0) d += size_a * direction.size_a;
    if (size_b.cols() > 0 && direction.size_b.size() > 0) d += size_b * direction.size_b;
    return d;
  }
};

/// Rate of change of a pose.
struct PoseRate {
  Vec3 v = Vec3::Zero();  ///< m/s, of Pose::x
  Vec3 w = Vec3::Zero();  ///< rad/s, world axes
};

/// A contact at given features and its rates.
struct ContactMotion {
  ContactPoint at;                    ///< now
  double gap_rate = 0;                ///< m/s
  Vec3 normal_rate = Vec3::Zero();    ///< 1/s
  Vec3 point_rate = Vec3::Zero();     ///< m/s; of the contact point, which is not a material point
};

/// The smooth gap functions of feature pairs, for the shapes of one scene. Immutable; a Motion keeps it.
class ContactGeometry {
 public:
  virtual ~ContactGeometry() = default;
  /// The contact and its rates for these rates of the poses.
  virtual ContactMotion motion(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B, const PoseRate& of_a,
                               const PoseRate& of_b) const {
    PairTangent rate;
    rate.pose << of_a.v, of_a.w, of_b.v, of_b.w;
    const Eigen::Matrix<double, 7, 1> d = jacobian(a, b, f, A, B).along(rate);
    return {contact(a, b, f, A, B), d[0], d.segment<3>(1), d.segment<3>(4)};
  }
  /// Gap, normal and point of bodies a and b at these poses.
  virtual ContactPoint contact(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const = 0;
  /// Their derivatives.
  virtual ContactJacobian jacobian(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B) const = 0;
  /// Second derivatives: the rate of every entry of `jacobian` along each direction.
  virtual std::vector<ContactJacobian> jacobianRates(int a, int b, const FeaturePair& f, const Pose& A, const Pose& B,
                                                     std::span<const PairTangent> directions) const = 0;
  /// Such as "vertex 3 on face +z", in the order a, b.
  virtual std::string describe(int a, int b, const FeaturePair& f) const = 0;
};

/// The first impact of a pair: gap = 0 with a decreasing gap. Without features (kind -1) the bodies begin to overlap
/// at that time and no features explain the contact: the motion ends. With the features kSearchedSoFar there is no
/// impact before that time; the search must be repeated from there, unless another impact comes first.
struct PredictedImpact {
  double time = 0;       ///< s
  FeaturePair features;  ///< where they meet
};

/// See PredictedImpact.
inline constexpr FeaturePair kSearchedSoFar{-2, -1, -1, 1};

/// Two bodies that touch at the start of a scene (see ContactSource::placed).
struct PlacedContact {
  int a = 0;                          ///< body
  int b = 0;                          ///< body, above a
  std::vector<FeaturePair> features;  ///< at which they touch: at least one, more if an edge or a face lies on a face
};

/// A persistent contact: its bodies, a below b, and their features.
struct PersistentFeatures {
  int a = -1;            ///< body
  int b = -1;            ///< body
  FeaturePair features;  ///< of a and b
};

/// Interface of collision detection: which bodies may touch, and when.
class ContactSource {
 public:
  virtual ~ContactSource() = default;

  /// Begins a simulation of this scene. Throws InputError if two bodies overlap at the start, unless bodies of the
  /// same names overlap in the scene for which the source was constructed.
  virtual void begin(const Scene& scene) = 0;

  /// The pairs that overlap at the start of the current scene, in increasing order, without bodies that never collide
  /// (see mayCollide).
  virtual std::vector<StartOverlap> overlaps() const { return {}; }

  /// The pairs in contact at the start of the current scene, in increasing order: the gap of the given features is 0
  /// up to rounding, or below it by less than an overlap. Includes pairs that separate or move along each other, but
  /// no bodies that never collide.
  virtual std::vector<PlacedContact> placed() const { return {}; }

  /// The first time in [from, until] at which bodies a and b do not overlap; none if they always do.
  virtual std::optional<double> parting(int a, int b, Arc& arc_a, Arc& arc_b, double from, double until) {
    (void)a, (void)b, (void)arc_a, (void)arc_b, (void)until;
    return from;
  }

  /// Body `body` follows `arc` from `from` on; the source may be asked about it up to `until`.
  virtual void setPath(int body, const Arc& arc, double from, double until) = 0;

  /// Time up to which `neighbours(body)`, called at time t, is valid for a moving body on its current path; then it
  /// must be called again. Validity does not depend on the paths of the others: a body not in the list updates its
  /// own list before it comes near. Later than t; infinite if the lists are valid for the whole paths.
  virtual double window(int body, double t) {
    (void)body, (void)t;
    return std::numeric_limits<double>::infinity();
  }

  /// Bodies that may touch the moving body `body` on the paths set so far and within its window, in increasing order;
  /// may have too many, never too few.
  virtual void neighbours(int body, std::vector<int>& out) = 0;

  /// First impact of bodies a and b in [from, until] on the given arcs, which are those of the paths set last.
  /// Extends the arcs as far as it searches. Bodies that touch at `from` and do not approach have no impact; if they
  /// begin to approach at once, the impact is at `from`.
  virtual std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                                     double until) = 0;

  /// The same for bodies in persistent contact at the features `held` during that time: the first impact of their
  /// other features. Each of `held` lies on a flat face of one of the two bodies, or crosses its boundary, and the
  /// arcs keep it in the plane of that face. Contacts that leave the boundary of the face are not detected here. None
  /// for a source whose bodies touch at one point only.
  virtual std::optional<PredictedImpact> firstImpactBeside(int a, int b, std::span<const FeaturePair> held, Arc& arc_a,
                                                           Arc& arc_b, double from, double until) {
    (void)a, (void)b, (void)held, (void)arc_a, (void)arc_b, (void)from, (void)until;
    return std::nullopt;
  }

  /// The same if the moving one of a and b is in persistent contact with fixed bodies: `held` are those contacts,
  /// possibly with the other one of a and b. Fixed bodies form one ground, so a face that continues from one fixed
  /// body to the next is one face.
  virtual std::optional<PredictedImpact> firstImpactOnGround(int a, int b, std::span<const PersistentFeatures> held, Arc& arc_a,
                                                             Arc& arc_b, double from, double until) {
    std::vector<FeaturePair> own;
    for (const PersistentFeatures& h : held)
      if (h.a == a && h.b == b) own.push_back(h.features);
    return own.empty() ? firstImpact(a, b, arc_a, arc_b, from, until)
                       : firstImpactBeside(a, b, own, arc_a, arc_b, from, until);
  }

  /// Fixed bodies that the fixed body `body` touches, in increasing order; may have too many, never too few. Where
  /// their faces continue its own, its boundary carries no contact.
  virtual std::span<const int> groundBeside(int body) const {
    (void)body;
    return {};
  }

  /// All feature pairs of a and b that touch at time t, with a gap of at most `reach`: more than one if an edge or a
  /// face lies on a face. May be empty for a source whose bodies touch at one point only.
  virtual std::vector<FeaturePair> touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t, double reach) {
    (void)a, (void)b, (void)arc_a, (void)arc_b, (void)t, (void)reach;
    return {};
  }

  /// The gap functions of the current scene; a Motion keeps it.
  virtual std::shared_ptr<const ContactGeometry> geometry() const = 0;

  /// An independent source of the same kind, for use in another thread once `begin` was called; null if not
  /// supported.
  virtual std::unique_ptr<ContactSource> another() const { return nullptr; }

  /// Counter for the steps of `begin`, `firstImpact` and `parting`; null: none. They propagate its WorkEnded.
  void countIn(WorkCount* work) { work_ = work; }

 protected:
  WorkCount* work() const { return work_; }  ///< see countIn

 private:
  WorkCount* work_ = nullptr;
};

}  // namespace carom
