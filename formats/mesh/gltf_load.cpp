// SPDX-License-Identifier: MIT
// glTF files -> tinygltf::Model. The container, the JSON text and the buffers are read and checked here: tinygltf reads
// past the end of some binary files, recurses as deeply as a file nests, and takes wrong types in silence.
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>

#include "adjoint/base/errors.h"
#include "formats/base/format_error.h"
#include "formats/base/read_file.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/draco_mesh.hpp"
#include "formats/mesh/gltf_check.hpp"
#include "formats/mesh/gltf_geometry.hpp"
#include "formats/mesh/meshopt_views.hpp"
#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {

namespace {

constexpr std::size_t kMaxValues = 4'000'000;

struct Container {
  std::string_view json, binary;
  bool has_binary = false;
};

std::uint32_t numberAt(std::string_view bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = (word << 8) | static_cast<unsigned char>(bytes[offset + i]);
  return word;
}

bool isBinary(std::string_view bytes) { return bytes.substr(0, 4) == "glTF"; }

// Header (magic, version, length), then chunks (length, type, bytes): the JSON text, then at most one of binary data.
Container unpacked(std::string_view bytes) {
  if (!isBinary(bytes)) return {bytes, {}, false};
  constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  if (bytes.size() < kHeader + kChunkHeader)
    fail("", "a binary file of " + std::to_string(bytes.size()) + " bytes", "a header and a chunk, 20 bytes or more");
  if (numberAt(bytes, 4) != 2) fail("", "version " + std::to_string(numberAt(bytes, 4)) + " of the container", "2");
  const std::size_t length = numberAt(bytes, 8);
  if (length > bytes.size())
    fail("", "the end of the file after " + std::to_string(bytes.size()) + " bytes",
         std::to_string(length) + ", as its header says");
  Container container;
  int chunks = 0;
  for (std::size_t at = kHeader; at < length; ++chunks) {
    const std::size_t left = length - at;
    const std::size_t size = left < kChunkHeader ? left : numberAt(bytes, at);
    if (left < kChunkHeader || size > left - kChunkHeader)
      fail("", "a chunk at byte " + std::to_string(at) + " that goes beyond the end", "one within the file");
    const std::string_view content = bytes.substr(at + kChunkHeader, size);
    const std::uint32_t type = numberAt(bytes, at + 4);
    if ((chunks == 0) != (type == kJson))
      fail("", chunks == 0 ? "another first chunk" : "a second chunk of JSON", "one chunk of JSON, the first");
    if (type == kJson) container.json = content;
    if (type == kBinary && !container.has_binary) container.binary = content, container.has_binary = true;
    at += kChunkHeader + size;
  }
  if (chunks == 0) fail("", "no chunk", "one of JSON");
  return container;
}

// ---- buffers ----

int base64Digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::string fromBase64(std::string_view text, const std::string& where) {
  std::string out;
  out.reserve(text.size() / 4 * 3);
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = base64Digit(c);
    if (digit < 0) fail(where, "a character that is not base64", "base64 data");
    bits = (bits << 6) | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out += static_cast<char>((bits >> count) & 0xffu);
  }
  return out;
}

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

// "my%20mug.bin" -> "my mug.bin"
std::string fileName(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool coded = uri[i] == '%' && i + 2 < uri.size() && hexDigit(uri[i + 1]) >= 0 && hexDigit(uri[i + 2]) >= 0;
    name += coded ? static_cast<char>(16 * hexDigit(uri[i + 1]) + hexDigit(uri[i + 2])) : uri[i];
    if (coded) i += 2;
  }
  return name;
}

bool hasControlCharacter(const std::string& name) {
  return std::any_of(name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; });
}

