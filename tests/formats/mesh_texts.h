// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace carom::formats_test {

/// Unit cube about the origin: 8 vertices, 6 squares.
std::string cubeObj();
/// The same without its top.
std::string openCubeObj();

/// Little-endian bytes of numbers, and base64 of bytes.
std::string bytesOf(const std::vector<float>& numbers);
std::string bytesOf(const std::vector<std::uint8_t>& numbers);
std::string bytesOf(const std::vector<std::uint16_t>& numbers);
std::string bytesOf(const std::vector<std::uint32_t>& numbers);
std::string base64(const std::string& bytes);
std::string fromBase64(const std::string& text);

/// A .glb of a JSON text and binary data.
std::string glb(std::string json, std::string binary);

/// A glTF document of one buffer with 4 vertices of a tetrahedron (bytes 0 to 48) and 12 indices of 16 bits (48 to 72):
/// accessors 0 and 1, mesh 0, node 0, scene 0. Without a uri the buffer is that of a .glb.
std::string tetrahedronBytes();
std::string tetrahedronGltf(bool with_uri);

}  // namespace carom::formats_test
