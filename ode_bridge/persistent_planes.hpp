// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "ode_bridge/pair_motion.hpp"
#include "ode_bridge/rim_gap.hpp"

namespace carom::ode_bridge_detail {

/// Normals that differ by less are those of one plane.
inline constexpr double kSamePlane = 1e-9;

/// A contact that holds the one of two bodies that moves to a third, which is fixed as the other one is.
struct ConstrainedElsewhere {
  const Placed* with = nullptr;  ///< the third
  FeaturePair features;
  bool moving_first = true;      ///< of the features' order
};

/// The planes of the contacts that hold two bodies to each other. Two convex pieces in contact lie on the two sides of
/// the plane through the contact across its normal: on the plane itself, what is held; all else of them can meet the other
/// piece only once it has come to the plane. A plane goes with the body that has three held points in it, as it has where
/// a face is held; or, of two edges that cross, with both of them. Of a rim that an edge crosses the cap alone can come to
/// the edge: what else comes to the plane goes on from the same point (FeatureLimit::rolls_over).
class PersistentPlanes {
 public:
  /// The bodies are placed at the start of the search. `elsewhere`: what stands still is one ground, so the face that a
  /// body is held at may go on with the other one; `moves_a` says which of the two moves, where there are any.
  PersistentPlanes(const Placed& a, const Placed& b, std::span<const FeaturePair> held,
             std::span<const ConstrainedElsewhere> elsewhere = {}, bool moves_a = true);

  /// Whether two pieces are on the two sides of a plane, as long as nothing has come to it.
  bool keepApart(int piece_a, int piece_b) const;

  /// The first time in [from, until] at which more of the pieces that planes keep apart has come to a plane, and does not
  /// go away from it: every vertex and rim is followed to first order, with a bound on its second derivative. What stays in a
  /// plane without being held there is looked at at some times of a step, as the guards of a path are.
  /// accept(t, through, broken) is asked whether to end there, as at an impact; where not, the search goes on. `through`: it
  /// is about to go through a plane; `broken`: it has gone through one of contacts elsewhere, which tells nothing then.
  template <class Accept>
  std::optional<double> firstReach(const PairMotion& pair, double from, double until, const Accept& accept) const {
    double t = from;
    for (int steps = 0; t <= until; ++steps) {
      const Reach reach = reachAt(pair, t, until, steps);
      if (reach.touches && accept(t, reach.through, reach.broken)) return t;
      double step = reach.step;
      if (reach.glides && step < reach.apart) step = std::max(step, glidesFor(pair, t, std::min(reach.apart, until - t)));
      if (!(t + step < until)) break;
      t = std::max(t + step, std::nextafter(t, until));
    }
    return std::nullopt;
  }

 private:
  enum class Frame { body_a, body_b, crossed, rim };
  // A vertex or a rim that may come to the plane; of a or of b.
  struct Follower {
    bool of_a;
    Feature feature;
    bool is_rim;
  };
  // A feature that is held, and whether at a face: a rim then comes no further down than to it.
  struct PersistentFeature {
    Family family;
    int index;
    bool at_face;
  };
  struct Plane {
    Frame frame;
    Vec3 n;                           // at the start, from b to a
    double level, room;               // of n.(p - x_b) at the start
    std::vector<FeaturePair> held;
    std::vector<PersistentFeature> held_elsewhere;  // features of the body that moves
    Vec3 normal = Vec3::Zero(), point = Vec3::Zero();  // in the axes of its body, where it goes with one
    Feature edge_a, edge_b;           // crossed; one is a rim in a frame of that name
    double side = 0;                  // rim: the side of the cap that the edge is on; 0 where it lies in it
    std::vector<Follower> followers;
  };
  struct Reach {
    double step = 0;
    bool touches = false, through = false, broken = false;
    bool glides = false;  // something lies in a plane and neither comes to it nor goes
    double apart = 0;     // s: the step that all else allows
  };

  // A plane at an instant: its normal with the bounds |n'| <= n1, |n''| <= n2, and a point of it that goes with a body.
  struct Lying {
    Vec3 n, dn, point, arm, velocity;
    double n1 = 0, n2 = 0;
    double beyond = 0;  // m: how far along n the plane lies beyond that point
    const Placed* with = nullptr;
    double holds_for = std::numeric_limits<double>::infinity();  ///< s, the bounds
  };
  // How far a follower is from the plane, how fast that changes, and what bounds the second derivative for some time.
  struct Approach {
    double gap = 0, rate = 0, bend = 0;
    double speed = 0;    // against which the rate is rounded
    RimGap rim;         // where it is one
  };
  struct Laid;

  // A feature of a contact, and the body that has it.
  struct Side {
    const Placed* body;
    Family family;
    int index;
  };
  struct Through {
    ContactPoint at;  // normal from b to a
    Side of_a, of_b;

    bool crosses() const {  // of two edges or rims
      const auto isCurve = [](Family family) { return family == Family::edge || family == Family::rim; };
      return isCurve(of_a.family) && isCurve(of_b.family);
    }
  };
  Through throughOwn(const FeaturePair& f) const;
  Through through(const ConstrainedElsewhere& h) const;
  void layThrough(const Through& contact, const FeaturePair* own, std::vector<Laid>& laid) const;
  std::vector<Laid> laidApart(Laid laid) const;
  void span(Laid& laid, bool with_ends) const;
  void fixTo(Laid& laid) const;
  template <class Is>
  bool anyPersistent(const Plane& plane, bool of_a, const Is& is) const;
  void addFollowers(Plane& plane);
  bool isBroken(const Plane& plane) const;
  bool holds(const Plane& plane, bool of_a, int piece) const;
  bool staysBeyond(const Plane& plane, bool of_a, int piece) const;
  static bool isRimOf(const Feature& f) { return f.rim > 0 && f.apex == 0; }
  static Approach levelOfCap(const Plane& plane, const Placed& a, const Placed& b);
  double sideOfCap(const Plane& plane) const;
  static bool swingsPastCap(const Plane& plane, const Placed& a, const Placed& b);
  std::optional<Lying> crossing(const Plane& plane, const Placed& a, const Placed& b) const;
  std::optional<Lying> lie(const Plane& plane, const Placed& a, const Placed& b) const;
  Approach approachOf(const Follower& f, const Plane& plane, const Lying& p, const Placed& a, const Placed& b,
                      double window) const;
  Reach reachAt(const PairMotion& pair, double t, double until, int steps) const;
  double glidesFor(const PairMotion& pair, double t, double longest) const;

  const Placed &a_, &b_;
  bool moves_a_;  // of contacts elsewhere
  std::vector<Plane> planes_;
};

}  // namespace carom::ode_bridge_detail
