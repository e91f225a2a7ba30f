// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

#include "adjoint/motion/motion.h"

namespace carom {

/// How far to simulate, and what to keep.
struct SimulateOptions {
  /// Events of every kind, bounces too low to be impacts to people among them, after which the motion ends with
  /// MotionStatus::impact_limit.
  std::size_t impact_limit = 20000;
  std::vector<Asked> asked;          ///< a body each; empty asks for everything
  /// false: the arcs of the bodies alone are kept, in less than half of the memory. Such a motion has no events, so it
  /// cannot be differentiated, and times cannot be given as the n-th impact.
  bool record_events = true;
  /// true: throws InputError where bodies overlap at the start, rather than leave them alone until they part.
  bool refuse_overlaps = false;
  /// A bounce that would stay lower than this, m, is none: its elasticity is taken for 0, and the bodies stay in contact.
  /// 0: no contact lasts, and a motion ends at the first that would. By default 1e-12 S, S the largest of the
  /// coordinates of bodies and their sizes.
  std::optional<double> lowest_bounce = {};
  /// Steps of work, after which the motion ends with MotionStatus::step_limit. A step is one of a search for an impact,
  /// one pair of bodies that is looked at, one impact (of n contacts at once n + n^3 / 10) or one series of a rotation, and
  /// 100 are a step along a path in contact without a closed form: a microsecond or some each, but the same number on
  /// every machine. Motion::steps says how many were taken.
  std::size_t step_limit = std::numeric_limits<std::size_t>::max();
  /// Once a stop is requested, from any thread, the motion ends with MotionStatus::stopped.
  std::stop_token stop = {};
  /// Called every few thousand steps, in the thread of the call. The motion does not depend on it.
  std::function<void(const SimulateProgress&)> progress = {};
  /// Asked after every impact, of the motion up to it, which has its events: once it says yes, and `least_duration` is
  /// over, the motion ends, complete, with that time as its duration. Not asked where events are not recorded.
  std::function<bool(const Motion&)> enough = {};
  double least_duration = 0;  ///< s; only beside `enough`
  /// A motion of nearly the same scene, over this duration at least and with the same `asked`. Bodies that are the same
  /// there, and that neither differing ones nor what those meet come to meet, are taken over from it rather than worked
  /// out again: Motion::taken_over of them. Others are worked out beside them, and what they meet as well. So the motion
  /// is the one without it, but for rounding: where the search for an impact begins depends on what else is searched
  /// for. A motion that has ended early, or that differs in what is fixed, in gravity or in the lowest bounce, is of no use.
  const Motion* known = nullptr;
};

/// Simulates a scene from impact to impact up to `duration` seconds.
/// Throws InputError for bad input (see validate; a duration above 1e9 s; `asked` for another number of bodies; a lowest
/// bounce that is no number of 0 to 1e9 m); ends early, with a status and a sentence, where the motion cannot be
/// continued. The same input gives the same motion to the last bit.
Motion simulate(const Scene& scene, ContactSource& contacts, double duration, const SimulateOptions& options = {});

}  // namespace carom
