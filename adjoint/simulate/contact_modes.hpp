// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adjoint/contact/contact_path.hpp"
#include "adjoint/constrained/constrained_modes.hpp"
#include "adjoint/simulate/contact_acceleration.hpp"

namespace carom::adjoint_detail {

inline std::vector<const Contact*> pointersTo(const std::vector<Contact>& contacts) {
  std::vector<const Contact*> out;
  for (const Contact& c : contacts) out.push_back(&c);
  return out;
}

/// How a body goes on after an event.
struct ContactChoice {
  /// Null: it flies, as nothing presses it on, or `beyond` says why no path is known for it.
  std::shared_ptr<ContactPath> path;
  State start;                           ///< of the path: what contact fixes of the state is exact
  std::vector<const Contact*> contacts;  ///< that last
  std::string beyond;                    ///< what the path would have to be, as the end of a sentence
  ConstrainedScene scene;                       ///< of a path that is held
  ConstrainedModes modes;                       ///< of that: one of each of `contacts`
  std::vector<Vec3> stopped;             ///< N s: of each, see constrainedStart
};

/// The same at a time where contacts keep the body from what they are with; `closed` are those with n.u = 0, and
/// what they are with is fixed or kinematic.
FreeAcceleration pressedAcceleration(const Motion& motion, int body, const State& state,
                                     const std::vector<const Contact*>& closed, double time);

/// The path of the given form that a body takes at the given contacts.
ContactChoice contactPathOf(const Motion& motion, int body, const State& state,
                            const std::vector<const Contact*>& contacts, PathForm form, double time);

/// That of a body which these contacts hold at rest, what stands still and other bodies at rest. `loose`: not every motion of it is
/// opposed.
ContactChoice restPathOf(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& contacts, bool loose,
                         double time);

/// Slips slower than this count as none: 1e-9 sqrt(g l), m/s.
double leastSlip(double gravity, double reach);

/// The path of a body from `state` at a time on, where `closed` are its contacts with fixed and kinematic bodies that part without
/// speed: rest where rest is possible; sliding or rolling of what has a closed form; else held (docs/equations.md section 11). `hint`: its contact is
/// one of `closed`.
ContactChoice chooseContactPath(const Motion& motion, int body, const State& state,
                                const std::vector<const Contact*>& closed, double time, const ModeHint& hint = {});

/// The path of a body that tilts from where a rim lay flat, at `contacts`: the lowest point of the rim is one of them, which
/// is the limit of a tilt about the axis that it has. `marks`: those of the rim.
ContactChoice tiltingPathOf(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& marks,
                            const std::vector<const Contact*>& contacts, double time, const ModeHint& hint);

/// The path on which contacts hold a body in the modes of `like`, one of each.
ContactChoice constrainedPathOf(const Motion& motion, int body, const State& state, const std::vector<const Contact*>& contacts,
                         const std::vector<PersistentContact>& like, double time);

}  // namespace carom::adjoint_detail
