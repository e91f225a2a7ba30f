// SPDX-License-Identifier: MIT
#pragma once

namespace carom {

struct ShapeKind;

namespace shapes {
/// Stands for a kind of shape where a row is chosen (adjoint/scene/shape_kinds/table.hpp).
template <class S>
struct KindOf {};
}  // namespace shapes

}  // namespace carom
