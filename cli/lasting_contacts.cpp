// SPDX-License-Identifier: MIT
#include "cli/lasting_contacts.h"

#include <algorithm>

#include "adjoint/motion/lasting_contact.h"
#include "cli/impacts.h"
#include "cli/table.h"

namespace carom::cli {
namespace {

const char* verbOf(ArcKind kind) {
  switch (kind) {
    case ArcKind::flight:
      break;  // no contact
    case ArcKind::rest:
      return "rests";
    case ArcKind::slide:
      return "slides";
    case ArcKind::roll:
      return "rolls";
    case ArcKind::pivot:
      return "pivots";
    case ArcKind::ride:
      return "rides";
  }
  return "";
}

}  // namespace

void printLastingContacts(Output& out, const Motion& motion, bool all) {
  const std::vector<LastingContact> contacts = lastingContacts(motion);
  if (contacts.empty()) return;
  const std::size_t shown = all ? contacts.size() : std::min(contacts.size(), kMostListed);
  out.text() << "\nPersistent contacts:\n";
  const auto name = [&](int body) { return motion.scene->bodies[static_cast<std::size_t>(body)].name; };
  Table table({"body", "", "on", ">from [s]", ">until [s]"});
  for (std::size_t i = 0; i < shown; ++i) {
    const LastingContact& c = contacts[i];
    table.row({name(c.body), verbOf(c.kind), name(c.with), out.number(c.from),
               c.to == motion.end ? "the end" : out.number(c.to)});
  }
  table.print(out);
  if (shown < contacts.size())
    out.text() << "  and " << contacts.size() - shown << " more; --impacts lists all\n";
}

}  // namespace carom::cli
