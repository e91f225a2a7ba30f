// SPDX-License-Identifier: MIT
#include "tests/structure/layers.h"

#include <map>
#include <regex>

namespace carom::structure {
namespace {

// A file belongs to the first layer that its path in the library matches.
struct Layer {
  std::string name;
  std::regex paths;
};

Layer folder(const std::string& name) { return {name, std::regex(name + "/.*")}; }

// From the bottom up: each file includes those of its own layer and of those below.
const std::map<std::string, std::vector<Layer>>& layers() {
  static const std::map<std::string, std::vector<Layer>> libraries = {
      {"adjoint",
       {folder("base"), folder("numeric"), folder("scene"), folder("flight"), folder("motion"), folder("contact"),
        folder("impact"), folder("constrained"), folder("group"), folder("simulate"), folder("derivative"), folder("second_order")}},
      {"editing",
       {folder("detail"),
        {"data", std::regex("(certificate|constraint|control|distribution|edit_options|edit_result|motion_function|sequence_changes|"
                            "session_journal|solver_library|wanted|why_not)\\.(h|cpp)")},
        folder("problem"),
        folder("solve"),
        folder("strategy"),
        folder("report"),
        {"edits and sessions", std::regex("([^/]*|session/.*)")}}},
      {"formats",
       {folder("base"),
        folder("json"),
        {"table of shapes", std::regex("shapes/rows\\.hpp")},  // declared low, filled in above what rows need
        folder("mesh"),
        folder("drawing"),
        folder("documents"),
        {"gltf", std::regex("gltf/[^/]*")},
        folder("gltf/read"),
        folder("gltf/write"),
        folder("svg"),
        folder("shapes"),
        folder("export"),
        folder("answers")}},
      {"explore", {folder("numbers"), folder("draws"), folder("worlds"), folder("store"), {"explore", std::regex("[^/]*")}}},
  };
  return libraries;
}

// Index of the layer of a file, from the bottom; past the end: it has none.
std::size_t layerOf(const std::vector<Layer>& layers, const std::string& path) {
  const std::string inside = path.substr(path.find('/') + 1);
  std::size_t k = 0;
  while (k < layers.size() && !std::regex_match(inside, layers[k].paths)) ++k;
  return k;
}

}  // namespace

std::vector<std::string> layerViolations(const std::string& path, const std::string& text) {
  const auto library = layers().find(folderOf(path));
  if (library == layers().end()) return {};
  const std::vector<Layer>& own_layers = library->second;
  const std::size_t own = layerOf(own_layers, path);
  if (own == own_layers.size()) return {path + " belongs to no layer of " + library->first + "/"};
  std::vector<std::string> found;
  for (const std::string& written : includesOf(text)) {
    const std::string include = resolved(path, written);
    if (folderOf(include) != library->first) continue;
    const std::size_t other = layerOf(own_layers, include);
    if (other == own_layers.size()) {
      found.push_back(path + " includes " + include + ", which belongs to no layer");
    } else if (other > own) {
      found.push_back(path + " (" + own_layers[own].name + ") includes " + include + " (" + own_layers[other].name +
                      "), which stands above it");
    }
  }
  return found;
}

}  // namespace carom::structure
