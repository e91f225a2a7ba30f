// SPDX-License-Identifier: MIT
#include "formats/mesh/mesh_file.h"

#include <filesystem>

#include "formats/base/in_file.hpp"
#include "formats/base/read_file.hpp"
#include "formats/base/short_text.hpp"
#include "formats/mesh/gltf_reader.hpp"
#include "formats/mesh/obj_reader.hpp"
#include "formats/mesh/obj_text.hpp"

namespace carom {

using namespace formats_detail;

namespace {

struct Reader {
  const char* ending;
  const char* what;
  TriangleSoup (*parse)(std::string_view bytes, const std::string& folder);
  std::vector<Vec3> (*points)(std::string_view bytes, const std::string& folder);
};

TriangleSoup parseObjIn(std::string_view text, const std::string&) { return parseObj(plainText(text)); }
std::vector<Vec3> objPointsIn(std::string_view text, const std::string&) { return parseObjPoints(plainText(text)); }
std::vector<Vec3> gltfPoints(std::string_view bytes, const std::string& folder) {
  return parseGltfMesh(bytes, folder).vertices;  // those that no triangle uses are left out
}
constexpr Reader kReaders[] = {{".obj", "an OBJ file", parseObjIn, objPointsIn},
                               {".gltf", "a glTF file", parseGltfMesh, gltfPoints},
                               {".glb", "a glTF file", parseGltfMesh, gltfPoints}};

/// Calls f(reader, bytes, folder) for the reader of a file, whose name its errors get.
template <class Function>
auto readWith(const std::string& path, const Function& f) {
  const std::string ending = extensionOf(path);
  // A pipe or a device has no end, or waits for one.
  if (std::error_code error; std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw FormatError(path, "", "found no regular file, expected a mesh file");
  for (const Reader& reader : kReaders)
    if (ending == reader.ending)
      return inFile(path, [&] {
        return f(reader, readFile(path, reader.what, kLargestMeshFile), std::filesystem::path(path).parent_path().string());
      });
  throw FormatError(path, "",
                    "found a name that ends in \"" + ending + "\", expected a mesh file: .obj, .gltf or .glb");
}

}  // namespace

TriangleSoup readMeshFile(const std::string& path) {
  return readWith(path, [](const Reader& reader, const std::string& bytes, const std::string& folder) {
    return reader.parse(bytes, folder);
  });
}

std::vector<Vec3> readPointsFile(const std::string& path) {
  return readWith(path, [](const Reader& reader, const std::string& bytes, const std::string& folder) {
    return reader.points(bytes, folder);
  });
}

}  // namespace carom
