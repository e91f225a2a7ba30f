// SPDX-License-Identifier: MIT
#include "formats/mesh/mesh_file.h"

#include <filesystem>

#include "formats/base/in_file.hpp"
#include "formats/base/read_file.hpp"
#include "formats/base/short_text.hpp"
#include "formats/mesh/gltf_reader.hpp"
#include "formats/mesh/obj_reader.hpp"

namespace carom {

using namespace formats_detail;

namespace {

struct Reader {
  const char* ending;
  const char* what;
  TriangleSoup (*parse)(std::string_view bytes, const std::string& folder);
};
TriangleSoup parseObjIn(std::string_view text, const std::string&) { return parseObj(text); }
constexpr Reader kReaders[] = {{".obj", "an OBJ file", parseObjIn},
                               {".gltf", "a glTF file", parseGltfMesh},
                               {".glb", "a glTF file", parseGltfMesh}};

}  // namespace

TriangleSoup readMeshFile(const std::string& path) {
  const std::string ending = extensionOf(path);
  // A pipe or a device has no end, or waits for one.
  if (std::error_code error; std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw FormatError(path, "", "found no regular file, expected a mesh file");
  for (const Reader& reader : kReaders)
    if (ending == reader.ending)
      return inFile(path, [&] {
        return reader.parse(readFile(path, reader.what, kLargestMeshFile),
                            std::filesystem::path(path).parent_path().string());
      });
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
