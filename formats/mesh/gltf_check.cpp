// SPDX-License-Identifier: MIT
#include "formats/mesh/gltf_check.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "formats/json/json_place.hpp"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/draco_mesh.hpp"
#include "formats/mesh/triangle_soup.h"

namespace carom::formats_detail {
namespace {

using Place = JsonPlace;

std::uint64_t wholeAt(const Place& place, std::uint64_t least, std::uint64_t most) {
  const bool whole = place.value.is_number_unsigned();
  const std::uint64_t number = whole ? place.value.get<std::uint64_t>() : 0;
  if (!whole || number < least || number > most)
    fail(place.pointer, describe(place.value),
         "an integer from " + std::to_string(least) + " to " + std::to_string(most));
  return number;
}

std::uint64_t wholeOr(const Place& place, const char* member, std::uint64_t otherwise, std::uint64_t least,
                      std::uint64_t most) {
  const auto found = place.find(member);
  return found ? wholeAt(*found, least, most) : otherwise;
}

void checkNumbers(const Place& node, const char* member, std::size_t count) {
  const auto list = node.find(member);
  if (!list) return;
  const auto is_number = [](const Json& item) { return item.is_number(); };
  if (!list->value.is_array() || list->value.size() != count ||
      !std::all_of(list->value.begin(), list->value.end(), is_number))
    fail(list->pointer, describe(list->value), "an array of " + std::to_string(count) + " numbers");
}

std::uint64_t componentSize(std::uint64_t type) {
  constexpr std::uint64_t kFirst = TINYGLTF_COMPONENT_TYPE_BYTE, kSizes[] = {1, 1, 2, 2, 0, 4, 4};  // glTF has no 5124
  return type >= kFirst && type - kFirst < std::size(kSizes) ? kSizes[type - kFirst] : 0;
}

struct ElementType {
  const char* word;
  std::uint64_t components;
};
constexpr ElementType kElementTypes[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                         {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};

class GltfCheck {
 public:
  explicit GltfCheck(const Json& document) : root_{document, ""} {}

  void run() {
    checkVersion();
    forEach("buffers", [&](const Place& p) { checkBuffer(p); });
    forEach("bufferViews", [&](const Place& p) { checkView(p); });
    forEach("accessors", [&](const Place& p) { checkAccessor(p); });
    forEach("meshes", [&](const Place& p) { checkMesh(p); });
    forEach("nodes", [&](const Place& p) { checkNode(p); });
    checkTree();
    forEach("scenes", [&](const Place& p) { checkScene(p); });
    checkIndex(root_, "scene", "scenes");
  }

 private:
  template <class Check>
  void forEach(const char* member, Check check) const {
    const auto list = root_.find(member);
    for (std::size_t i = 0; list && i < list->size(); ++i) check(list->at(i));
  }

  std::size_t countOf(const char* member) const {
    const auto list = root_.value.find(member);
    return list == root_.value.end() ? 0 : list->size();
  }

  std::size_t indexAt(const Place& place, const char* list) const {
    return static_cast<std::size_t>(place.index(countOf(list), list));
  }

  std::optional<std::size_t> checkIndex(const Place& place, const char* member, const char* list) const {
    const auto index = place.find(member);
    return index ? std::optional(indexAt(*index, list)) : std::nullopt;
  }

  std::vector<std::size_t> checkIndices(const Place& place, const char* member, const char* list) const {
    std::vector<std::size_t> indices;
    const auto found = place.find(member);
    for (std::size_t i = 0; found && i < found->size(); ++i) indices.push_back(indexAt(found->at(i), list));
    return indices;
  }

  const Json& item(const char* list, std::size_t index) const { return root_.value.find(list)->at(index); }

  void checkVersion() const {
    const Place version = root_.require("asset").require("version");
    if (!version.value.is_string() || version.value.get_ref<const std::string&>().rfind("2.", 0) != 0)
      fail(version.pointer, describe(version.value), "\"2.0\", the version of glTF that this program reads");
  }

  // ---- data ----

  void checkBuffer(const Place& buffer) {
    bytes_ += wholeAt(buffer.require("byteLength"), 1, kLargestMeshFile);
    if (bytes_ > kLargestMeshFile)
      fail(buffer.pointer, "buffers of " + std::to_string(bytes_) + " bytes and more",
           "at most " + std::to_string(kLargestMeshFile));
    buffer.textOr("uri", "");
  }

  void checkView(const Place& view) const {
    const std::size_t buffer = indexAt(view.require("buffer"), "buffers");
    const std::uint64_t offset = wholeOr(view, "byteOffset", 0, 0, kLargestMeshFile);
    const Place length = view.require("byteLength");
    const std::uint64_t bytes = item("buffers", buffer)["byteLength"].get<std::uint64_t>();
    if (offset + wholeAt(length, 1, kLargestMeshFile) > bytes)
      fail(length.pointer, describe(length.value) + " from byte " + std::to_string(offset) + " on",
           "a view within its buffer of " + std::to_string(bytes) + " bytes");
    const std::uint64_t stride = wholeOr(view, "byteStride", 4, 4, 252);
    if (stride % 4 != 0) fail(view.pointer + "/byteStride", std::to_string(stride), "a multiple of 4");
  }

  // `count` elements of `size` bytes, from `owner`'s byteOffset on in the view that it names, lie within that view.
  void checkRange(const Place& owner, std::uint64_t count, std::uint64_t size, bool strided) const {
    const std::size_t index = indexAt(owner.require("bufferView"), "bufferViews");
    const Place view{item("bufferViews", index), pointerTo("/bufferViews", index)};
    const std::uint64_t offset = wholeOr(owner, "byteOffset", 0, 0, kLargestMeshFile);
    const std::uint64_t stride = strided ? wholeOr(view, "byteStride", size, 4, 252) : size;
    if (stride < size)
      fail(owner.pointer,
           "elements of " + std::to_string(size) + " bytes in a view of stride " + std::to_string(stride),
           "a stride that is not smaller");
    const auto bytes = view.value["byteLength"].get<std::uint64_t>();
    if (offset + (count - 1) * stride + size > bytes)  // at most 2e8 + 2^31 * 252 + 64: no overflow
      fail(owner.pointer,
           std::to_string(count) + " elements of " + std::to_string(size) + " bytes from byte " +
               std::to_string(offset) + " on, " + std::to_string(stride) + " bytes apart",
           "them within view " + std::to_string(index) + " of " + std::to_string(bytes) + " bytes");
  }

  void checkAccessor(const Place& accessor) const {
    constexpr std::uint64_t kMost = 0x7fffffff;
    const Place component = accessor.require("componentType");
    const std::uint64_t size = componentSize(wholeAt(component, 0, kMost));
    if (size == 0) fail(component.pointer, describe(component.value), "one of 5120, 5121, 5122, 5123, 5125 and 5126");
    const Place type = accessor.require("type");
    const auto known = std::find_if(std::begin(kElementTypes), std::end(kElementTypes),
                                    [&](const ElementType& t) { return type.value == t.word; });
    if (known == std::end(kElementTypes))
      fail(type.pointer, describe(type.value), "SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
    const std::uint64_t count = wholeAt(accessor.require("count"), 1, kMost);
    wholeOr(accessor, "byteOffset", 0, 0, kLargestMeshFile);
    if (accessor.find("bufferView")) checkRange(accessor, count, size * known->components, true);
    if (const auto sparse = accessor.find("sparse")) checkSparse(*sparse, count, size * known->components);
  }

  void checkSparse(const Place& sparse, std::uint64_t elements, std::uint64_t element_size) const {
    const std::uint64_t count = wholeAt(sparse.require("count"), 1, elements);
    const Place indices = sparse.require("indices"), values = sparse.require("values");
    const Place type = indices.require("componentType");
    const bool known = type.value == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       type.value == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                       type.value == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (!known) fail(type.pointer, describe(type.value), "one of 5121, 5123 and 5125");
    checkRange(indices, count, componentSize(type.value.get<std::uint64_t>()), false);
    checkRange(values, count, element_size, false);
  }

  // ---- meshes and nodes ----

  void checkAttributes(const Place& attributes) const {
    attributes.requireObject();
    for (const auto& attribute : attributes.value.items())
      indexAt({attribute.value(), pointerTo(attributes.pointer, attribute.key())}, "accessors");
  }

  void checkDraco(const Place& draco) const {
    indexAt(draco.require("bufferView"), "bufferViews");
    const Place attributes = draco.require("attributes");
    attributes.requireObject();
    wholeAt(attributes.require("POSITION"), 0, 0x7fffffff);
    if (draco.find("indices")) fail(draco.pointer + "/indices", "a member that the extension does not have", "none");
  }

  void checkMesh(const Place& mesh) const {
    const Place primitives = mesh.require("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const Place primitive = primitives.at(i);
      checkAttributes(primitive.require("attributes"));
      const auto draco = extensionOf(primitive, kDracoCompression);
      if (draco) checkDraco(*draco);
      if (const auto indices = checkIndex(primitive, "indices", "accessors"))
        if (!draco && !item("accessors", *indices).contains("bufferView"))
          fail(primitive.pointer + "/indices", "an accessor without a view", "one with a view");
      wholeOr(primitive, "mode", TINYGLTF_MODE_TRIANGLES, TINYGLTF_MODE_POINTS, TINYGLTF_MODE_TRIANGLE_FAN);
      const auto targets = primitive.find("targets");
      for (std::size_t k = 0; targets && k < targets->size(); ++k) checkAttributes(targets->at(k));
    }
    if (const auto weights = mesh.find("weights")) checkNumbers(mesh, "weights", weights->value.size());
  }

  void checkNode(const Place& node) const {
    checkIndex(node, "mesh", "meshes");
    checkIndices(node, "children", "nodes");
    checkNumbers(node, "matrix", 16);
    checkNumbers(node, "translation", 3);
    checkNumbers(node, "rotation", 4);
    checkNumbers(node, "scale", 3);
    if (const auto weights = node.find("weights")) checkNumbers(node, "weights", weights->value.size());
  }

  // Every node has one parent at most, and is reached from one that has none.
  void checkTree() {
    const std::size_t count = countOf("nodes");
    parents_.assign(count, count);
    for (std::size_t i = 0; i < count; ++i) {
      const Place node{item("nodes", i), pointerTo("/nodes", i)};
      for (const std::size_t child : checkIndices(node, "children", "nodes")) {
        if (parents_[child] != count)
          fail(node.pointer + "/children",
               "node " + std::to_string(child) + ", which is a child of node " + std::to_string(parents_[child]) +
                   " already",
               "one parent a node");
        parents_[child] = i;
      }
    }
    std::vector<char> rooted(count, 0);
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<std::size_t> path;
      std::size_t node = i;
      for (; node != count && !rooted[node]; node = parents_[node]) {
        if (path.size() > count) fail(pointerTo("/nodes", i), "a node below itself", "nodes in a tree");
        path.push_back(node);
      }
      for (const std::size_t seen : path) rooted[seen] = 1;
    }
  }

  void checkScene(const Place& scene) const {
    std::vector<std::size_t> roots = checkIndices(scene, "nodes", "nodes");
    for (const std::size_t root : roots)
      if (parents_[root] != parents_.size())
        fail(scene.pointer + "/nodes",
             "node " + std::to_string(root) + ", a child of node " + std::to_string(parents_[root]),
             "nodes that have no parent");
    std::sort(roots.begin(), roots.end());
    if (const auto twice = std::adjacent_find(roots.begin(), roots.end()); twice != roots.end())
      fail(scene.pointer + "/nodes", "node " + std::to_string(*twice) + " a second time", "every node once");
  }

  const Place root_;
  std::uint64_t bytes_ = 0;           // of all buffers
  std::vector<std::size_t> parents_;  // by node; the number of nodes where there is none
};

}  // namespace

void checkGltf(const Json& document) { GltfCheck(document).run(); }

}  // namespace carom::formats_detail
