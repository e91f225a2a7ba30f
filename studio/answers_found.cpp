// SPDX-License-Identifier: MIT
// What was found in the background, and what was imported, as messages.
#include <cmath>

#include "formats/json/json.hpp"
#include "studio/answers.h"
#include "studio/findings.h"
#include "studio/imports.h"

namespace carom::studio {

using namespace formats_detail;

namespace {

std::string foundText(const Json& message) { return compactText(message, Json::error_handler_t::replace); }

}  // namespace

std::string whyMessage(const Findings& found, std::int64_t rev) {
  Json remedies = Json::array();
  for (const SessionRemedy& remedy : found.why.remedies)
    remedies.push_back({{"name", remedy.name},
                        {"kind", nameOf(remedy.kind)},
                        {"removes", remedy.removes},
                        {"solves", remedy.tried ? Json(remedy.solves) : Json()}});
  const std::string& sentence = found.problem.empty() ? found.why.sentence : found.problem;
  return foundText({{"type", "why"}, {"rev", rev}, {"more", found.more}, {"sentence", sentence}, {"remedies", remedies}});
}

std::string alternativesMessage(const Findings& found, std::int64_t rev) {
  const std::string& message = found.problem.empty() ? found.others.message : found.problem;
  return foundText({{"type", "alternatives"}, {"rev", rev}, {"count", found.motions.size()}, {"message", message}});
}

std::string alternativeMembers(const Findings& found, std::size_t index, std::int64_t rev) {
  const EditAlternative& other = found.others.found[index];
  Json changes = Json::array();
  for (const SequenceChange& change : other.sequence_changes)
    if (change.matters) changes.push_back(change.sentence);
  // of a change that is 0 no multiple is
  const double least = found.others.least;
  const Json size = least > 0 ? Json(std::sqrt(other.objective / least)) : Json();
  return foundText({{"rev", rev}, {"index", index}, {"size", size}, {"much_dearer", other.much_dearer}, {"other_impacts", changes}});
}

std::string faceUpMessage(const Findings& found, std::int64_t rev) {
  const std::string& message = found.problem.empty() ? found.face.message : found.problem;
  return foundText({{"type", "face_up"}, {"rev", rev}, {"more", found.more}, {"tried", found.face.tried}, {"found", found.face.content.has_value()}, {"message", message}});
}

std::string sketchMessage(const Findings& found, std::int64_t rev) {
  return foundText({{"type", "sketch"}, {"rev", rev}, {"more", found.more}, {"message", found.problem}});
}

std::string uploadedMessage(std::size_t bytes) { return foundText({{"type", "uploaded"}, {"bytes", bytes}}); }

std::string importedMessage(const ImportedFile& imported) {
  return foundText({{"type", "imported"}, {"path", imported.path}, {"mesh", imported.mesh}, {"warnings", imported.warnings}});
}

std::string cancelledMessage(const std::string& type, std::int64_t rev) {
  return foundText({{"type", type}, {"rev", rev}, {"cancelled", true}});
}

}  // namespace carom::studio
