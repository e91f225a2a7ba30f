// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <vector>

#include "adjoint/motion/contact_source.h"
#include "adjoint/motion/motion.h"
#include "editing/session_snapshot.h"
#include "studio/protocol.h"

namespace carom::studio {

/// Soft constraints that bring the centre of mass of a body to places along a drawn curve, each at a time of its own: about when the
/// motion has gone as far along its own path as the curve has gone there. All have the notes `notes`. Throws InputError for a curve
/// of no length, a body that does not move and a time at which nothing is left of the motion.
std::vector<Constraint> sketchedNails(const Motion& motion, const Sketch& sketch, const std::string& notes);

/// Notes of the nails of a sketch that no nail has yet.
std::string sketchNotes(const std::vector<std::pair<NailId, Constraint>>& nails);

/// Fits the controls to a drawn curve, by least squares against the change, with what else is nailed; a body that no control moves
/// is thrown otherwise. `first` is told what the first few simulations came to. The nails of the sketch are the last ones of the content.
/// Deterministic unless it is stopped. Throws InputError as sketchedNails. For the thread that owns `contacts`.
SessionContent fitSketch(const SessionSnapshot& snapshot, ContactSource& contacts, const Sketch& sketch,
                         const std::function<void(const std::shared_ptr<const Motion>&)>& first, const std::stop_token& stop);

}  // namespace carom::studio
