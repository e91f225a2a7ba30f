// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "adjoint/base/times.h"
#include "adjoint/motion/motion.h"

namespace carom {

/// Options of a simulation: limits, and what is recorded.
struct SimulateOptions {
  /// Limit on events of all kinds, including bounces too low to be reported; then the motion ends with
  /// MotionStatus::impact_limit.
  std::size_t impact_limit = 20000;
  std::vector<Asked> asked;          ///< one per body; empty: everything is required
  /// false: keeps only the arcs of the bodies, in less than half of the memory. Such a motion has no events, so it
  /// cannot be differentiated, and has no n-th impact.
  bool record_events = true;
  /// Bodies move on each other in lasting contact, up to 8 at 36 contacts, as groups with one path, which takes some hundred times the
  /// work of one in flight. false: the motion ends where they would.
  bool groups = true;
  /// true: throws InputError if bodies overlap at the start; false: they do not collide until they have separated.
  bool refuse_overlaps = false;
  /// Restitution is set to 0 for a bounce that would stay lower than this, m, and the bodies stay in contact. 0: no
  /// persistent contact; a motion ends at the first that would be. Default: 1e-12 S, S the largest of the coordinates
  /// of bodies and their sizes.
  std::optional<double> lowest_bounce = {};
  /// Work limit in counted steps, after which the motion ends with MotionStatus::step_limit. One step is an iteration
  /// of an impact search, a pair of bodies examined, an impact (n + n^3 / 10 for n simultaneous contacts) or a Taylor
  /// series of a rotation; an integration step along a persistent contact without a closed form counts 100. A step
  /// takes roughly one to several microseconds; the count is the same on every machine. Motion::steps has the number
  /// taken.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  /// Once a stop is requested, from any thread, the motion ends with MotionStatus::stopped.
  std::stop_token stop = {};
  /// Called every few thousand steps, in the calling thread. Does not affect the motion.
  std::function<void(const SimulateProgress&)> progress = {};
  /// Stopping criterion, called after every impact with the motion up to it, events included: once it returns true,
  /// and `least_duration` has passed, the motion ends as complete, with that time as its duration. Not called if
  /// events are not recorded.
  std::function<bool(const Motion&)> stop_when = {};
  Seconds least_duration = 0;  ///< s; only with `stop_when`
  /// Baseline motion of a similar scene, over at least this duration and with the same `asked`. Unchanged bodies that
  /// are not affected by changed ones, directly or through impacts, are reused from it (Motion::taken_over of them);
  /// the others are simulated. The result equals the motion without a baseline up to rounding, because where an
  /// impact search starts depends on the other searches. A baseline that ended early, or that differs in fixed
  /// bodies, gravity or lowest bounce, is ignored.
  const Motion* baseline = nullptr;
  /// By index, kinematic bodies that keep to a trajectory of somebody else's from the start on, whatever strikes them
  /// (see flight/trajectory.hpp). Not with `baseline`.
  std::map<int, std::shared_ptr<adjoint_detail::Trajectory>> given = {};
};

/// Simulates a scene event by event up to `duration` seconds. Throws InputError for invalid input (see validate; a
/// duration above 1e9 s; `asked` of the wrong size; a lowest bounce outside of 0 to 1e9 m); ends early, with a status
/// and a message, if the motion cannot be continued. The same input gives the same motion to the last bit.
Motion simulate(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options = {});
/// A duration is in seconds, no bool and no character.
template <NoTime T>
Motion simulate(const Scene& scene, ContactSource& contacts, T duration, const SimulateOptions& options = {}) = delete;

}  // namespace carom