std::string readBufferFile(const std::string& uri, const std::string& folder, const std::string& where) try {
  const std::string name = fileName(uri);
  if (uri.find("://") != std::string::npos || name.empty() || hasControlCharacter(name))
    fail(where, quotedText(uri.substr(0, 60)), "the name of a file");
  const std::filesystem::path inside = std::filesystem::path(name).lexically_normal();
  if (inside.is_absolute() || *inside.begin() == "..")
    fail(where, quotedText(name) + ", a file outside of the document's folder", "one in that folder, or below it");
  const std::filesystem::path path = std::filesystem::path(folder) / name;
  if (std::error_code error; std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    fail(where, quotedText(name) + ", which is not a file", "the buffer's file");
  return readFile(path.string(), "the buffer's file", kLargestMeshFile);
} catch (const FormatError& error) {
  throw InputError(where, error.what());
}

/// The bytes of a buffer, as many as it says or more.
std::string bufferBytes(const Json& buffer, const Container& container, bool first, const std::string& folder,
                        const std::string& where) {
  const auto found = buffer.find("uri");
  if (found == buffer.end()) {
    if (!container.has_binary || !first)
      fail(where, "a buffer without \"uri\"", container.has_binary ? "one, but for the first buffer" : "one");
    return std::string(container.binary);
  }
  const auto& uri = found->get_ref<const std::string&>();
  if (uri.rfind("data:", 0) != 0) return readBufferFile(uri, folder, where + "/uri");
  constexpr std::string_view kMark = ";base64,";
  const std::size_t comma = uri.find(',');
  const std::size_t mark = uri.find(kMark);
  if (mark == std::string::npos || mark + kMark.size() != comma + 1)
    fail(where + "/uri", quotedText(uri.substr(0, 60)), "data in base64");
  return fromBase64(std::string_view(uri).substr(comma + 1), where + "/uri");
}

std::vector<tinygltf::Buffer> readBuffers(const Json& document, const Container& container, const std::string& folder) {
  std::vector<tinygltf::Buffer> buffers;
  const auto list = document.find("buffers");
  for (std::size_t i = 0; list != document.end() && i < list->size(); ++i) {
    const std::string where = pointerTo("/buffers", i);
    const Json& buffer = (*list)[i];
    if (isMeshoptFallback(buffer)) {
      buffers.emplace_back();  // without data: decompressMeshopt gives each view a buffer of its own
      continue;
    }
    const auto length = buffer["byteLength"].get<std::size_t>();
    const std::string bytes = bufferBytes(buffer, container, i == 0, folder, where);
    if (bytes.size() < length)
      fail(where + "/byteLength", std::to_string(length),
           "at most the " + std::to_string(bytes.size()) + " bytes of data that there are");
    tinygltf::Buffer& out = buffers.emplace_back();
    if (const auto name = buffer.find("name"); name != buffer.end() && name->is_string()) out.name = *name;
    out.data.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
  }
  return buffers;
}

/// Views of a buffer without data are compressed, all of them.
void requireData(const Json& document, const std::vector<tinygltf::Buffer>& buffers) {
  const auto views = document.find("bufferViews");
  for (std::size_t i = 0; views != document.end() && i < views->size(); ++i) {
    const auto buffer = (*views)[i]["buffer"].get<std::size_t>();
    if (buffers[buffer].data.empty())
      fail(pointerTo("/bufferViews", i) + "/buffer",
           "buffer " + std::to_string(buffer) + ", a fallback of EXT_meshopt_compression without data",
           "a compressed view, or a buffer with data");
  }
}

// ---- text ----

// tinygltf cuts integers to 32 bits; as real numbers they keep their values in extras and extensions.
void widenIntegers(Json& value) {
  if (value.is_structured()) {
    for (Json& item : value) widenIntegers(item);  // the parser has bounded the depth
  } else if (value.is_number_integer() && std::abs(value.get<double>()) > std::numeric_limits<int>::max()) {
    value = value.get<double>();
  }
}

// tinygltf refuses indices without a view, as those of a compressed primitive are: the extension keeps their accessor.
void keepCompressedIndices(Json& document) {
  const auto meshes = document.find("meshes");
  for (std::size_t m = 0; meshes != document.end() && m < meshes->size(); ++m)
    for (Json& primitive : (*meshes)[m]["primitives"]) {
      const auto indices = primitive.find("indices");
      const bool compressed = primitive.contains("extensions") && primitive["extensions"].contains(kDracoCompression);
      if (!compressed || indices == primitive.end() || document["accessors"][indices->get<std::size_t>()].contains("bufferView")) continue;
      primitive["extensions"][kDracoCompression]["indices"] = *indices;
      primitive.erase("indices");
    }
}

// What geometry does not need, and what tinygltf would refuse or decode in it.
void strip(Json& document) {
  for (const char* member :
       {"buffers", "images", "textures", "materials", "samplers", "cameras", "animations", "skins"})
    document.erase(member);
  if (const auto extensions = document.find("extensions"); extensions != document.end() && extensions->is_object())
    extensions->erase("KHR_lights_punctual");
  keepCompressedIndices(document);
  widenIntegers(document);
}

std::string shortLine(std::string text) {
  constexpr std::size_t kMost = 300;
  text = oneLine(std::move(text));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.substr(0, kMost);
}

}  // namespace

Json gltfJson(std::string_view bytes) { return parseJson(unpacked(bytes).json, kMaxValues); }

tinygltf::Model parseGltf(std::string_view bytes, const std::string& folder) {
  const Container container = unpacked(bytes);
  Json document = parseJson(container.json, kMaxValues);
  checkGltf(document);
  std::vector<tinygltf::Buffer> buffers = readBuffers(document, container, folder);
  decompressMeshopt(document, buffers);
  requireData(document, buffers);
  const std::size_t meshes = document.contains("meshes") ? document["meshes"].size() : 0;
  strip(document);
  const std::string text = compactText(document);
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string error, warning;
  bool good = false;
  try {
    good =
        reader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), folder);
  } catch (const std::exception& exception) {
    error += exception.what();
  }
  if (!good || model.meshes.size() != meshes)
    throw InputError("found no glTF that tinygltf reads (" + shortLine(error) + "), expected a glTF 2.0 file");
  model.buffers = std::move(buffers);
  return model;
}

}  // namespace carom::formats_detail
