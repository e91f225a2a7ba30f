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

/// Reads a scene document (version 1 of the format, formats/documents/scene.schema.json) and checks all that can be checked
/// without simulating it. Orientations and plane normals come back as unit vectors. Files of hulls and meshes are read
/// too, each once (formats/mesh/mesh_file.h); their names are relative to the document's folder.
/// Throws FormatError that names file, place, what was found and what was expected.
Document readDocument(const std::string& path);

/// The same for a text; `name` stands for the file in messages. Without a folder a text cannot refer to files: that is
/// an error.
Document parseDocument(std::string_view text, const std::string& name, const std::string& folder = "");

/// The document as text: indented, members in the order of the format's description, every number with as many digits
/// as it takes to read it back exactly. An inertia matrix is put together from moments and axes, and so is rounded to
/// 15 digits of its largest entry. A constraint that has two targets of one kind becomes two constraints. Hulls and
/// meshes that came from a file are written as its name, hulls without one as their vertices.
/// Throws InputError for a scene that the format cannot hold (see validate; a mesh that was made in memory) and numbers
/// that are not finite.
std::string writeDocument(const Document& document);

/// The same for a file in another folder than the document's: file names become relative to that. Reads its own text
/// back first, so that what is written can be opened. Throws InputError.
std::string writeDocumentIn(const std::string& folder, const Document& document);

/// Writes the document to a new file beside `path`, which then takes the name `path`: what was saved there before is
/// either whole or replaced. File names, relative to the folder of the document, become relative to that of `path`.
/// Reads its own text back first, so that what is saved can be opened. Throws FormatError.
void saveDocument(const std::string& path, const Document& document);

}  // namespace carom
