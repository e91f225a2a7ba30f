// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "ode_bridge/box_grid.hpp"
#include "ode_bridge/broad_phase.hpp"
#include "ode_bridge/collision_classes.hpp"

namespace carom::ode_bridge_detail {

/// What the neighbour lists know of a body: a ball that moves, something fixed in a box, or a fixed half space.
struct BodyExtent {
  bool moving = false;
  double radius = 0;  ///< moving: of the ball about its centre of mass
  Bounds box{};       ///< fixed, not a half space
  bool half_space = false;
  Vec3 normal = Vec3::UnitZ();  ///< half space { p : normal . p <= offset }
  double offset = 0;
  double gravity_factor = 1;
};

/// Who may touch whom. With few bodies a body's box holds its whole path, and its neighbours are all whose boxes meet
/// it. With many, each has a box that holds its path for a while with room around it; the neighbours of all are listed
/// at once from the collision library's sweep-and-prune space, and kept. A body that is struck keeps its box; one that
/// comes to the edge of its box gets another one and only its own neighbours are looked up anew. After as many of those
/// as make it worth while all boxes are laid anew, of a size that gives lists of moderate length. All of it depends on
/// nothing but the paths.
class Neighbours {
 public:
  /// Up to so many bodies, boxes hold whole paths.
  static constexpr std::size_t kFew = 40;

  /// `classes` says who never collides: such pairs are in no list.
  void begin(std::vector<BodyExtent> extents, const Vec3& gravity, std::size_t few = kFew,
             CollisionClasses classes = {});

  /// Moving body `body` follows a path from `from` on; its centre is where it was at that time. The path is known
  /// up to `until`; the latest of these is the end of all paths.
  void setPath(int body, const FlightPath& path, const Acceleration& acceleration, double from, double until);
  /// The same in flight, under the body's share of gravity.
  void setPath(int body, const FlightPath& path, double from, double until) {
    setPath(body, path, inFlight(body), from, until);
  }
  /// The same path seen from a later time, where it is known again: for bodies whose acceleration varies.
  void renewPath(int body, const Vec3& x, const Vec3& v, double t);
  /// Whether all boxes are laid anew when a window is asked for at time t.
  bool renewsAll(double t) const { return !few() && t >= all_until_; }
  const FlightPath& path(int body) const { return paths_[static_cast<std::size_t>(body)]; }
  const std::vector<BodyExtent>& extents() const { return extents_; }
  /// The acceleration of a body; FlightPath leaves it out, as it is the same for most.
  const Acceleration& accelerationOf(int body) const {
    return of_their_own_ == 0 ? gravity_ : accelerations_[static_cast<std::size_t>(body)];
  }
  /// Whether two bodies move straight, or not at all, against each other.
  bool sameAcceleration(int a, int b) const {
    return of_their_own_ == 0 || (accelerationOf(a) == accelerationOf(b) && accelerationOf(a).variation == 0);
  }

  /// See ContactSource.
  double window(int body, double t);
  void list(int body, std::vector<int>& out);

  /// The box that holds a body until the end of its window.
  const Bounds& box(int body) const { return boxes_[static_cast<std::size_t>(body)]; }
  /// Bodies in begin() or in this state whose boxes meet: pairs (a < b) that may collide, in increasing order.
  void pairs(std::vector<std::pair<int, int>>& out);

 private:
  bool few() const { return extents_.size() <= few_; }
  bool touches(int body, int other) const;
  Acceleration inFlight(int body) const;
  void renewAll(double t);
  void renew(int body, double t);
  double layBox(int body, double t);
  void chooseRange(double t);
  void relist(int body);

  std::size_t few_ = kFew;
  Acceleration gravity_;
  std::size_t of_their_own_ = 0;             // bodies that move otherwise than under gravity_
  std::vector<Acceleration> accelerations_;  // of each body
  CollisionClasses classes_;
  std::vector<BodyExtent> extents_;
  std::vector<FlightPath> paths_;
  std::vector<Bounds> boxes_;
  std::vector<double> until_;            // end of each body's window
  std::vector<std::vector<int>> lists_;  // of moving bodies, in increasing order
  std::vector<int> half_spaces_;
  double end_ = 0;                         // of all paths
  double all_until_ = 0;                   // when all boxes are laid anew
  double span_ = 0;                        // between such times
  double range_ = 0;                       // how far a body may get from the middle of its box
  std::size_t moving_ = 0, renewals_ = 0;  // single ones since all boxes were laid
  BroadPhase broad_phase_;
  BoxGrid grid_;
  std::vector<std::pair<int, int>> pairs_;
  std::vector<int> found_;
  std::vector<std::pair<int, bool>> changes_;  // of lists: whose, and whether it joins
};

}  // namespace carom::ode_bridge_detail
