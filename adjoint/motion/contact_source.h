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
  bool operator==(const FeaturePair&) const = default;  ///< the same features
};

/// Position of the centre of mass (of a fixed body: of the shape's origin) and R_WG, shape axes to world.
struct Pose {
  Vec3 x = Vec3::Zero();      ///< m
  Mat3 R = Mat3::Identity();  ///< R_WG
};

/// Gap [m], unit normal pointing from b to a, and contact point, all in world axes.
struct ContactPoint {
  double gap = 0;               ///< m, below 0 where they overlap
  Vec3 normal = Vec3::UnitZ();  ///< unit, from b to a
  Vec3 point = Vec3::Zero();    ///< m
};

/// A direction in which poses and dimensions of two shapes change: rates of (x_a, theta_a, x_b, theta_b), theta a world
/// rotation vector, and of the dimensions; no dimensions given: they stay.
struct PairTangent {
  Eigen::Matrix<double, 12, 1> pose = Eigen::Matrix<double, 12, 1>::Zero();  ///< of the poses
  Eigen::VectorXd size_a;                                                    ///< of the dimensions of a
  Eigen::VectorXd size_b;                                                    ///< of the dimensions of b
};

/// d(gap, normal, point), 7 rows: by (x_a, theta_a, x_b, theta_b), theta a world rotation vector, and by the dimensions
/// of both shapes at fixed poses (a centre of mass that moves in the shape counts here).
struct ContactJacobian {
  Eigen::Matrix<double, 7, 12> pose = Eigen::Matrix<double, 7, 12>::Zero();  ///< by the poses
  Eigen::Matrix<double, 7, Eigen::Dynamic> size_a;                           ///< by the dimensions of a
  Eigen::Matrix<double, 7, Eigen::Dynamic> size_b;                           ///< by the dimensions of b

  /// d(gap, normal, point) along a direction.
  Eigen::Matrix<double, 7, 1> along(const PairTangent& direction) const {
    Eigen::Matrix<double, 7, 1> d = pose * direction.pose;
    if (size_a.cols() > 0 && direction.size_a.size() > 0) d += size_a * direction.size_a;
    if (size_b.cols() > 0 && direction.size_b.size() > 0) d += size_b * direction.size_b;
    return d;
  }
};

/// How fast a pose changes.
struct PoseRate {
  Vec3 v = Vec3::Zero();  ///< m/s, of Pose::x
  Vec3 w = Vec3::Zero();  ///< rad/s, world axes
};

/// A contact of frozen features and how it moves with its bodies.
struct ContactMotion {
  ContactPoint at;                    ///< now
  double gap_rate = 0;                ///< m/s
  Vec3 normal_rate = Vec3::Zero();    ///< 1/s
  Vec3 point_rate = Vec3::Zero();     ///< m/s; of the place of the contact, which no point of a body need stay at
};

/// The smooth gap of frozen feature pairs, for the shapes of one scene. Immutable: a Motion keeps it.
class ContactGeometry {
 public:
  virtual ~ContactGeometry() = default;
  /// The contact and its rates, where the poses change at these rates.
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

/// The first impact of a pair: gap = 0 with a decreasing gap. Without features (kind -1) the bodies come to overlap
/// from then on, and no features say how they meet: the motion cannot go on. With those of kSearchedSoFar they do not meet
/// before that time, and what comes later is to be asked for then: something else may be met first.
struct PredictedImpact {
  double time = 0;       ///< s
  FeaturePair features;  ///< how they meet
};

/// See PredictedImpact.
inline constexpr FeaturePair kSearchedSoFar{-2, -1, -1, 1};

/// Two bodies that touch at the start of a scene (see ContactSource::placed).
struct PlacedContact {
  int a = 0;                          ///< body
  int b = 0;                          ///< body, above a
  std::vector<FeaturePair> features;  ///< at which they touch: one at least, more where an edge or a face lies on a face
};

/// A contact that lasts: the bodies that it holds to each other, a below b, and their features.
struct HeldFeatures {
  int a = -1;            ///< body
  int b = -1;            ///< body
  FeaturePair features;  ///< of a and b
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

  /// The pairs that are in contact at the start of the scene that was begun, in increasing order: the gap of the features
  /// named is 0 but for rounding, or so little below it that this is no overlap. Pairs that part, or that move along each
  /// other, are among them; bodies that never collide are not.
  virtual std::vector<PlacedContact> placed() const { return {}; }

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
  /// the arcs as far as it looks. Bodies that touch at `from` and do not approach are not an impact; where they
  /// begin to approach at once, the impact is at `from`.
  virtual std::optional<PredictedImpact> firstImpact(int a, int b, Arc& arc_a, Arc& arc_b, double from,
                                                     double until) = 0;

  /// The same for bodies that are in lasting contact at the features `held` all that time: the first impact of other
  /// features of theirs. Each of `held` lies on a flat face of one of the two bodies, or crosses its border, and
  /// the arcs neither turn the bodies out of that face nor move them through it. That the contact leaves the border of
  /// the face is not seen here. None in a source whose bodies touch in one place only.
  virtual std::optional<PredictedImpact> firstImpactBeside(int a, int b, std::span<const FeaturePair> held, Arc& arc_a,
                                                           Arc& arc_b, double from, double until) {
    (void)a, (void)b, (void)held, (void)arc_a, (void)arc_b, (void)from, (void)until;
    return std::nullopt;
  }

  /// The same where the moving one of a and b is held by what stands still: `held` are its contacts with fixed bodies, the
  /// other one of a and b among them or not. What stands still is one ground, so a face that goes on from one fixed body to
  /// the next is one face.
  virtual std::optional<PredictedImpact> firstImpactOnGround(int a, int b, std::span<const HeldFeatures> held, Arc& arc_a,
                                                             Arc& arc_b, double from, double until) {
    std::vector<FeaturePair> own;
    for (const HeldFeatures& h : held)
      if (h.a == a && h.b == b) own.push_back(h.features);
    return own.empty() ? firstImpact(a, b, arc_a, arc_b, from, until)
                       : firstImpactBeside(a, b, own, arc_a, arc_b, from, until);
  }

  /// Fixed bodies that the fixed body `body` touches, in increasing order; may name too many, never too few. Where their
  /// faces go on beside its own, its borders carry no contact.
  virtual std::span<const int> groundBeside(int body) const {
    (void)body;
    return {};
  }

  /// All feature pairs of a and b with a gap of at most `reach` at time t, at which the bodies touch: more than one
  /// where an edge or a face lies on a face. May stay empty in a source whose bodies touch in one point only.
  virtual std::vector<FeaturePair> touching(int a, int b, const Arc& arc_a, const Arc& arc_b, double t, double reach) {
    (void)a, (void)b, (void)arc_a, (void)arc_b, (void)t, (void)reach;
    return {};
  }

  /// The gaps of the scene that was begun; a Motion keeps it.
  virtual std::shared_ptr<const ContactGeometry> geometry() const = 0;

  /// An independent source of the same kind, for use in another thread once `begin` was called; null where there is
  /// none.
  virtual std::unique_ptr<ContactSource> another() const { return nullptr; }

  /// Where the steps of `begin`, `firstImpact` and `parting` are counted; null: nowhere. They let its WorkEnded through.
  void countIn(WorkCount* work) { work_ = work; }

 protected:
  WorkCount* work() const { return work_; }  ///< see countIn

 private:
  WorkCount* work_ = nullptr;
};

}  // namespace carom
