// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "adjoint/scene/surface.h"
#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {

/// A surface, and what had to be changed of the triangles for it.
struct RepairedSurface {
  std::shared_ptr<const Surface> surface;
  std::vector<std::string> repairs;  ///< a phrase each; empty: the surface is that of the triangles as they are
};

/// The surface of triangles as meshSurface makes it, or of the triangles repaired where it does not take them. Of a solid,
/// whose mass is that of its volume, they are repaired as well if that closes them, and small holes get lids. Throws
/// InputError for what no repair mends.
RepairedSurface surfaceOf(const TriangleSoup& soup, bool solid);

}  // namespace carom::formats_detail
