// SPDX-License-Identifier: MIT
#pragma once

#include "adjoint/impact/contact_part.hpp"

namespace carom::adjoint_detail {

/// Rims that lie flat at an event (11.26): where they tilt about, and what is kept of them.

/// Of a contact at a rim that lies flat the derivative of its place, which follows from how the rim tilts; false where it is none.
bool placeFlatRim(const Motion& motion, const Event& event, const Contact& contact, ContactPart<double>& part);

/// A rim that lies flat from the event on has no point of its own: that of its contact stays where it is on the body, whatever varies.
/// Else it would turn round the rim by the inverse of the tilt.
void keepPlaceOnRim(const Motion& motion, const Event& event, const Contact& contact, ContactPart<double>& part);

/// A body that tilts from the event on has come to lie flat there: the gaps of all marks of its rim are closed, in place of that
/// of the point about which it tilts.
void closeMarks(const Motion& motion, const Event& event, std::vector<ContactPart<double>>& parts);

}  // namespace carom::adjoint_detail
