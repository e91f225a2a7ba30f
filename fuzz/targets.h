// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace carom::fuzz {

/// A reader under test. It is given bytes as if they were a file. To refuse them by InputError, in one short line, is
/// right; so is to read them. Everything else (another exception, a crash, a reading that breaks what the reader's
/// header promises) ends the process.
struct Target {
  const char* name;
  void (*run)(std::string_view bytes);
};

void readScene(std::string_view bytes);  ///< document -> text -> document, mass properties
void readObj(std::string_view bytes);    ///< OBJ -> triangles -> mesh and hull
void readGltf(std::string_view bytes);   ///< glTF -> triangles -> mesh and hull; glTF -> bodies
void readProtocol(std::string_view bytes);  ///< a message of a page of the studio

inline constexpr Target kTargets[] = {{"scene", readScene}, {"obj", readObj}, {"gltf", readGltf}, {"protocol", readProtocol}};

/// Null for a name that is none of theirs.
constexpr const Target* targetNamed(std::string_view name) {
  for (const Target& target : kTargets)
    if (name == target.name) return &target;
  return nullptr;
}

}  // namespace carom::fuzz
