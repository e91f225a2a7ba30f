// SPDX-License-Identifier: MIT
#include "studio/open_scene.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>

#include "adjoint/scene/scene.h"
#include "adjoint/simulate/simulate.h"
#include "formats/base/in_file.hpp"
#include "formats/documents/scene_json.h"
#include "formats/json/json.hpp"

namespace carom::studio {

using namespace formats_detail;

namespace {

using Edits = std::vector<std::pair<std::string, std::string>>;

const std::map<std::string, Json>& defaultVectors() {
  static const std::map<std::string, Json> all = {{"position", {0, 0, 0}},
                                                  {"velocity", {0, 0, 0}},
                                                  {"angular_velocity", {0, 0, 0}},
                                                  {"surface_velocity", {0, 0, 0}},
                                                  {"surface_angular_velocity", {0, 0, 0}},
                                                  {"orientation", {1, 0, 0, 0}},
                                                  {"gravity", {0, 0, -9.81}}};
  return all;
}

/// The parts of a pointer, as RFC 6901 escapes them.
std::vector<std::string> tokensOf(const std::string& pointer) {
  std::vector<std::string> tokens;
  for (std::size_t begin = 1; begin <= pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', begin), pointer.size());
    std::string token;
    for (std::size_t i = begin; i < end; ++i) {
      const bool escape = pointer[i] == '~' && i + 1 < end && (pointer[i + 1] == '0' || pointer[i + 1] == '1');
      token += escape ? (pointer[++i] == '0' ? '~' : '/') : pointer[i];
    }
    tokens.push_back(std::move(token));
    begin = end + 1;
  }
  return tokens;
}

/// The item or member of that name; null: there is none.
Json* childOf(Json& parent, const std::string& token) {
  if (parent.is_object()) return parent.contains(token) ? &parent[token] : nullptr;
  const bool digits = !token.empty() && token.size() < 9 &&
                      std::all_of(token.begin(), token.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!parent.is_array() || !digits || std::stoul(token) >= parent.size()) return nullptr;
  return &parent[std::stoul(token)];
}

void edit(Json& document, const std::string& pointer, const std::string& value) {
  const std::vector<std::string> tokens = tokensOf(pointer);
  if (tokens[0] == "controls" || tokens[0] == "constraints")
    fail(pointer, "a number of " + tokens[0], "one of the scene: there are commands for " + tokens[0]);
  Json* at = &document;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    Json* next = childOf(*at, tokens[i]);
    const auto vector = defaultVectors().find(tokens[i]);
    if (next == nullptr && at->is_object() && vector != defaultVectors().end())
      next = &((*at)[tokens[i]] = vector->second);
    if (next == nullptr) fail(pointer, "no such place", "one that the document has");
    at = next;
  }
  if (at->is_object())
    (*at)[tokens.back()] = treeOf(value);  // a member that is not known is found by the schema
  else if (Json* item = childOf(*at, tokens.back()))
    *item = treeOf(value);
  else
    fail(pointer, "no such place", "one that the document has");
}

/// Bodies whose text stays are those of the session: their numbers are not even rounded.
void takeOver(Scene& scene, const Scene& now, const Json& after, const Json& before) {
  const Json &bodies = after["bodies"], &old = before["bodies"];
  for (std::size_t i = 0; i < std::min(bodies.size(), old.size()); ++i)
    if (bodies[i] == old[i]) scene.bodies[i] = now.bodies[i];
}

}  // namespace

OpenScene::OpenScene(OpenedFile file, const std::string& name, std::optional<std::string> path, SessionOptions options)
    : opened_(parseDocument(file.text, name, file.folder)), name_(name), path_(std::move(path)) {
  inFile(name, [&] {
    first_ = last_ = {std::move(file), writeDocument(opened_)};
    options.unmet_nails_off = true;
    contacts_ = std::make_unique<OdeContacts>(opened_.scene);
    session_ = std::make_unique<EditSession>(opened_.scene, *contacts_, opened_.duration, opened_.controls,
                                             opened_.constraints, options);
  });
}

OpenScene::OpenScene(OpenedFile file, const formats_detail::StepLines& steps, const std::string& name,
                     std::optional<std::string> path)
    : opened_(parseDocument(steps.opened, name, file.folder)), name_(name), path_(std::move(path)) {
  inFile(name, [&] {
    first_ = {{steps.opened, file.stamp, file.folder}, writeDocument(opened_)};
    const std::string now = writeDocument(parseDocument(file.text, "", file.folder));
    last_ = {std::move(file), now};
    contacts_ = std::make_unique<OdeContacts>(opened_.scene);
    session_ = std::make_unique<EditSession>(steps.history, *contacts_);
  });
}

