// SPDX-License-Identifier: MIT
#include "formats/documents/journal_json.h"

#include <algorithm>
#include <cmath>

#include "formats/base/in_file.hpp"
#include "formats/base/read_file.hpp"
#include "formats/base/write_file.hpp"
#include "formats/documents/scene_json.h"
#include "formats/documents/scene_reader.hpp"
#include "formats/json/json.hpp"

namespace carom {

using namespace formats_detail;

namespace {

using Kind = SessionGesture::Kind;
using Ending = SessionGesture::Ending;

/// Runs a reader whose errors begin at `inner` of a part of the document, which stands at `outer`.
template <class Read>
auto readAt(const std::string& inner, const std::string& outer, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    const bool within = error.where().starts_with(inner);
    throw InputError(within ? outer + error.where().substr(inner.size()) : outer, error.message());
  }
}

double stopOr(const Json& options, const char* member, double otherwise) {
  const auto found = options.find(member);
  if (found == options.end()) return otherwise;
  return found->is_null() ? std::numeric_limits<double>::infinity() : found->get<double>();
}

SessionOptions readOptions(const Json& document) {
  SessionOptions options;
  const auto found = document.find("options");
  if (found == document.end()) return options;
  const Json& o = *found;
  if (o.contains("measure_from"))
    options.measure_from = o["measure_from"] == "start" ? MeasureFrom::start : MeasureFrom::grab;
  if (o.contains("sequence"))
    options.sequence = o["sequence"] == "stay" ? SequencePolicy::stay : SequencePolicy::prefer_start;
  options.tolerance = o.value("tolerance", options.tolerance);
  options.drag_simulations = o.value("drag_simulations", options.drag_simulations);
  options.dwell_simulations = o.value("dwell_simulations", options.dwell_simulations);
  options.release_iterations = o.value("release_iterations", options.release_iterations);
  options.drag_seconds = stopOr(o, "drag_seconds", options.drag_seconds);
  options.release_seconds = stopOr(o, "release_seconds", options.release_seconds);
  options.drag_steps = stopOr(o, "drag_steps", options.drag_steps);
  options.release_steps = stopOr(o, "release_steps", options.release_steps);
  options.unmet_nails_off = o.value("unmet_nails_off", false);
  return options;
}

/// The scene documents of a journal so far. Which of them a gesture is about depends on what was undone: names are
/// looked up in the newest, then in those before it.
using Scenes = std::vector<Document>;

template <class Read>
auto inAnyOf(const Scenes& scenes, Read read) {
  for (std::size_t k = scenes.size(); k-- > 1;) {
    try {
      return read(scenes[k]);
    } catch (const InputError&) {
      continue;  // one of the older ones may have it
    }
  }
  return read(scenes[0]);
}

/// In the words of scene documents, so by their reader.
Constraint readOneConstraint(const Json& value, const Scenes& scenes, const std::string& where) {
  Json alone;
  alone["constraints"] = Json::array({value});
  return readAt("/constraints/0", where, [&] {
    return inAnyOf(scenes, [&](const Document& d) { return readConstraints(alone, d.scene, d.duration).at(0); });
  });
}

std::vector<Control> readControlList(const Json& value, const Scenes& scenes, const std::string& where) {
  Json alone;
  alone["controls"] = value;
  return readAt("/controls", where,
                [&] { return inAnyOf(scenes, [&](const Document& d) { return readControls(alone, d.scene); }); });
}

/// A grab is written as the constraint that it is: from that, how the body is held.
void readGrab(SessionGesture& gesture, const std::string& where) {
  const Constraint& held = *gesture.constraint;
  if (held.at.span || !held.relative_to.empty() || !held.regions.empty())
    fail(where, "a grab with a span of time, relative to a body or with a region", "one at a time, an impact or rest");
  gesture.body = held.body, gesture.at = held.at;
  if (held.targets.size() == 1 && held.targets[0].quantity == "orientation") {
    gesture.grip.orientation = true, gesture.grip.place = false;
    return;
  }
  const std::string quantity = held.targets.empty() ? "" : held.targets[0].quantity;
  const bool place = quantity == "position" || quantity == "point" || quantity == "contact";
  const bool turn = held.targets.size() == 2 && held.targets[1].quantity == "orientation";
  if (!place || held.targets.size() > 2 || (held.targets.size() == 2 && !turn))
    fail(where, "other targets",
         "\"position\", \"point\" or \"contact\", and \"orientation\" after it where that is held, or \"orientation\" alone");
  const Target& target = held.targets[0];
  const bool range = !target.min.empty() || !target.max.empty();
  if (range && quantity != "contact") fail(where, "a range", "numbers, or null for what is free");
  gesture.grip.contact = target.quantity == "contact";
  if (target.quantity == "point") gesture.grip.body_point = target.body_point;
  gesture.grip.orientation = turn;
  const char* const kNames[] = {"x", "y", "z"};
  const bool all = std::none_of(target.value.begin(), target.value.end(), [](const TargetNumber& v) { return v.isFree(); });
  for (std::size_t k = 0; k < 3 && !all; ++k)
    if (!target.value[k].isFree()) gesture.grip.components.push_back(kNames[k]);
}

DragTarget readDragTarget(const Json& value, const SessionGesture& gesture, const std::string& where) {
  DragTarget target;
  target.milliseconds = value.value("milliseconds", 0.0);
  target.place = readVector(value["place"]);
  if (value.contains("orientation")) {
    if (!gesture.grip.orientation)
      fail(where + "/orientation", describe(value["orientation"]), "none: the grab does not hold it");
    target.orientation = readQuaternion(value["orientation"], where + "/orientation");
  }
  if (value.contains("components")) {
    if (!gesture.grip.contact) fail(where + "/components", describe(value["components"]), "none: the grab holds no contact");
    target.components = value["components"].get<std::vector<std::string>>();
  }
  if (value.contains("cut_after")) target.cut_after = value["cut_after"].get<int>();
  target.dwell = value.value("dwell", false);
  return target;
}

void readDrag(const Json& value, const Scenes& scenes, SessionGesture& gesture, const std::string& where) {
  gesture.constraint = readOneConstraint(value["drag"], scenes, where + "/drag");
  readGrab(gesture, where + "/drag");
  if (value.contains("grab_nail")) gesture.grabbed_nail = value["grab_nail"].get<int>();
  if (value.contains("also_vary"))
    gesture.controls = readControlList(value["also_vary"], scenes, where + "/also_vary");
  const Json& targets = value["targets"];
  for (std::size_t i = 0; i < targets.size(); ++i)
    gesture.targets.push_back(readDragTarget(targets[i], gesture, where + "/targets/" + std::to_string(i)));
  const auto ending = value["ending"].get<std::string>();
  for (const Ending known : {Ending::release, Ending::cancel, Ending::release_nailed, Ending::release_nailed_where_it_got})
    if (ending == nameOf(known)) gesture.ending = known;
}

/// The scene document of a content joins the others.
void readContent(const Json& value, Scenes& scenes, SessionGesture& gesture, const std::string& where) {
  Document document =
      readAt("", where + "/content", [&] { return readDocument(value["content"], scenes.front().folder); });
  const Json& ids = value["ids"];
  if (ids.size() != document.constraints.size())
    fail(where + "/ids", std::to_string(ids.size()) + " numbers",
         std::to_string(document.constraints.size()) + ", one for each constraint of the content");
  SessionContent content{document.scene, document.duration, document.controls, {}};
  for (std::size_t i = 0; i < ids.size(); ++i)
    content.nails.push_back({ids[i].is_null() ? NailId() : NailId{ids[i].get<int>()}, document.constraints[i]});
  gesture.content = std::move(content);
  gesture.name = textOr(value, "name");
  scenes.push_back(std::move(document));
}

Kind kindOf(const Json& gesture) {
  for (const Kind kind : {Kind::controls, Kind::nail, Kind::unnail, Kind::drag, Kind::undo, Kind::redo, Kind::set_nail,
                          Kind::nail_on, Kind::meet_nails, Kind::keep_sequence})
    if (gesture.contains(nameOf(kind))) return kind;
  return Kind::content;
}

SessionGesture readGesture(const Json& value, Scenes& scenes, const std::string& where) {
  SessionGesture gesture;
  gesture.kind = kindOf(value);
  gesture.milliseconds = value.value("milliseconds", 0.0);
  gesture.nail = value.value("id", -1);
  gesture.reached = value["reached"].get<bool>();
  gesture.distance = value.value("distance", 0.0);
  gesture.numbers = value["numbers"].get<std::vector<double>>();
  if (value.contains("cut_after")) gesture.cut_after = value["cut_after"].get<int>();
  switch (gesture.kind) {
    case Kind::controls:
      gesture.controls = readControlList(value["controls"], scenes, where + "/controls");
      break;
    case Kind::nail:
    case Kind::set_nail:
      gesture.constraint = readOneConstraint(value[nameOf(gesture.kind)], scenes, where + "/" + nameOf(gesture.kind));
      break;
    case Kind::nail_on:
    case Kind::keep_sequence:
      gesture.on = value[nameOf(gesture.kind)].get<bool>();
      break;
    case Kind::unnail:
      gesture.nail = value["unnail"].get<int>();
      break;
    case Kind::drag:
      readDrag(value, scenes, gesture, where);
      break;
    case Kind::content:
      readContent(value, scenes, gesture, where);
      break;
    case Kind::meet_nails:
    case Kind::undo:
    case Kind::redo:
      break;
  }
  return gesture;
}

JournalDocument journalOf(const Json& json, const std::string& folder) {
  const Document scene = readAt("", "/scene", [&] { return readDocument(json["scene"], folder); });
  JournalDocument document;
  document.folder = folder;
  document.name = scene.name, document.notes = scene.notes;
  document.schema = textOr(json, "$schema");
  document.journal = {scene.scene, scene.duration, scene.controls, scene.constraints, readOptions(json), {}};
  Scenes scenes{scene};
  const Json& gestures = json["gestures"];
  for (std::size_t i = 0; i < gestures.size(); ++i)
    document.journal.gestures.push_back(readGesture(gestures[i], scenes, "/gestures/" + std::to_string(i)));
  return document;
}

}  // namespace

JournalDocument parseJournal(std::string_view text, const std::string& name, const std::string& folder) {
  return inFile(name, [&] { return journalOf(parseJson(text, DocumentKind::journal, kLargestJournal), folder); });
}

JournalDocument readJournal(const std::string& path) {
  return parseJournal(readFile(path, "a journal", kLargestJournal), path, folderOf(path));
}

void saveJournal(const std::string& path, const JournalDocument& journal) {
  JournalDocument moved = journal;
  moved.folder = folderOf(path);
  moved.schema = movedSchema(journal.schema, journal.folder, moved.folder);
  moveFiles(moved.journal.scene, journal.folder, moved.folder);
  for (SessionGesture& gesture : moved.journal.gestures)
    if (gesture.content) moveFiles(gesture.content->scene, journal.folder, moved.folder);
  inFile(path, [&] {
    const std::string text = writeJournal(moved);
    parseJournal(text, path, moved.folder);
    writeFileDurably(path, text);
  });
}

Document documentOf(const EditSession& session, const std::string& folder) {
  return {session.scene(), session.duration(), session.controls(), session.constraints(), folder};
}

}  // namespace carom
