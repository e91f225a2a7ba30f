// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <vector>

#include "tests/support/scenes.h"

namespace carom::test {

/// A scene that shows one impact law, flight tier, feature pair or way of writing a body. A new kind adds one row.
struct DotProductScene {
  const char* name;
  Scene (*scene)();
  std::size_t impacts = 3;         ///< after so many the motion ends
  std::vector<const char*> has{};  ///< words about the first impact and the plan of body 0
  std::vector<Asked> asked{};
  double lowest_bounce = 0;  ///< above 0: contact lasts
  double duration = 3;       ///< s
};
std::ostream& operator<<(std::ostream& out, const DotProductScene& row);
std::vector<DotProductScene> dotProductScenes();
/// Of the row's duration, or until its number of impacts.
Motion motionOf(const DotProductScene& row);

}  // namespace carom::test
