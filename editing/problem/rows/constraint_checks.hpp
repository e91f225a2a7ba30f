// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "editing/constraint.h"
#include "editing/problem/rows/quantities.hpp"

/// What is checked of constraints that a person wrote. All throw InputError starting at `where`. Internal to editing/.
namespace carom::editing_detail {

/// The kind of a target, whose numbers are all right.
const QuantityKind& checkedKind(const Target& target, const When& at, const std::string& where);
/// What the kind asks of the body, and of the one that it is seen from.
void checkBody(const QuantityKind& kind, const Body& body, const Constraint& constraint, const std::string& where);
/// The other body that a distance is to; -1 where the kind has none.
int checkedOther(const QuantityKind& kind, const Target& target, const Scene& scene, const std::string& body,
                 const std::string& where);
/// Time, impact, span and rest.
void checkWhen(const When& at, const std::string& where);
/// A body that is held at rest.
void checkComesToRest(const Body& body, const std::string& where);
/// Of one number: a value, or a range with a limit at least.
void checkWanted(const Target& target, const std::string& where);
void checkRegion(const Region& region, const std::string& where);
void checkSpan(const std::pair<double, double>& span, const std::string& where);

/// "its impact 3 with 'floor'", with the noun given.
std::string describeImpact(const When& at, const std::string& noun);
/// "Impact 3 with 'floor' of 'mug' does not come", "'mug' does not come to rest".
std::string describeLack(const When& at, const std::string& body);

}  // namespace carom::editing_detail
