// SPDX-License-Identifier: MIT
#include "formats/mesh/mesh_file.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "formats/base/read_file.hpp"
#include "formats/mesh/gltf_geometry.hpp"
#include "formats/mesh/obj_reader.hpp"

namespace carom {

using namespace formats_detail;

namespace {

TriangleSoup readObj(const std::string& path) try {
  return parseObj(readFile(path, "an OBJ file", kLargestMeshFile));
} catch (const FormatError&) {
  throw;
} catch (const InputError& error) {
  throw FormatError(path, error.where(), error.message());
}

TriangleSoup readGltf(const std::string& path) try {
  TriangleSoup soup;
  appendSceneTriangles(loadGltf(path), soup.vertices, soup.triangles);
  return soup;
} catch (const FormatError&) {
  throw;
} catch (const InputError& error) {
  throw FormatError(path, error.where(), error.message());
}

struct Reader {
  const char* ending;
  TriangleSoup (*read)(const std::string& path);
};
constexpr Reader kReaders[] = {{".obj", readObj}, {".gltf", readGltf}, {".glb", readGltf}};

}  // namespace

TriangleSoup readMeshFile(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  // A pipe or a device has no end, or waits for one.
  if (std::error_code error; std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw FormatError(path, "", "found no regular file, expected a mesh file");
  for (const Reader& reader : kReaders)
    if (ending == reader.ending) return reader.read(path);
  throw FormatError(path, "",
                    "found a name that ends in \"" + ending + "\", expected a mesh file: .obj, .gltf or .glb");
}

std::vector<Vec3> readPointsFile(const std::string& path) {
  TriangleSoup soup = readMeshFile(path);
  if (soup.triangles.empty()) return std::move(soup.vertices);
  std::vector<char> used(soup.vertices.size(), 0);
  for (const auto& triangle : soup.triangles)
    for (const int vertex : triangle) used[static_cast<std::size_t>(vertex)] = 1;
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) points.push_back(soup.vertices[i]);
  return points;
}

}  // namespace carom
