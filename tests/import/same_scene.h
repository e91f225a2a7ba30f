// SPDX-License-Identifier: MIT
#pragma once

#include "formats/base/document.h"

namespace carom::import_tests {

/// Bit for bit, surfaces with their vertices and faces too; names of mesh files are not compared.
void expectSameScene(const Scene& found, const Scene& expected);
/// Duration, controls and constraints.
void expectSameEdit(const Document& found, const Document& expected);

/// The same thing in the world: kind of shape, its volume, where it is and how it moves, mass, centre of mass and
/// inertia. Lengths and moments within `floats` where a surface is in it (glTF keeps its vertices as floats).
void expectSameBody(const Body& found, const Body& expected, double floats = 1e-6);

}  // namespace carom::import_tests
