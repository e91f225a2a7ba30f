// SPDX-License-Identifier: MIT
#include "tests/structure/layers.h"

#include <algorithm>
#include <map>
#include <set>

namespace carom::structure {
namespace {

// Bottom first.
const std::map<std::string, std::vector<std::string>> kLayers = {
    {"adjoint",
     {"base", "numeric", "scene", "flight", "motion", "impact", "simulate", "derivative", "second_order"}},
    {"formats",
     {"base", "json", "mesh", "drawing", "documents", "gltf", "gltf/read", "gltf/write", "svg", "export", "answers"}},
};
const std::vector<std::string> kProduct = {"adjoint", "ode_bridge", "editing", "formats", "cli"};

// "read/bodies.hpp" of "formats/gltf/read/bodies.hpp" lies in "gltf/read".
std::string subFolderOf(const std::string& path) {
  const auto first = path.find('/'), last = path.rfind('/');
  return first == last ? "." : path.substr(first + 1, last - first - 1);
}

// Place of a sub-folder in a list; one that the list lacks counts as the folder around it.
std::size_t rankOf(const std::vector<std::string>& layers, std::string sub_folder) {
  while (true) {
    const auto found = std::find(layers.begin(), layers.end(), sub_folder);
    if (found != layers.end()) return static_cast<std::size_t>(found - layers.begin());
    const auto slash = sub_folder.rfind('/');
    if (slash == std::string::npos) return layers.size();
    sub_folder.resize(slash);
  }
}

std::string roomOf(const std::string& path) { return path.substr(0, path.rfind('.')); }

// Tarjan's algorithm for strongly connected components.
class Components {
 public:
  explicit Components(const std::map<std::string, std::set<std::string>>& graph) : graph_(graph) {
    for (const auto& [room, others] : graph)
      if (!order_.contains(room)) visit(room);
  }
  std::vector<std::vector<std::string>> found;

 private:
  void visit(const std::string& room) {
    order_[room] = low_[room] = static_cast<int>(order_.size());
    stack_.push_back(room);
    open_.insert(room);
    for (const std::string& next : graph_.at(room)) {
      if (!order_.contains(next)) {
        visit(next);
        low_[room] = std::min(low_[room], low_[next]);
      } else if (open_.contains(next)) {
        low_[room] = std::min(low_[room], order_[next]);
      }
    }
    if (low_[room] == order_[room]) take(room);
  }
  void take(const std::string& root) {
    std::vector<std::string> component;
    do {
      component.push_back(stack_.back());
      open_.erase(stack_.back());
      stack_.pop_back();
    } while (component.back() != root);
    std::sort(component.begin(), component.end());
    found.push_back(std::move(component));
  }

  const std::map<std::string, std::set<std::string>>& graph_;
  std::map<std::string, int> order_, low_;
  std::vector<std::string> stack_;
  std::set<std::string> open_;
};

}  // namespace

std::vector<std::string> layerViolations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const auto layers = kLayers.find(folderOf(path));
  if (layers == kLayers.end()) return found;
  const std::string here = subFolderOf(path);
  for (const std::string& include : includesOf(text)) {
    if (folderOf(include) != layers->first || include.find('/') == std::string::npos) continue;
    const std::string there = subFolderOf(include);
    if (rankOf(layers->second, there) > rankOf(layers->second, here))
      found.push_back(path + " includes " + include + "; " + here + "/ stands below " + there + "/");
  }
  return found;
}

std::vector<std::vector<std::string>> circles(const Sources& sources) {
  std::map<std::string, std::set<std::string>> graph;
  for (const auto& [path, text] : sources) {
    if (std::find(kProduct.begin(), kProduct.end(), folderOf(path)) == kProduct.end()) continue;
    std::set<std::string>& others = graph[roomOf(path)];
    for (const std::string& include : includesOf(text))
      if (sources.contains(include) && roomOf(include) != roomOf(path)) others.insert(roomOf(include));
  }
  for (auto& [room, others] : graph)
    std::erase_if(others, [&](const std::string& other) { return !graph.contains(other); });
  std::vector<std::vector<std::string>> found = Components(graph).found;
  std::erase_if(found, [](const auto& component) { return component.size() <= 2; });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace carom::structure
