// SPDX-License-Identifier: MIT
#include "studio/protocol.h"

#include <algorithm>
#include <map>
#include <set>

#include "formats/base/base64.hpp"
#include "formats/documents/scene_reader.hpp"
#include "formats/json/json.hpp"

namespace carom::studio {

using namespace formats_detail;

extern const char* const kProtocolSchema;  // made from protocol.schema.json

namespace {

using What = decltype(Command::what);

const std::map<std::string, Schema>& schemas() {
  static const std::map<std::string, Schema> all = schemasOfDefinitions(kProtocolSchema);
  return all;
}

std::int64_t integer(const Json& message, const char* member) { return message[member].get<std::int64_t>(); }
int nailOf(const Json& message) { return message["nail"].get<int>(); }

When readAt(const Json& at) {
  if (at.is_number()) return When(at.get<double>());
  if (at.contains("rest")) return atRest();
  return nthImpact(at["impact"].get<int>(), at.value("with", std::string()));
}

Grip readGrip(const Json& value) {
  Grip grip;
  grip.contact = value.value("contact", false);
  if (value.contains("point")) grip.body_point = readVector(value["point"]);
  grip.orientation = value.value("orientation", false);
  grip.place = value.value("place", true);
  if (!grip.place && !grip.orientation) fail("/grip/place", "false", "true, or an orientation that is held");
  grip.components = value.value("components", std::vector<std::string>());
  const std::set<std::string> once(grip.components.begin(), grip.components.end());
  if (once.size() != grip.components.size())
    fail("/grip/components", describe(value["components"]), "every component once");
  return grip;
}

std::optional<Quat> readTurn(const Json& message) {
  if (!message.contains("orientation")) return std::nullopt;
  return readQuaternion(message["orientation"], "/orientation");
}

What readHello(const Json& m) {
  return Hello{m["protocol"].get<int>(), m["token"].get<std::string>(), m["tab"].get<std::string>()};
}

What readGrab(const Json& m) {
  Grab grab;
  grab.gesture = integer(m, "gesture");
  grab.body = m["body"].get<std::string>();
  grab.at = readAt(m["at"]);
  if (m.contains("grip")) grab.grip = readGrip(m["grip"]);
  if (grab.grip.contact && (grab.at.impact == 0 || grab.grip.body_point || !grab.grip.place))
    fail("/grip/contact", "true", "false: there is no impact, or something else is held");
  if (m.contains("also_vary")) grab.also_vary = compactText(m["also_vary"]);
  grab.free = m.value("free", false);
  if (grab.free && !grab.also_vary.empty()) fail("/free", "true", "false: also_vary says what varies");
  return grab;
}

std::vector<std::string> readComponents(const Json& m) { return m.value("components", std::vector<std::string>()); }

What readDrag(const Json& m) {
  return Drag{integer(m, "gesture"), integer(m, "seq"), readVector(m["place"]), readTurn(m), readComponents(m)};
}

What readRelease(const Json& m) {
  Release release{integer(m, "gesture"), integer(m, "seq"), std::nullopt, readTurn(m), m.value("nail", false), readComponents(m)};
  if (m.contains("place")) release.place = readVector(m["place"]);
  return release;
}

What readNail(const Json& m) {
  if (m.contains("constraint")) return MakeNail{compactText(m["constraint"]), "", 0.0};
  return MakeNail{"", m["body"].get<std::string>(), readAt(m["at"])};
}

SetNumbers readSet(const Json& m) {
  SetNumbers set{integer(m, "rev"), {}};
  std::size_t i = 0;
  for (const Json& edit : m["edits"]) {
    const auto pointer = edit["pointer"].get<std::string>();
    if (!pointer.starts_with('/'))
      fail(pointerTo("/edits", i) + "/pointer", describe(edit["pointer"]), "a JSON pointer, which begins with /");
    set.edits.emplace_back(pointer, compactText(edit["value"]));
    ++i;
  }
  return set;
}

What readAddBody(const Json& m) {
  AddBody add{integer(m, "rev"), compactText(m["body"]), std::nullopt};
  if (!m.contains("on")) return add;
  add.on = {readVector(m["on"]["point"]), readVector(m["on"]["normal"])};
  if (!(add.on->normal.norm() > 0)) fail("/on/normal", describe(m["on"]["normal"]), "a direction");
  add.on->normal.normalize();
  return add;
}

What readFaceUp(const Json& m) {
  FaceUp face{integer(m, "rev"), m["body"].get<std::string>(), readVector(m["up"]), std::nullopt, m.value("nail", false)};
  if (!(face.up.norm() > 0)) fail("/up", describe(m["up"]), "a direction");
  if (m.contains("place")) face.place = Vec2(m["place"][0].get<double>(), m["place"][1].get<double>());
  return face;
}

What readSketch(const Json& m) {
  Sketch sketch{integer(m, "rev"), m["body"].get<std::string>(), m["from"].get<double>(), {}};
  for (const Json& place : m["places"]) sketch.places.push_back(readVector(place));
  return sketch;
}

What readUpload(const Json& m) {
  std::optional<std::string> bytes = fromBase64(m["data"].get<std::string>());
  if (!bytes) fail("/data", "other text", "bytes in base64 (RFC 4648)");
  return Upload{m["name"].get<std::string>(), m["at"].get<std::size_t>(), std::move(*bytes)};
}

What readImport(const Json& m) {
  return Import{m.value("path", std::string()), m.value("as", std::string()), m.value("replace", false)};
}

What readSave(const Json& m) {
  Save save{std::nullopt, m.value("replace", false)};
  if (m.contains("path")) save.path = m["path"].get<std::string>();
  return save;
}

const std::map<std::string, What (*)(const Json&)>& readers() {
  static const std::map<std::string, What (*)(const Json&)> all = {
      {"hello", readHello},
      {"prove", [](const Json& m) -> What { return Prove{m["nonce"].get<std::string>()}; }},
      {"grab", readGrab},
      {"grab_nail",
       [](const Json& m) -> What {
         return GrabNail{integer(m, "gesture"), nailOf(m)};
       }},
      {"drag", readDrag},
      {"release", readRelease},
      {"cancel", [](const Json& m) -> What { return Cancel{integer(m, "gesture")}; }},
      {"undo", [](const Json&) -> What { return Undo{}; }},
      {"redo", [](const Json&) -> What { return Redo{}; }},
      {"stop", [](const Json&) -> What { return Stop{}; }},
      {"meet_nails", [](const Json&) -> What { return MeetNails{}; }},
      {"nail", readNail},
      {"set_nail",
       [](const Json& m) -> What {
         return SetNail{nailOf(m), compactText(m["constraint"])};
       }},
      {"nail_on",
       [](const Json& m) -> What {
         return NailOn{nailOf(m), m["on"].get<bool>()};
       }},
      {"keep_sequence", [](const Json& m) -> What { return KeepSequence{m["on"].get<bool>()}; }},
      {"unnail", [](const Json& m) -> What { return Unnail{m.value("nail", 0), m.value("sketch", std::string())}; }},
      {"controls",
       [](const Json& m) -> What {
         return SetControls{integer(m, "rev"), compactText(m["controls"])};
       }},
      {"set", [](const Json& m) -> What { return readSet(m); }},
      {"try", [](const Json& m) -> What { return Try{integer(m, "gesture"), integer(m, "seq"), readSet(m)}; }},
      {"add_body", readAddBody},
      {"remove_body", [](const Json& m) -> What { return RemoveBody{integer(m, "rev"), m["body"].get<std::string>()}; }},
      {"copy_body", [](const Json& m) -> What { return CopyBody{integer(m, "rev"), m["body"].get<std::string>()}; }},
      {"rename_body",
       [](const Json& m) -> What {
         return RenameBody{integer(m, "rev"), m["body"].get<std::string>(), m["name"].get<std::string>()};
       }},
      {"new", [](const Json& m) -> What { return NewScene{m.value("replace", false)}; }},
      {"open",
       [](const Json& m) -> What {
         return Open{m["path"].get<std::string>(), m.value("gallery", false), m.value("replace", false)};
       }},
      {"save", readSave},
      {"export", [](const Json& m) -> What { return Export{m["format"].get<std::string>(), m.value("before", false), m.value("keys", std::string()) == "cubic"}; }},
      {"why", [](const Json& m) -> What { return Why{integer(m, "rev")}; }},
      {"alternatives", [](const Json& m) -> What { return Alternatives{integer(m, "rev"), m.value("count", 6)}; }},
      {"remedy", [](const Json& m) -> What { return TakeRemedy{integer(m, "rev"), m["name"].get<std::string>()}; }},
      {"adopt", [](const Json& m) -> What { return Adopt{integer(m, "rev"), m["index"].get<int>()}; }},
      {"face_up", readFaceUp},
      {"sketch", readSketch},
      {"upload", readUpload},
      {"import", readImport},
      {"list", [](const Json& m) -> What { return List{m.value("path", std::string()), m.value("meshes", false)}; }},
      {"gallery", [](const Json&) -> What { return Gallery{}; }}};
  return all;
}

Command readMessage(const Json& message) {
  if (!message.is_object()) fail("", describe(message), "a message: an object");
  if (!message.contains("type")) fail("", "no member \"type\"", "the name of a message");
  const Json& type = message["type"];
  const auto known = type.is_string() ? readers().find(type.get<std::string>()) : readers().end();
  if (known == readers().end()) {
    std::vector<std::string> names;
    for (const auto& [name, reader] : readers()) names.push_back(name);
    fail("/type", describe(type), "one of " + expectedOf(type.is_string() ? type.get<std::string>() : "", names));
  }
  schemas().at(known->first).require(message);
  return {integer(message, "id"), known->second(message)};
}

/// Runs a reader whose errors begin at `inner` of a part of a message, which stands at `outer`.
template <class Read>
auto readPart(const std::string& inner, const std::string& outer, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    const bool within = error.where().starts_with(inner);
    throw InputError(within ? outer + error.where().substr(inner.size()) : outer, error.message());
  }
}

template <class... Kinds>
bool isOneOf(const Command& command) {
  return (std::holds_alternative<Kinds>(command.what) || ...);
}

}  // namespace