std::string OpenScene::stepLine(std::size_t gesture) {
  return formats_detail::stepLine(*session_, gesture, document(), kept_);
}

Document OpenScene::document() const {
  Document document = opened_;
  document.scene = session_->scene();
  document.duration = session_->duration();
  document.controls = session_->controls();
  document.constraints.clear();
  for (const NailId id : session_->nails()) document.constraints.push_back(session_->constraintOf(id));
  return document;
}

std::string OpenScene::suggestedName() const {
  const std::filesystem::path file = name_;
  return first_.file.text == kEmptyScene ? name_ : file.stem().string() + "-copy.json";
}

bool OpenScene::isChanged() const { return writeDocument(document()) != last_.document; }

std::string OpenScene::textIn(const std::string& folder) const {
  const std::string now = writeDocument(document());
  for (const Written* written : {&last_, &first_})
    if (folder == written->file.folder && now == written->document) return written->file.text;
  return writeDocumentIn(folder, document());
}

void OpenScene::wasSaved(const std::string& path, OpenedFile file) {
  last_ = {std::move(file), writeDocument(document())};
  path_ = path;
}

std::optional<FileStamp> OpenScene::stamp() const { return path_ ? std::optional(last_.file.stamp) : std::nullopt; }

SessionContent OpenScene::edited(const Edits& edits) const {
  const Document now = document();
  const Json before = treeOf(writeDocument(now));
  Json after = before;
  for (const auto& [pointer, value] : edits) edit(after, pointer, value);
  Document changed;
  try {
    changed = parseDocument(compactText(after), "", now.folder);
  } catch (const FormatError& error) {
    throw InputError(error.where(), error.message());
  }
  takeOver(changed.scene, now.scene, after, before);
  SessionContent content{changed.scene, changed.duration, now.controls, {}};
  for (const NailId id : session_->nails()) content.nails.emplace_back(id, session_->constraintOf(id));
  return content;
}

std::shared_ptr<const Motion> OpenScene::simulated(const SessionContent& content) {
  const auto scene = std::make_shared<const Scene>(content.scene);
  auto motion = std::make_shared<Motion>(simulate(*scene, *contacts_, content.duration));
  motion->scene = scene;
  return motion;
}

std::string nameOfEdits(const Edits& edits, const Scene& scene) {
  if (edits.size() != 1) return "numbers typed";
  const std::vector<std::string> tokens = tokensOf(edits[0].first);
  if (tokens.size() < 3) return tokens[0];
  std::string owner = tokens[1];
  if (tokens[0] == "bodies" && tokens[1].size() < 9 && tokens[1].find_first_not_of("0123456789") == std::string::npos &&
      !tokens[1].empty() && std::stoul(tokens[1]) < scene.bodies.size())
    owner = scene.bodies[std::stoul(tokens[1])].name;
  std::string member = tokens[2];
  std::replace(member.begin(), member.end(), '_', ' ');
  return member + " of '" + owner + "'";
}

std::optional<std::string> pointerOf(const Control& control, const std::string& component, const Scene& scene) {
  constexpr std::array kAxes = {"x", "y", "z"};
  const auto axis = std::find(kAxes.begin(), kAxes.end(), component);
  const std::string index = axis == kAxes.end() ? "" : "/" + std::to_string(axis - kAxes.begin());
  if (control.vary == "gravity") return axis == kAxes.end() ? std::nullopt : std::optional("/gravity" + index);
  if (!control.material.empty()) return pointerTo("/materials", control.material) + "/" + control.vary;
  const auto& bodies = scene.bodies;
  const auto body = std::find_if(bodies.begin(), bodies.end(), [&](const Body& b) { return b.name == control.body; });
  if (body == bodies.end()) return std::nullopt;
  const std::string place = pointerTo("/bodies", static_cast<std::size_t>(body - bodies.begin())) + "/" + control.vary;
  if (control.vary == "mass") return body->mass ? std::optional(place) : std::nullopt;
  const bool vector = control.vary == "position" || control.vary == "velocity" || control.vary == "angular_velocity" ||
                      control.vary == "surface_velocity" || control.vary == "surface_angular_velocity";
  return vector && axis != kAxes.end() ? std::optional(place + index) : std::nullopt;
}

}  // namespace carom::studio
