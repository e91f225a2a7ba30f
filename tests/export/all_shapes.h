// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/base/document.h"

namespace carom::export_tests {

struct NamedShape {
  std::string name;
  Shape shape;
};

/// One shape of every kind that has a surface to close: all but the plane. The mesh is the mug of the examples, so it
/// is concave and has a hole through its handle; the compound's parts overlap.
std::vector<NamedShape> solidShapes();

/// A floor, a ball "ball" of radius 0.1 m that flies over it, and every solid shape, fixed or moving, all turned in odd
/// ways and far enough from each other not to touch in 0.3 s.
Document documentOfAllShapes(bool fixed);

/// A file of examples/assets as a closed surface.
std::shared_ptr<const Surface> assetSurface(const std::string& file);

}  // namespace carom::export_tests
