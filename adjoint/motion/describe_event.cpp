// SPDX-License-Identifier: MIT
#include <algorithm>

#include "adjoint/base/arguments.hpp"
#include "adjoint/motion/lasting_contact.h"

namespace carom {

std::string Motion::describeEvent(int index) const {
  const Event& event = events[adjoint_detail::checkedIndex("describeEvent", "event", index, events.size())];
  std::string text;
  for (const Contact& c : event.contacts) {
    if (!text.empty()) text += " + ";
    text += scene->bodies[static_cast<std::size_t>(c.a)].name + "-" +
            scene->bodies[static_cast<std::size_t>(c.b)].name + " (" + geometry->describe(c.a, c.b, c.features) + ")";
  }
  switch (event.kind) {
    case EventKind::impact:
    case EventKind::capture:
      text += std::string(" ") + nameOf(event.mode);
      break;
    case EventKind::transition:
      break;
    case EventKind::placed:
      text += " in contact from the start";
  }
  const std::string changes = describeChanges(*this, index);
  return changes.empty() ? text : text + ": " + changes;
}

std::vector<std::string> Motion::describeEvents(std::size_t count) const {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < std::min(count, events.size()); ++i)
    if (!events[i].tooLow()) lines.push_back(describeEvent(static_cast<int>(i)));
  return lines;
}

}  // namespace carom
