// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace carom::formats_detail {

/// Writes `content` to the file `path`. A file is replaced as a whole: a reader sees the old one or the new one, which
/// has the mode of the old one, and its owner where that is permitted. A symbolic link stays, and what it points to is
/// written. What is no file (a device, a pipe) is written in place. Throws InputError naming the path; then a file is
/// as it was.
void writeFile(const std::string& path, std::string_view content);

/// The same, and waits until the disk has the file and its name: what people made, which nothing can make again. After
/// a power loss there is the old file or the new one. Throws as `writeFile`; an error of the disk that comes after the
/// file was replaced says so.
void writeFileDurably(const std::string& path, std::string_view content);

/// Throws InputError where `writeFile` could not write, as far as that can be told before: to ask before long work.
void requireWritable(const std::string& path);

}  // namespace carom::formats_detail
