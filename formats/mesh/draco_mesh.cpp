// SPDX-License-Identifier: MIT
// The only file that knows Draco. Without the library nothing is decoded.
#include "formats/mesh/draco_mesh.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <new>
#include <string>

#ifdef CAROM_DRACO
#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#endif

#include "adjoint/base/errors.h"
#include "formats/json/json.hpp"
#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {

#ifdef CAROM_DRACO

namespace {

/// A mesh that takes less than this is no mesh that an encoder wrote: a plane grid takes more.
constexpr std::uint64_t kMostTrianglesOfAByte = 100;

struct Counts {
  std::uint32_t vertices = 0, triangles = 0;
};

/// The counts that a compressed mesh begins with. Draco makes room for them before it reads on.
Counts countsOf(std::span<const unsigned char> bytes) {
  constexpr std::size_t kHeader = 11;
  constexpr unsigned kHasMetadata = 0x80, kEdgebreaker = 1;
  const auto short_of = [](bool good) {
    if (!good) fail("", "a compressed mesh that ends within its header", "a whole one");
  };
  short_of(bytes.size() > kHeader);
  if (std::string(bytes.begin(), bytes.begin() + 5) != "DRACO") fail("", "bytes that do not begin with \"DRACO\"", "a compressed mesh");
  const unsigned major = bytes[5], minor = bytes[6], type = bytes[7], method = bytes[8], flags = bytes[10];
  if (major != 2 || minor != 2)
    fail("", "version " + std::to_string(major) + "." + std::to_string(minor) + " of the bitstream", "2.2");
  if (type != draco::TRIANGULAR_MESH) fail("", "a cloud of points", "a mesh of triangles");
  draco::DecoderBuffer buffer;
  const std::span<const unsigned char> rest = bytes.subspan(kHeader);
  buffer.Init(reinterpret_cast<const char*>(rest.data()), rest.size(), DRACO_BITSTREAM_VERSION(2, 2));
  if (flags & kHasMetadata) {
    draco::GeometryMetadata metadata;
    if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) fail("", "metadata that are broken", "whole ones");
  }
  Counts counts;
  if (method == kEdgebreaker) {
    std::uint8_t traversal = 0, attributes = 0;
    std::uint32_t symbols = 0, splits = 0;
    short_of(buffer.Decode(&traversal) && draco::DecodeVarint(&counts.vertices, &buffer) &&
             draco::DecodeVarint(&counts.triangles, &buffer) && buffer.Decode(&attributes) &&
             draco::DecodeVarint(&symbols, &buffer) && draco::DecodeVarint(&splits, &buffer));
    const std::uint64_t with_splits = std::uint64_t(counts.vertices) + splits;
    if (with_splits > 3 * std::uint64_t(counts.triangles)) fail("", std::to_string(with_splits) + " vertices", "at most three a triangle");
  } else {
    short_of(draco::DecodeVarint(&counts.triangles, &buffer) && draco::DecodeVarint(&counts.vertices, &buffer));
  }
  return counts;
}

void checkCounts(std::span<const unsigned char> bytes, std::uint64_t vertices, std::uint64_t corners) {
  const Counts counts = countsOf(bytes);
  if (3 * std::uint64_t(counts.triangles) != corners)
    fail("", std::to_string(counts.triangles) + " triangles", "the " + std::to_string(corners) + " corners of the accessor of its indices");
  if (counts.vertices > vertices)
    fail("", std::to_string(counts.vertices) + " vertices", std::to_string(vertices) + ", as in the accessor of POSITION");
  if (counts.triangles > kMostTriangles || vertices > kMostVertices || counts.triangles > kMostTrianglesOfAByte * bytes.size())
    fail("", std::to_string(counts.triangles) + " triangles in " + std::to_string(bytes.size()) + " bytes",
         "at most " + std::to_string(kMostTriangles) + ", and " + std::to_string(kMostTrianglesOfAByte) + " a byte");
}

std::unique_ptr<draco::Mesh> decoded(std::span<const unsigned char> bytes) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  draco::Decoder decoder;
  auto mesh = [&] {
    try {
      return decoder.DecodeMeshFromBuffer(&buffer);
    } catch (const std::bad_alloc&) {
      fail("", "a compressed mesh that asks for more memory than there is", "one that is whole");
    } catch (const std::length_error&) {
      fail("", "a compressed mesh that asks for more memory than there is", "one that is whole");
    }
  }();
  if (!mesh.ok())
    fail("", "a compressed mesh that Draco does not decode (" + oneLine(mesh.status().error_msg_string()) + ")", "a whole one");
  return std::move(mesh).value();
}

}  // namespace

bool readsDraco() { return true; }

DracoMesh decodeDraco(std::span<const unsigned char> bytes, std::uint32_t positions_id, std::uint64_t vertices, std::uint64_t corners,
                      double divisor) {
  checkCounts(bytes, vertices, corners);
  const std::unique_ptr<draco::Mesh> mesh = decoded(bytes);
  if (mesh->num_points() != vertices)
    fail("", std::to_string(mesh->num_points()) + " vertices", std::to_string(vertices) + ", as in the accessor of POSITION");
  if (3 * std::uint64_t(mesh->num_faces()) != corners)
    fail("", std::to_string(mesh->num_faces()) + " triangles",
         "the " + std::to_string(corners) + " corners of the accessor of its indices");
  const draco::PointAttribute* positions = mesh->GetAttributeByUniqueId(positions_id);
  if (positions == nullptr) fail("/attributes/POSITION", std::to_string(positions_id), "the id of an attribute of the compressed mesh");
  if (positions->num_components() != 3)
    fail("/attributes/POSITION", "an attribute of " + std::to_string(positions->num_components()) + " components", "one of 3");

  DracoMesh out;
  out.positions.reserve(vertices);
  for (std::uint32_t i = 0; i < mesh->num_points(); ++i) {
    double p[3] = {};
    const draco::AttributeValueIndex at = positions->mapped_index(draco::PointIndex(i));
    if (at.value() >= positions->size() || !positions->ConvertValue<double>(at, 3, p))
      fail("/attributes/POSITION", "no place of vertex " + std::to_string(i), "one");
    out.positions.push_back(Vec3(p[0], p[1], p[2]) / divisor);
  }
  out.triangles.reserve(corners);
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f))) {
      if (corner.value() >= vertices)
        fail("", "vertex " + std::to_string(corner.value()) + " in triangle " + std::to_string(f), "one below " + std::to_string(vertices));
      out.triangles.push_back(corner.value());
    }
  return out;
}

#else

bool readsDraco() { return false; }

DracoMesh decodeDraco(std::span<const unsigned char>, std::uint32_t, std::uint64_t, std::uint64_t, double) {
  fail("", "a compressed mesh", "one without compression: this carom was built without Draco");
}

#endif

}  // namespace carom::formats_detail
