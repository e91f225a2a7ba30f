// SPDX-License-Identifier: MIT
// The only file that knows meshoptimizer. Without the library nothing is decoded.
#include "formats/mesh/meshopt_views.hpp"

#include <tiny_gltf.h>

#include <cstdint>

#ifdef CAROM_MESHOPT
#include <meshoptimizer.h>
#endif

#include "formats/json/json_place.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {
namespace {

constexpr const char* kMeshopt = "EXT_meshopt_compression";

const Json* meshoptOf(const Json& owner) {
  const auto extensions = owner.find("extensions");
  if (extensions == owner.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(kMeshopt);
  return found == extensions->end() ? nullptr : &*found;
}

#ifdef CAROM_MESHOPT

/// What the extension of a view says.
struct CompressedView {
  std::size_t buffer = 0, offset = 0, length = 0, stride = 0, count = 0;
  std::string mode, filter;
};

std::size_t wholeIn(const JsonPlace& place, std::size_t least, std::size_t most) {
  const bool whole = place.value.is_number_unsigned();
  const std::uint64_t number = whole ? place.value.get<std::uint64_t>() : 0;
  if (!whole || number < least || number > most)
    fail(place.pointer, describe(place.value), "an integer from " + std::to_string(least) + " to " + std::to_string(most));
  return number;
}

CompressedView readView(const JsonPlace& place, const std::vector<tinygltf::Buffer>& buffers, std::size_t written) {
  CompressedView view;
  place.requireObject();
  view.buffer = static_cast<std::size_t>(place.require("buffer").index(written, "buffers"));
  if (const auto offset = place.find("byteOffset")) view.offset = wholeIn(*offset, 0, kLargestMeshFile);
  view.length = wholeIn(place.require("byteLength"), 1, kLargestMeshFile);
  view.stride = wholeIn(place.require("byteStride"), 1, 256);
  view.count = wholeIn(place.require("count"), 1, kLargestMeshFile);
  view.mode = place.require("mode").value.is_string() ? place.require("mode").value.get<std::string>() : "";
  view.filter = place.textOr("filter", "NONE");
  const std::size_t bytes = buffers[view.buffer].data.size();
  if (view.offset + view.length > bytes)
    fail(place.pointer + "/byteLength", std::to_string(view.length) + " from byte " + std::to_string(view.offset) + " on",
         "data within buffer " + std::to_string(view.buffer) + " of " + std::to_string(bytes) + " bytes");
  return view;
}

/// What the library takes: it asserts it, or writes past its room.
void checkMode(const JsonPlace& place, const CompressedView& view) {
  const auto refuse = [&](const char* member, const std::string& found, const std::string& expected) {
    fail(place.pointer + "/" + member, found, expected);
  };
  if (view.mode == "ATTRIBUTES") {
    if (view.stride % 4 != 0) refuse("byteStride", std::to_string(view.stride), "a multiple of 4 up to 256");
    const bool turns = view.filter == "OCTAHEDRAL" || view.filter == "QUATERNION";
    if (turns && view.stride != 8 && !(view.filter == "OCTAHEDRAL" && view.stride == 4))
      refuse("filter", view.filter + " with a stride of " + std::to_string(view.stride),
             view.filter == "OCTAHEDRAL" ? "one of 4 or 8" : "one of 8");
    if (!turns && view.filter != "NONE" && view.filter != "EXPONENTIAL")
      refuse("filter", quotedText(view.filter), "NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL");
    return;
  }
  if (view.mode != "TRIANGLES" && view.mode != "INDICES")
    refuse("mode", describe(place.require("mode").value), "ATTRIBUTES, TRIANGLES or INDICES");
  if (view.stride != 2 && view.stride != 4) refuse("byteStride", std::to_string(view.stride), "2 or 4, the size of an index");
  if (view.mode == "TRIANGLES" && view.count % 3 != 0) refuse("count", std::to_string(view.count), "three a triangle");
  if (view.filter != "NONE") refuse("filter", quotedText(view.filter), "NONE: indices have no filter");
}

void decompress(const JsonPlace& place, const CompressedView& view, const unsigned char* from, std::vector<unsigned char>& out) {
  int error = 0;
  if (view.mode == "ATTRIBUTES") {
    error = meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, from, view.length);
    if (error == 0 && view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), view.count, view.stride);
    if (error == 0 && view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), view.count, view.stride);
    if (error == 0 && view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), view.count, view.stride);
  } else if (view.mode == "TRIANGLES") {
    error = meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, from, view.length);
  } else {
    error = meshopt_decodeIndexSequence(out.data(), view.count, view.stride, from, view.length);
  }
  if (error != 0) fail(place.pointer, "data that meshoptimizer does not decode (error " + std::to_string(error) + ")", "whole ones");
}

#endif

}  // namespace

bool isMeshoptFallback(const Json& buffer) { return !buffer.contains("uri") && meshoptOf(buffer) != nullptr; }

#ifdef CAROM_MESHOPT

bool readsMeshopt() { return true; }

void decompressMeshopt(Json& document, std::vector<tinygltf::Buffer>& buffers) {
  const auto views = document.find("bufferViews");
  const std::size_t written = buffers.size();
  std::uint64_t bytes = 0;
  for (std::size_t i = 0; views != document.end() && i < views->size(); ++i) {
    Json& view = (*views)[i];
    const Json* extension = meshoptOf(view);
    if (!extension) continue;
    const std::string where = pointerTo("/bufferViews", i);
    const JsonPlace place{*extension, where + "/extensions/" + kMeshopt};
    const CompressedView compressed = readView(place, buffers, written);
    checkMode(place, compressed);
    const std::size_t room = compressed.count * compressed.stride;
    if (view["byteLength"].get<std::uint64_t>() != room)
      fail(where + "/byteLength", describe(view["byteLength"]), std::to_string(room) + ", as its compression says");
    bytes += room;
    if (bytes > kLargestMeshFile)
      fail(where, "decompressed views of more than " + std::to_string(kLargestMeshFile) + " bytes", "fewer");
    std::vector<unsigned char> data(room);
    decompress(place, compressed, buffers[compressed.buffer].data.data() + compressed.offset, data);
    view["buffer"] = buffers.size();
    view["byteOffset"] = 0;
    view["extensions"].erase(kMeshopt);
    buffers.emplace_back().data = std::move(data);
  }
}

#else

bool readsMeshopt() { return false; }

void decompressMeshopt(Json& document, std::vector<tinygltf::Buffer>& buffers) {
  const auto views = document.find("bufferViews");
  for (std::size_t i = 0; views != document.end() && i < views->size(); ++i) {
    const Json& view = (*views)[i];
    if (meshoptOf(view) && buffers[view["buffer"].get<std::size_t>()].data.empty())
      fail(pointerTo("/bufferViews", i) + "/extensions/" + kMeshopt, "a compressed view",
           "one without compression: this carom was built without meshoptimizer");
  }
}

#endif

}  // namespace carom::formats_detail
