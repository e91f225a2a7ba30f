// SPDX-License-Identifier: MIT
#include "studio/answers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "carom/version.h"
#include "formats/base/format_error.h"
#include "formats/documents/scene_writer.hpp"
#include "formats/json/json.hpp"
#include "formats/json/json_writer.hpp"
#include "studio/body_edits.h"
#include "studio/open_scene.h"
#include "studio/protocol.h"

namespace carom::studio {

using namespace formats_detail;

namespace {

std::string textOf(const Json& message) { return compactText(message, Json::error_handler_t::replace); }

/// null for what is not finite: JSON has no such numbers.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }
Json textOrNull(const std::string& text) { return text.empty() ? Json() : Json(text); }

template <class Write>
Json written(const Write& write) {
  JsonWriter out;
  out.beginArray();
  write(out);
  out.endArray();
  return treeOf(out.take());
}

Json controlsOf(const std::vector<Control>& controls) {
  return written([&](JsonWriter& out) {
    for (const Control& control : controls) writeControl(out, control);
  });
}

Json atBound(const SessionNumber& now) {
  constexpr double kNear = 1e-9;  // of the scale of the number
  if (!now.varies) return Json();
  if (now.value - now.min <= kNear * now.scale) return Json("min");
  if (now.max - now.value <= kNear * now.scale) return Json("max");
  return Json();
}

/// Of the scene as it is, beside one as it was.
Json numbersOf(const Scene& scene, const std::vector<Control>& controls, const Scene& before) {
  const std::vector<SessionNumber> numbers = sessionNumbers(scene, controls);
  std::vector<SessionNumber> opened;
  try {
    opened = sessionNumbers(before, controls);
  } catch (const InputError&) {  // controls of bodies that came later
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const SessionNumber& n = numbers[i];
    const Control& control = controls[static_cast<std::size_t>(n.control)];
    const bool known = opened.size() == numbers.size() && opened[i].name == n.name;
    const std::optional<std::string> pointer = pointerOf(control, n.component, scene);
    list.push_back({{"control", n.control},
                    {"name", n.name},
                    {"component", n.component},
                    {"varies", n.varies},
                    {"opened", known ? number(opened[i].value) : Json()},
                    {"now", number(n.value)},
                    {"min", number(n.min)},
                    {"max", number(n.max)},
                    {"scale", number(n.scale)},
                    {"at_bound", atBound(n)},
                    {"pointer", pointer ? Json(*pointer) : Json()}});
  }
  return list;
}

Json nailOf(const NailState& nail, const Constraint& constraint) {
  return {{"id", nail.id.value},
          {"constraint", written([&](JsonWriter& out) { writeConstraint(out, constraint); })[0]},
          {"on", nail.on},
          {"available", nail.available},
          {"met", nail.met},
          {"time", number(nail.time)},
          {"error", number(nail.error)},
          {"message", nail.message}};
}

Json nailsOf(const EditSession& session) {
  Json list = Json::array();
  for (const NailState& nail : session.nailStates()) list.push_back(nailOf(nail, session.constraintOf(nail.id)));
  return list;
}

Json vectorJson(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }

/// A shape with a few numbers, as documents have it; of others nothing.
Json simpleShape(const Shape& shape) {
  const bool simple = std::holds_alternative<Sphere>(shape) || std::holds_alternative<Box>(shape) || std::holds_alternative<Capsule>(shape) ||
                      std::holds_alternative<Cylinder>(shape) || std::holds_alternative<Cone>(shape) || std::holds_alternative<Plane>(shape);
  return simple ? written([&](JsonWriter& out) { writeShape(out, shape); })[0] : Json();
}

Json bodiesOf(const Motion& motion) {
  Json list = Json::array();
  for (std::size_t i = 0; i < motion.scene->bodies.size(); ++i) {
    const Body& body = motion.scene->bodies[i];
    const Quat& q = body.orientation;
    Json row = {{"name", body.name},
                {"fixed", body.fixed},
                {"kinematic", body.kinematic},
                {"mass", body.immovable() ? Json() : number((*motion.models)[i].mass)},
                {"material", textOrNull(body.material)},
                {"position", vectorJson(body.position)},
                {"orientation", {q.w(), q.x(), q.y(), q.z()}},
                {"velocity", vectorJson(body.velocity)},
                {"angular_velocity", vectorJson(body.angular_velocity)}};
    if (body.density) row["density"] = *body.density;
    if (body.mass) row["written_mass"] = *body.mass;
    if (Json shape = simpleShape(body.shape); !shape.is_null()) row["shape"] = std::move(shape);
    list.push_back(std::move(row));
  }
  return list;
}

Json materialsOf(const Scene& scene) {
  Json list = Json::array();
  for (const Material& material : scene.materials)
    list.push_back({{"name", material.name}, {"elasticity", material.elasticity}, {"friction", material.friction}});
  return list;
}

/// Bodies that meet in an event.
Json meetingIn(const Event& event) {
  std::set<int> bodies;
  for (const Contact& contact : event.contacts) bodies.insert({contact.a, contact.b});
  return Json(bodies);
}

Json changeOf(const SequenceChange& change, const MotionNews& news) {
  const auto eventOf = [](const Motion* motion, int index) {
    const bool there = motion != nullptr && index >= 0 && static_cast<std::size_t>(index) < motion->events.size();
    return there ? &motion->events[static_cast<std::size_t>(index)] : nullptr;
  };
  const Event* before = eventOf(news.before, change.before);
  const Event* after = eventOf(news.update->motion.get(), change.after);
  const Event* any_of_them = after != nullptr ? after : before;
  return {{"kind", nameOf(change.kind)},
          {"bodies", any_of_them != nullptr ? meetingIn(*any_of_them) : Json::array()},
          {"time_before", before != nullptr ? Json(before->time) : Json()},
          {"time_after", after != nullptr ? Json(after->time) : Json()},
          {"sentence", change.sentence}};
}

}  // namespace

std::string answering(std::int64_t id, std::string message) {
  if (id > 0) message.insert(1, "\"re\":" + std::to_string(id) + (message.size() > 2 ? "," : ""));
  return message;
}

std::string welcomeMessage(const std::string& session, const std::string& folder, std::size_t recovered,
                           const Limits& limits) {
  return textOf({{"type", "welcome"},
                 {"protocol", kProtocol},
                 {"version", kVersion},
                 {"session", session},
                 {"folder", folder},
                 {"recovered", recovered},
                 {"limits", {{"message", limits.message}, {"commands", limits.commands}}}});
}

std::string stateMessage(std::int64_t rev, const OpenScene* scene, const std::string& held_by, std::size_t recovered) {
  Json state = {{"type", "state"}, {"rev", rev}, {"open", scene != nullptr}};
  if (scene == nullptr) return textOf(state);
  const EditSession& session = scene->session();
  state["path"] = scene->path() ? Json(*scene->path()) : Json();
  state["name"] = scene->opened().name;
  if (!scene->path()) state["suggested"] = scene->suggestedName();
  state["saved"] = scene->isSaved();
  state["recovered"] = recovered;
  for (const FileRepair& repair : scene->opened().repairs)
    state["repairs"].push_back(std::filesystem::path(repair.file).filename().string() + " was repaired: " + repair.what);
  state["duration"] = session.duration();
  state["controls"] = controlsOf(session.controls());
  state["numbers"] = numbersOf(session.scene(), session.controls(), scene->opened().scene);
  state["nails"] = nailsOf(session);
  state["keep_sequence"] = session.options().sequence == SequencePolicy::stay;
  state["undo"] = textOrNull(session.undoName());
  state["redo"] = textOrNull(session.redoName());
  state["held_by"] = textOrNull(held_by);
  state["bodies"] = bodiesOf(session.motion());
  state["materials"] = materialsOf(session.scene());
  return textOf(state);
}

std::string stateOfMotion(const Document& document, const Motion& motion, const Scene& before) {
  Json nails = Json::array();
  for (const Constraint& constraint : document.constraints) {
    NailState nail = nailStateIn(motion, constraint, document.duration, SessionOptions().tolerance);
    nail.id = NailId{static_cast<int>(nails.size())};
    nails.push_back(nailOf(nail, constraint));
  }
  return textOf({{"type", "state"},
                 {"rev", 0},
                 {"open", true},
                 {"path", Json()},
                 {"name", document.name},
                 {"saved", true},
                 {"duration", double(document.duration)},
                 {"controls", controlsOf(document.controls)},
                 {"numbers", numbersOf(*motion.scene, document.controls, before)},
                 {"nails", nails},
                 {"undo", Json()},
                 {"redo", Json()},
                 {"held_by", Json()},
                 {"bodies", bodiesOf(motion)},
                 {"materials", materialsOf(*motion.scene)}});
}

std::string errorMessage(const Problem& problem) {
  Json error = {{"type", "error"}, {"code", problem.code}, {"message", problem.message}};
  if (!problem.pointer.empty()) error["pointer"] = problem.pointer;
  if (!problem.file.empty()) error["file"] = problem.file;
  if (!problem.body.empty()) error["body"] = problem.body;
  if (problem.place) error["place"] = vectorJson(*problem.place);
  return textOf(error);
}

Problem problemOf(const std::exception& error) {
  if (dynamic_cast<const FileConflict*>(&error) != nullptr) return {"conflict", error.what(), "", ""};
  if (const auto* file = dynamic_cast<const FileFailure*>(&error)) return {file->code, error.what(), "", ""};
  if (const auto* overlap = dynamic_cast<const Overlap*>(&error))
    return {"overlap", overlap->what(), "", "", overlap->body(), overlap->place()};
  if (const auto* input = dynamic_cast<const InputError*>(&error)) {
    const auto* format = dynamic_cast<const FormatError*>(input);
    const std::string file = format != nullptr ? format->file() : "";
    if (input->where().starts_with('/')) return {"input", input->message(), input->where(), file};
    return {"input", input->std::runtime_error::what(), "", file};
  }
  if (dynamic_cast<const NotComputable*>(&error) != nullptr) return {"input", error.what(), "", ""};
  return {"internal", error.what(), "", ""};
}

std::string savedMessage(const std::string& path, std::int64_t rev) {
  return textOf({{"type", "saved"}, {"path", path}, {"rev", rev}});
}

std::string proofMessage(const std::string& proof) { return textOf({{"type", "proof"}, {"proof", proof}}); }

std::string filesMessage(const std::string& path, const std::vector<ListedFile>& files,
                         const std::vector<std::string>& recent) {
  Json list = Json::array();
  for (const ListedFile& file : files)
    list.push_back({{"path", file.path},
                    {"name", file.name},
                    {"kind", file.folder ? "folder" : file.mesh ? "mesh" : "scene"},
                    {"bytes", file.bytes},
                    {"modified", file.modified}});
  return textOf({{"type", "files"}, {"path", path}, {"files", list}, {"recent", recent}});
}

std::string progressMessage(const std::string& sentence) {
  return textOf({{"type", "progress"}, {"message", sentence}});
}

std::string noticeMessage(const std::string& sentence) {
  return textOf({{"type", "notice"}, {"message", sentence}});
}

std::string galleryMessage(const std::vector<GalleryScene>& scenes) {
  Json list = Json::array();
  for (const GalleryScene& scene : scenes)
    list.push_back(
        {{"path", scene.path}, {"name", scene.name}, {"notes", scene.notes}, {"picture", textOrNull(scene.picture)}});
  return textOf({{"type", "gallery"}, {"scenes", list}});
}

std::string motionMembers(const MotionNews& news) {
  const SessionUpdate& update = *news.update;
  Json members = Json::object();
  if (news.gesture > 0) members["gesture"] = news.gesture;
  if (news.gesture > 0 && news.seq >= 0) members["seq"] = news.seq;
  members["rev"] = news.rev;
  members["stage"] = nameOf(update.stage);
  members["reached"] = update.reached;
  members["distance"] = number(update.distance);
  members["turn"] = number(update.turn);
  members["nail_error"] = number(update.nail_error);
  members["stopped"] = update.stopped;
  members["more"] = news.more;
  if (news.freed) members["freed"] = true;
  members["obstacle"] = {{"kind", nameOf(update.obstacle.kind)},
                         {"numbers", update.obstacle.at_bounds},
                         {"sentence", update.obstacle.sentence}};
  members["changes"] = Json::array();
  for (const SequenceChange& change : update.sequence_changes) members["changes"].push_back(changeOf(change, news));
  return textOf(members);
}

}  // namespace carom::studio
