// SPDX-License-Identifier: MIT
#pragma once

#include "formats/mesh/mesh_file.h"

namespace carom::fuzz {

/// Makes the mesh and the convex hull of what a reader gave, and checks both.
void requireSurfaces(const TriangleSoup& soup);

}  // namespace carom::fuzz
