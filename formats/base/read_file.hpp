// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace carom::formats_detail {

/// The whole of a file of at most `limit` bytes. `what` is what is expected there ("a scene document"). Throws
/// FormatError: no such file, a folder, not readable, or longer.
std::string readFile(const std::string& path, const std::string& what, std::size_t limit);

/// The rest of a stream, of at most `limit` bytes; `name` stands for the file in errors. Throws FormatError.
std::string readStream(std::istream& in, const std::string& name, std::size_t limit);

}  // namespace carom::formats_detail
