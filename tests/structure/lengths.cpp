// SPDX-License-Identifier: MIT
#include "tests/structure/lengths.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace carom::structure {
namespace {

constexpr long kLongestFile = 450, kLongestProductFile = 350, kLongestFunction = 60;

bool inProduct(const std::string& path) {
  static const std::regex product("(adjoint|ode_bridge|editing|formats|cli|studio|python)/.*");
  return std::regex_match(path, product);
}

// Functions of a formatted source: a line that ends in a brace opens one, the next brace at its margin closes it. Types,
// namespaces and lists of values open none. `margin`: 0, or 2 for members that are defined in their class.
void findLongFunctions(const std::string& path, const std::string& text, std::size_t margin,
                       std::vector<std::string>& found) {
  static const std::regex other("\\s*(namespace|struct|class|enum|union|extern|typedef)\\b.*|.*=\\s*\\{");
  const std::string blanks(margin, ' '), closing = blanks + "}";
  std::istringstream lines(text);
  long number = 0, opened = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with(closing) && opened > 0) {
      if (number - opened + 1 > kLongestFunction)
        found.push_back(path + " has a function of " + std::to_string(number - opened + 1) + " lines at line " +
                        std::to_string(opened) + "; the most is " + std::to_string(kLongestFunction));
      opened = 0;
    } else if (line.size() > margin && line.starts_with(blanks) && line[margin] != ' ' && line[margin] != '}' &&
               line.ends_with("{") && !std::regex_match(line, other)) {
      opened = number;
    }
  }
}

}  // namespace

std::vector<std::string> lengthViolations(const std::string& path, const std::string& text) {
  std::vector<std::string> found;
  const auto lines = std::count(text.begin(), text.end(), '\n');
  const long most = inProduct(path) ? kLongestProductFile : kLongestFile;
  if (lines > most)
    found.push_back(path + " has " + std::to_string(lines) + " lines; the most is " + std::to_string(most));
  if (inProduct(path))
    for (const std::size_t margin : {0u, 2u}) findLongFunctions(path, text, margin, found);
  return found;
}

}  // namespace carom::structure
