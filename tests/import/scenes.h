// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "formats/base/document.h"

namespace carom::import_tests {

/// Every kind of shape, fixed and moving; every way to write mass, inertia and centre of mass; odd names, materials,
/// gravity, tilts, controls and constraints.
Document documentOfEveryKind();

/// Bodies of random shapes (compounds of compounds too), poses, velocities and mass properties. They may overlap.
Document randomDocument(std::uint32_t seed);

}  // namespace carom::import_tests
