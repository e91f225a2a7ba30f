// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "adjoint/scene/shape.h"

/// How the tables of shapes are put together: each layer that asks something of shapes declares one row a shape,
///   Row row(KindOf<Sphere>);
/// which stands with its formulas in the file of that shape, and makes a table of them here, which holds a row for every
/// alternative of Shape or does not compile.
namespace carom::shapes {

/// rowOf(KindOf<S>) for each alternative S of Shape, in their order: the row of a shape is table[shape.index()].
template <class RowOf>
auto tableOf(const RowOf& rowOf) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{rowOf(KindOf<std::variant_alternative_t<I, Shape>>())...};
  }(std::make_index_sequence<std::variant_size_v<Shape>>());
}

}  // namespace carom::shapes
