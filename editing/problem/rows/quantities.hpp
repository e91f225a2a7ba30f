// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "adjoint/derivative/tangent.h"
#include "editing/constraint.h"
#include "editing/problem/controls/natural_scales.hpp"
#include "editing/problem/rows/quantity_place.hpp"

namespace carom::editing_detail {

/// One row of the table of quantities that a constraint can hold: what the editor asks of a kind. A quantity has up to
/// three numbers, each one row of the problem: value - target = 0. A new kind adds a row to quantities.cpp.
struct QuantityKind {
  const char* word;     ///< in the scene document
  int rows;             ///< 3: components x, y, z; 1: a single number
  int numbers;          ///< that a person gives as the target
  bool all_or_nothing = false;  ///< no number of the target can be left free
  bool only_at_events = false;  ///< at impacts, and at rest where it is `of_rest`
  bool of_rest = true;          ///< there is such a number of a body that has come to rest
  bool turns = false;  ///< depends on the orientation of the body when it is read
  double NaturalScales::*scale = nullptr;  ///< makes a residual dimensionless; null: 1 rad

  /// Target of each row, from the numbers a person gave (NaN: free).
  Vec3 (*target)(const Target&);
  /// Values of the rows, with the time at which the state is read.
  Vec3 (*value)(const BodyState&, double time, const Target&) = nullptr;
  /// The row's derivative with respect to the state (body and instant are filled in by the caller).
  StateSeed (*seed)(const BodyState&, const Target&, int component) = nullptr;
  /// How that changes with the state; null where it does not.
  StateSeed (*seed_rate)(const BodyState&, const BodyStateRate&, const Target&, int component) = nullptr;
  /// Values are measured from the target: their own target is 0, and derivatives depend on where it is.
  bool from_target = false;

  /// In place of `value` and `seed`: one component of what depends on more than the state, such as mass or shape.
  RowReading (*read)(const QuantityPlace&) = nullptr;
  bool by_mass = false;      ///< its scale is that of a kilogram; the body must be one that impacts move
  bool positive = false;     ///< never below 0, and without a regular derivative at 0: targets and maxima lie above
  bool of_shape = false;     ///< the body must have a lowest point
  bool from_another = true;  ///< makes sense as seen from another body
  const char* unit = "";     ///< SI
  bool to_another = false;   ///< is about another body too, which the target names
  bool over_span = false;    ///< has a span of time of its own, whatever the constraint's
};

std::span<const QuantityKind* const> quantityKinds();
/// nullptr when there is none of that word.
const QuantityKind* findQuantityKind(const std::string& word);

}  // namespace carom::editing_detail
