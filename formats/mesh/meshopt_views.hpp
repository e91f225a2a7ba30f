// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/json/json.hpp"

namespace tinygltf {
struct Buffer;
}

/// Private to formats/*.cpp.
namespace carom::formats_detail {

/// Whether buffer views compressed by EXT_meshopt_compression are read: the library was there when carom was configured.
bool readsMeshopt();

/// Whether a buffer has no data of its own, as compressed views alone refer to it.
bool isMeshoptFallback(const Json& buffer);

/// Decompresses the views of a glTF document that are compressed by EXT_meshopt_compression: each gets a buffer of its own, at
/// the end of `buffers`. The document has passed checkGltf. Throws InputError at the extension of the view. Without the library
/// views that refer to a buffer with data stay as they are, and others are refused.
void decompressMeshopt(Json& document, std::vector<tinygltf::Buffer>& buffers);

}  // namespace carom::formats_detail
