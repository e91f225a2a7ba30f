// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "formats/base/document.h"
#include "formats/base/format_error.h"

namespace carom {

/// A longer scene document is refused before it is read.
inline constexpr std::size_t kLargestDocument = 16 * 1024 * 1024;  // bytes

/// Reads a scene document (version 1 of the format, formats/documents/scene.schema.json) and validates it as far as
/// possible without simulation. Orientations and plane normals are normalised. Files of hulls and meshes are read,
/// too, each once (formats/mesh/mesh_file.h); their names are relative to the document's folder. Throws FormatError
/// that names file, place, what was found and what was expected.
Document readDocument(const std::string& path);

/// The same for a text; `name` stands for the file in messages. Without a folder a text cannot refer to files: that is
/// an error.
Document parseDocument(std::string_view text, const std::string& name, const std::string& folder = "");

/// The document as text: indented, members in the order of the format's description, every number reads back exactly.
/// An inertia matrix is assembled from moments and axes, and so is rounded to 15 digits of its largest entry. A
/// constraint with two targets of one kind becomes two constraints. Hulls and meshes that came from a file are
/// written as its name, hulls without one as their vertices. Throws InputError for a scene that the format cannot
/// represent (see validate; a mesh constructed in memory) and numbers that are not finite.
std::string writeDocument(const Document& document);

/// The same for a file in another folder: file names become relative to that. Verifies that the text can be read
/// back. Throws InputError.
std::string writeDocumentIn(const std::string& folder, const Document& document);

/// Writes the document atomically to `path` (a new file beside it, then renamed). File names, relative to the folder
/// of the document, become relative to that of `path`. Verifies that the text can be read back. Throws FormatError.
void saveDocument(const std::string& path, const Document& document);

}  // namespace carom