bool interrupts(const Command& command) { return !isOneOf<Hello, Prove, Drag, Release, Save, Export, Upload, List, Gallery, Gone, Found>(command); }

bool endsHold(const Command& command) { return isOneOf<Stop, Cancel, Undo, Gone>(command); }

bool makesNeedless(const Command& later, const Drag& waiting) {
  // an orientation that is not said anew stays the one that was said last
  const auto says_all = [&](const auto& hand) {
    return (hand.orientation || !waiting.orientation) && (!hand.components.empty() || waiting.components.empty());
  };
  if (const Drag* drag = std::get_if<Drag>(&later.what)) return drag->gesture == waiting.gesture && says_all(*drag);
  if (const Release* release = std::get_if<Release>(&later.what))
    return release->gesture == waiting.gesture && release->place && release->seq > waiting.seq && says_all(*release);
  if (const Cancel* cancel = std::get_if<Cancel>(&later.what)) return cancel->gesture == waiting.gesture;
  return isOneOf<Undo, Gone>(later);
}

bool passesDrags(const Command& command) { return isOneOf<Stop, Save, List, Gallery>(command); }

Command readCommand(std::string_view text) {
  std::int64_t number = 0;
  try {
    const Json message = parseJson(text);
    if (message.is_object() && message.contains("id") && message["id"].is_number_integer())
      number = message["id"].get<std::int64_t>();
    return readMessage(message);
  } catch (const InputError& error) {
    throw MessageError(number, error);
  }
}

std::vector<Control> readControlsText(const std::string& json, const Scene& scene, const std::string& where) {
  Json alone;
  alone["controls"] = treeOf(json);
  return readPart("/controls", where, [&] { return readControls(alone, scene); });
}

Constraint readConstraintText(const std::string& json, const Scene& scene, double duration, const std::string& where) {
  Json alone;
  alone["constraints"] = Json::array({treeOf(json)});
  return readPart("/constraints/0", where, [&] { return readConstraints(alone, scene, duration).at(0); });
}

}  // namespace carom::studio
