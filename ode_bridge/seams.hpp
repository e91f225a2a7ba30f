// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "ode_bridge/gaps.hpp"
#include "ode_bridge/support.hpp"

namespace carom::ode_bridge_detail {

/// Takes out contacts at borders that are none: where parts of a body lie flush, a face goes on beyond the edge of one
/// of them, and what touches there touches the faces; so it does at a vertex in the midst of coplanar triangles.
/// `pieces_a` and `pieces_b` are those that touch; `flush` is how far faces may be from one plane.
void dropSeams(const Placed& a, const Placed& b, const std::vector<int>& pieces_a, const std::vector<int>& pieces_b,
               double flush, std::vector<FeaturePair>& found);

/// Whether `f` is a contact of a ball with a sharp border of which the ball touches the face beside, in one plane with it,
/// in one of `touching`.
bool isBesideFace(const Placed& a, const Placed& b, const FeaturePair& f, const std::vector<FeaturePair>& touching,
                  double flush);

}  // namespace carom::ode_bridge_detail
