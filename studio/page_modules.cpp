// SPDX-License-Identifier: MIT
#include "studio/page_modules.h"

#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "adjoint/base/errors.h"

namespace carom::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kThreeModule = "three", kAddons = "three/addons/";

/// What a module calls another, as the address of it without the first "/"; none: it is no name of a module.
std::optional<std::string> moduleNamed(const std::string& importer, std::string_view written) {
  if (written.starts_with("./") || written.starts_with("../"))
    return (fs::path(importer).parent_path() / written).lexically_normal().generic_string();
  if (written == kThreeModule) return "three/build/three.module.js";
  if (written.starts_with(kAddons)) return "three/examples/jsm/" + std::string(written.substr(kAddons.size()));
  return std::nullopt;
}

/// A module with its imports by name, which are added to `imported`. Imports stand as people write them: "from 'NAME'",
/// "import 'NAME'".
std::string withNames(const std::string& module, const std::string& text, std::vector<std::string>& imported) {
  std::string out;
  std::size_t done = 0;
  for (std::size_t quote = text.find('\''); quote != std::string::npos; quote = text.find('\'', quote + 1)) {
    const std::string_view before = std::string_view(text).substr(0, quote);
    const std::size_t end = text.find('\'', quote + 1);
    if (!(before.ends_with(" from ") || before.ends_with("import ")) || end == std::string::npos) continue;
    const std::optional<std::string> name = moduleNamed(module, std::string_view(text).substr(quote + 1, end - quote - 1));
    if (!name) continue;
    imported.push_back(*name);
    out.append(text, done, quote + 1 - done).append(*name);
    done = quote = end;
  }
  return out.append(text, done);
}

}  // namespace

std::map<std::string, std::string> modulesFrom(const PageFiles& files, const std::string& first) {
  std::map<std::string, std::string> modules;
  for (std::vector<std::string> wanted = {first}; !wanted.empty();) {
    const std::string name = wanted.back();
    wanted.pop_back();
    if (modules.contains(name)) continue;
    const PageFile* file = files.find("/" + name);
    if (file == nullptr) throw InputError("found no module '" + name + "' in the page of the studio, expected it");
    modules[name] = withNames(name, file->content, wanted);
  }
  return modules;
}

}  // namespace carom::studio
