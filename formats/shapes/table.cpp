// SPDX-License-Identifier: MIT
#include "formats/detail/shape_rows.hpp"

#include "adjoint/shapes/table.h"

namespace carom::shapes {

const std::array<FormatKind, std::variant_size_v<Shape>>& formatKinds() {
  static const auto kinds = tableOf([](auto kind) {
    static_assert(requires { formatRow(kind); }, "a shape without a row: see formats/detail/shape_rows.hpp");
    return formatRow(kind);
  });
  return kinds;
}

const FormatKind& formatOf(const Shape& shape) { return formatKinds()[shape.index()]; }

}  // namespace carom::shapes
