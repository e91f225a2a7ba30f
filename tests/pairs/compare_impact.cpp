// SPDX-License-Identifier: MIT
#include "tests/pairs/compare_impact.h"

#include <algorithm>
#include <sstream>

#include "ode_bridge/ode_contacts.h"

namespace carom::pairs {
namespace {

void keepWorst(double& worst, double error) {
  if (!(error <= worst)) worst = error;
}

template <class... Parts>
std::string sentence(const Parts&... parts) {
  std::ostringstream out;
  out.precision(17);
  ((out << parts << " "), ...);
  return out.str();
}

}  // namespace

std::string withoutNumbers(const std::string& features) {
  std::string kept;
  for (const char c : features)
    if (c < '0' || c > '9') kept += c;
  std::string words;  // single spaces
  std::istringstream in(kept);
  for (std::string word; in >> word;) words += (words.empty() ? "" : " ") + word;
  return words;
}

Found firstFound(const Scene& scene, double duration) {
  OdeContacts contacts(scene);
  SimulateOptions options;
  options.impact_limit = 1;
  const Motion motion = simulate(scene, contacts, duration, options);
  Found found;
  if (motion.events.empty()) return found;
  const Event& event = motion.events[0];
  const Contact& contact = event.contacts[0];
  found.any = true;
  found.time = event.time;
  found.normal = contact.a == 0 ? contact.at.normal : Vec3(-contact.at.normal);
  found.point = contact.at.point;
  found.margin = event.margins.grazing;
  found.contacts = event.contacts.size();
  found.what = motion.describeEvent(0);
  return found;
}

std::string Agreement::compare(const Found& found, const std::optional<FirstImpact>& expected) {
  if (expected && !expected->doubt.empty()) {
    ++doubtful, ++doubts[expected->doubt];
    return "";
  }
  if (!expected) {
    ++misses;
    return found.any ? sentence("invented: nothing meets, found", found.what, "at", found.time) : "";
  }
  ++impacts;
  ++features[withoutNumbers(expected->features)];
  if (!found.any)
    return sentence("missed:", expected->features, "at", double(expected->time), "approach",
                    double(expected->approach));
  const double time = std::abs(double(found.time - expected->time));
  const double normal = (found.normal - expected->touch.normal.rounded()).norm();
  const double point = (found.point - expected->touch.point.rounded()).norm();
  keepWorst(worst_time, time), keepWorst(worst_normal, normal), keepWorst(worst_point, point);
  if (time <= kTimeTolerance && normal <= kPlaceTolerance && point <= kPlaceTolerance && found.contacts == 1) return "";
  return sentence("found", found.what, "at", found.time, "with", found.contacts, "contacts; expected",
                  expected->features, "at", double(expected->time), "; off by", time, "s,", normal, "in the normal,",
                  point, "m in the point; approach", double(expected->approach), "of", double(expected->speed), "m/s");
}

std::string Agreement::summary() const {
  std::ostringstream out;
  out << impacts << " impacts, " << misses << " misses; worst time " << worst_time << " s, normal " << worst_normal
      << ", point " << worst_point << " m;";
  for (const auto& [name, count] : features) out << " " << name << " " << count << ",";
  out << " replaced " << doubtful;
  for (const auto& [why, count] : doubts) out << " [" << why << ": " << count << "]";
  return out.str();
}

}  // namespace carom::pairs
