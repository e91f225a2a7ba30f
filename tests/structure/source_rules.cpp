// SPDX-License-Identifier: MIT
#include "tests/structure/source_rules.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <string_view>

#include "tests/structure/layers.h"
#include "tests/structure/lengths.h"
#include "tests/structure/public_headers.h"
#include "tests/structure/rooms.h"

namespace carom::structure {
namespace {

using namespace std::string_view_literals;

const std::vector<std::string> kFolders = {"adjoint", "ode_bridge", "editing", "formats", "explore", "cli", "studio",
                                           "python",  "examples",   "tests",   "bench",   "fuzz"};

// Which folders of the project a library may include; a folder that is not listed may include all.
const std::map<std::string, std::vector<std::string>> kMayInclude = {
    {"adjoint", {"adjoint"}},
    {"ode_bridge", {"ode_bridge", "adjoint"}},
    {"editing", {"editing", "adjoint"}},
    {"formats", {"formats", "editing", "ode_bridge", "adjoint"}},
    {"explore", {"explore", "formats", "editing", "adjoint"}},
    {"studio", {"studio", "formats", "editing", "ode_bridge", "adjoint"}},
    {"python", {"python", "explore", "formats", "editing", "ode_bridge", "adjoint"}},
};

// A library that only some files may include. The patterns match whole include names and whole paths.
struct Confined {
  const char* library;
  std::regex include;
  std::regex allowed;
  const char* allowed_text;
};

const std::vector<Confined>& confinedLibraries() {
  static const std::vector<Confined> rows = {
      {"ODE", std::regex("ode/.*"), std::regex("(ode_bridge|bench/charts/engines)/.*\\.cpp"),
       "ode_bridge/*.cpp and bench/charts/engines/*.cpp"},
      {"Bullet", std::regex("bt[A-Z]\\w*\\.h"), std::regex("bench/charts/engines/.*\\.cpp"),
       "bench/charts/engines/*.cpp"},
      {"MuJoCo", std::regex("mujoco/.*"), std::regex("bench/charts/engines/.*\\.cpp"), "bench/charts/engines/*.cpp"},
      {"qhull", std::regex("libqhull(_r|cpp)?/.*"), std::regex("ode_bridge/.*\\.cpp"), "ode_bridge/*.cpp"},
      {"Ipopt", std::regex("(.*/)?Ip[A-Z]\\w*\\.(h|hpp)"), std::regex("editing/.*\\.cpp"), "one editing/*.cpp"},
      {"oneTBB", std::regex("(oneapi/)?tbb/.*"), std::regex("editing/.*\\.cpp"), "editing/*.cpp"},
      {"nlohmann", std::regex("nlohmann/.*"),
       std::regex("((formats|studio)/.*\\.cpp|formats/.*\\.hpp|tests/.*)"),
       "formats/*.cpp, formats/*.hpp, studio/*.cpp and tests"},
      {"valijson", std::regex("valijson/.*"), std::regex("(formats|studio|tests)/.*\\.cpp"),
       "formats/*.cpp, studio/*.cpp and tests"},
      {"TinyGLTF", std::regex("(.*/)?tiny_gltf\\.h"), std::regex("(formats|tests|fuzz)/.*\\.cpp"),
       "formats/*.cpp, tests and fuzz"},
      {"nanobind", std::regex("nanobind/.*"), std::regex("python/src/.*"), "python/src"},
      {"Boost.Multiprecision", std::regex("boost/multiprecision/.*"), std::regex("tests/.*"), "tests"},
      {"Boost", std::regex("boost/(?!multiprecision/).*"), std::regex("(studio/(net|net_stream|deflate)\\.(cpp|hpp)|tests/.*)"),
       "studio/net.cpp, net_stream.hpp, deflate.cpp and tests"},
  };
  return rows;
}

// Functions whose last digit is not the same on every machine: of the C library and the standard one, called with or
// without std::, and Eigen's that call them. adjoint/numeric/elementary.hpp has others.
const std::vector<std::regex>& inexactFunctions() {
  static const std::string names =
      "(a?(sin|cos|tan)h?|atan2|sincos|exp[2m]?1?|log(2|10|1p)?|pow|cbrt|hypot|erfc?|[tl]gamma)";
  static const std::vector<std::regex> rows = {
      std::regex("(\\bstd|[^\\w])::" + names + "[fl]?\\b"),                                  // std::sin, ::sin
      std::regex("\\bstd::(polar|arg|complex|(normal|exponential|gamma|cauchy)_distribution)\\b"),
      std::regex("(\\.|->)" + names + "\\("),                                                 // array().sin()
      std::regex("\\b(AngleAxis[fd]?|Rotation2D[fd]?|slerp|angularDistance|eulerAngles|computeDirect)\\b")};
  return rows;
}
// Without std:: the compiler may take the C library's; `using elementary::sin` makes it ours.
const std::regex& unqualifiedCall() {
  static const std::regex call(
      "(\\breturn|\\s:\\s|[=(,+*/{}?;<>&|!\\[-])\\s*"
      "(a?(sin|cos|tan)h?|atan2|sincos|exp[2m]?1?|log(2|10|1p)?|pow|cbrt|hypot)\\(");
  return call;
}

std::string withoutComments(const std::string& text) { return std::regex_replace(text, std::regex("//[^\n]*"), ""); }

std::vector<std::string> inexactCalls(const std::string& path, const std::string& text) {
  static const std::regex kept("(adjoint|ode_bridge|editing)/.*"), own("adjoint/numeric/elementary(/.*|\\.hpp)");
  std::vector<std::string> found;
  if (!std::regex_match(path, kept) || std::regex_match(path, own)) return found;
  const std::string code = withoutComments(text);
  std::vector<std::regex> rules = inexactFunctions();
  if (code.find("using elementary::") == std::string::npos) rules.push_back(unqualifiedCall());
  for (const std::regex& rule : rules) {
    for (std::sregex_iterator it(code.begin(), code.end(), rule), end; it != end; ++it)
      found.push_back(path + " has " + it->str() + ", whose bits differ by machine; adjoint/numeric/elementary.hpp has its like");
  }
  return found;
}

// What a kind of trajectory alone can do is asked of Trajectory.
std::vector<std::string> trajectoryCasts(const std::string& path, const std::string& text) {
  static const std::regex cast("(static|dynamic|reinterpret)_(pointer_)?cast<[^>]*(Trajectory|ConstrainedPath|ClosedPath|Flight)\\b[^>]*>");
  const std::string code = withoutComments(text);
  std::vector<std::string> found;
  for (std::sregex_iterator it(code.begin(), code.end(), cast), end; it != end; ++it)
    found.push_back(path + " has " + it->str() + "; what one kind of trajectory can do is asked of Trajectory");
  return found;
}

bool contains(const std::vector<std::string>& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

bool includesIpopt(const std::string& text) {
  const auto& rows = confinedLibraries();
  const auto ipopt = std::find_if(rows.begin(), rows.end(), [](const Confined& r) { return r.library == "Ipopt"sv; });
  const auto includes = includesOf(text);
  return std::any_of(includes.begin(), includes.end(),
                     [&](const std::string& name) { return std::regex_match(name, ipopt->include); });
}

}  // namespace

std::string resolved(const std::string& path, const std::string& include) {
  if (!include.starts_with(".")) return include;
  return (std::filesystem::path(path).parent_path() / include).lexically_normal().generic_string();
}

std::string folderOf(const std::string& path) { return path.substr(0, path.find('/')); }

Sources readSources(const std::filesystem::path& root) {
  Sources sources;
  for (const std::string& folder : kFolders) {
    if (!std::filesystem::exists(root / folder)) continue;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (!entry.is_regular_file() || !contains({".h", ".hpp", ".cpp"}, extension)) continue;
      std::ifstream in(entry.path(), std::ios::binary);
      sources[entry.path().lexically_relative(root).generic_string()] = {std::istreambuf_iterator<char>(in), {}};
    }
  }
  return sources;
}

std::vector<std::string> includesOf(const std::string& text) {
  static const std::regex directive("(?:^|\\n)[ \\t]*#[ \\t]*include[ \\t]*[<\"]([^>\"\\n]+)[>\"]");
  std::vector<std::string> result;
  for (std::sregex_iterator it(text.begin(), text.end(), directive), end; it != end; ++it) result.push_back((*it)[1]);
  return result;
}

std::vector<std::string> violations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const std::string folder = folderOf(path);
  const auto may_include = kMayInclude.find(folder);
  for (const std::string& written : includesOf(text)) {
    const std::string include = resolved(path, written);
    for (const Confined& row : confinedLibraries()) {
      if (std::regex_match(include, row.include) && !std::regex_match(path, row.allowed)) {
        found.push_back(path + " includes " + include + "; " + row.library + " belongs in " + row.allowed_text);
      }
    }
    const std::string target = folderOf(include);
    if (may_include != kMayInclude.end() && contains(kFolders, target) && !contains(may_include->second, target)) {
      found.push_back(path + " includes " + include + "; " + folder + "/ must not know " + target + "/");
    }
  }
  for (const auto& more : {inexactCalls(path, text), trajectoryCasts(path, text), layerViolations(path, text), privateIncludes(path, text),
                           privateNamesInCarom(path, text), lengthViolations(path, text)})
    found.insert(found.end(), more.begin(), more.end());
  return found;
}

std::vector<std::string> violations(const Sources& sources) {
  std::vector<std::string> found;
  std::vector<std::string> with_ipopt;
  bool editing_exists = false;
  for (const auto& [path, text] : sources) {
    const auto here = violations(path, text);
    found.insert(found.end(), here.begin(), here.end());
    if (includesIpopt(text)) with_ipopt.push_back(path);
    editing_exists |= folderOf(path) == "editing" && path.ends_with(".cpp");
  }
  if (editing_exists && with_ipopt.size() != 1) {
    std::string sentence =
        "Ipopt's headers must be in exactly one file, found in " + std::to_string(with_ipopt.size()) + ":";
    for (const std::string& path : with_ipopt) sentence += " " + path;
    found.push_back(sentence);
  }
  for (const auto& more : {circleViolations(sources), typesDefinedTwice(sources)})
    found.insert(found.end(), more.begin(), more.end());
  return found;
}

}  // namespace carom::structure
