// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "formats/drawing/palette.hpp"
#include "formats/svg/view.hpp"

namespace carom::formats_detail {

/// How the path of a body is drawn.
struct BodyLook {
  enum class As { fixed, line, crowd };
  As as = As::fixed;
  Colour colour;
  std::size_t dash = 0;            ///< entry of kPathDashes
  std::vector<std::string> paths;  ///< of a line: its path data in each view
};

/// Dashes of paths: colours are used again with the next one.
inline constexpr std::array kPathDashes = {"none", "11 3", "2.5 2.5"};

/// How all paths are drawn.
struct PathPlan {
  std::vector<BodyLook> looks;  ///< one a body
  double tolerance = 0;         ///< pixels that a line may be off
  int lines = 0, crowd = 0;     ///< bodies of each kind
  bool shaded = false;          ///< the crowd is drawn as a shade, not as thin lines
  double lineWidth() const { return lines > 8 ? 1.6 : 2.2; }
};

/// Chooses them: a line of its own for each body as long as they can be told apart and do not take more than `most`
/// bytes; of more bodies those of `first`, and those that go furthest. Bodies that meet, or whose lines come near each
/// other, get different colours.
PathPlan planPaths(const Motion& motion, const std::vector<View>& views, const std::vector<int>& first,
                   std::size_t most);

}  // namespace carom::formats_detail
