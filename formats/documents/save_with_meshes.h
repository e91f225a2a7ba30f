// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/base/document.h"

namespace carom {

/// Saves a document as saveDocument does. Surfaces of hulls and meshes without a file are written beside it, as
/// NAME-meshes/BODY.obj with all digits, one for each surface; hulls of few points are written in the document
/// itself. Returns the mesh files, relative to the document. Throws FormatError.
std::vector<std::string> saveWithMeshes(const std::string& path, const Document& document);

}  // namespace carom
