// SPDX-License-Identifier: MIT
#include "studio/frames.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <vector>

#include "adjoint/base/errors.h"
#include "formats/json/json.hpp"

namespace carom::studio {
namespace {

using namespace formats_detail;

static_assert(std::endian::native == std::endian::little, "frames are written as numbers lie in memory");

constexpr std::size_t kAlignment = 8;

std::size_t padded(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

Json listOf(const Vec3& v) { return Json::array({v.x(), v.y(), v.z()}); }
Json listOf(const Quat& q) { return Json::array({q.w(), q.x(), q.y(), q.z()}); }

// The blocks behind a header. Equal ones are one.
class Blocks {
 public:
  template <class Number>
  Json add(std::span<const Number> numbers, std::size_t row) {
    std::string bytes(numbers.size_bytes(), '\0');
    if (!numbers.empty()) std::memcpy(bytes.data(), numbers.data(), numbers.size_bytes());
    const auto [known, added] = places_.try_emplace(std::move(bytes), bytes_.size());
    if (added) {
      bytes_ += known->first;
      bytes_.resize(padded(bytes_.size()), '\0');
    }
    return Json::array({known->second, numbers.size() / row});
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
  std::map<std::string, std::size_t> places_;
};

Json headerOf(const char* type, std::string_view members) {
  Json given = treeOf(members, NoJson::discards);
  if (!given.is_object()) throw InputError("found no JSON object as members of a frame, expected one");
  Json header = {{"type", type}};
  for (auto& [name, value] : given.items()) {
    if (name == "type") throw InputError("found a member \"type\" among those of a frame, which has its own");
    header[name] = std::move(value);
  }
  return header;
}

void add(Json& header, const char* name, Json value) {
  if (header.contains(name))
    throw InputError("found a member \"" + std::string(name) + "\" among those of a frame, which has its own");
  header[name] = std::move(value);
}

// Names of files may hold bytes that are no text.
std::string frameOf(const Json& header, const Blocks& blocks) {
  std::string text = compactText(header, Json::error_handler_t::replace);
  text.resize(padded(text.size()), ' ');
  const auto length = static_cast<std::uint32_t>(text.size());
  std::string frame = "CRM1";
  frame.reserve(frame.size() + sizeof length + text.size() + blocks.bytes().size());
  frame.append(reinterpret_cast<const char*>(&length), sizeof length);
  return frame.append(text).append(blocks.bytes());
}

Json impactsOf(const MotionView& view) {
  Json impacts = Json::array();
  for (const ImpactView& impact : view.impacts)
    impacts.push_back({{"t", impact.time},
                       {"point", listOf(impact.point)},
                       {"bodies", impact.bodies},
                       {"nth", impact.nth},
                       {"pairs", impact.pairs},
                       {"mode", nameOf(impact.mode)}});
  return impacts;
}

Json contactsOf(const MotionView& view) {
  Json contacts = Json::array();
  for (const ContactView& contact : view.contacts)
    contacts.push_back(
        {{"body", contact.body}, {"on", contact.on}, {"kind", nameOf(contact.kind)}, {"from", contact.from}, {"to", contact.to}});
  return contacts;
}

Json trackOf(const DisplayTrack& track, std::size_t body, Blocks& blocks) {
  constexpr std::size_t kParabola = 10, kBend = 19, kTurn = 5;
  const bool straight = std::ranges::all_of(track.arcs, &DisplayTrack::ArcKey::isParabola);
  const std::size_t stride = straight ? kParabola : kBend;
  std::vector<double> arcs;
  arcs.reserve(stride * track.arcs.size());
  for (const DisplayTrack::ArcKey& key : track.arcs) {
    arcs.push_back(key.time);
    for (const Vec3* v : {&key.position, &key.velocity, &key.acceleration, &key.third, &key.fourth, &key.fifth})
      if (arcs.size() % stride != 0) arcs.insert(arcs.end(), v->begin(), v->end());
  }
  std::vector<float> turns;
  turns.reserve(kTurn * track.turns.size());
  for (const DisplayTrack::TurnKey& key : track.turns)
    turns.insert(turns.end(), {key.time, key.w, key.x, key.y, key.z});
  Json json = {{"body", body}, {"arcs", blocks.add<double>(arcs, stride)}};
  if (!straight) json["stride"] = stride;
  json["turns"] = blocks.add<float>(turns, kTurn);
  json["center"] = listOf(track.center);
  return json;
}

Json bodyOf(const BodyView& body, std::size_t index, Blocks& blocks) {
  Json json = {{"body", index},
               {"name", body.name},
               {"fixed", body.fixed},
               {"colour", body.colour},
               {"center", listOf(body.center)},
               {"pose", {{"position", listOf(body.position)}, {"orientation", listOf(body.orientation)}}}};
  if (body.radius) json["radius"] = *body.radius;
  if (body.plane) {
    json["plane"] = {{"normal", listOf(body.plane->normal)}, {"offset", body.plane->offset}};
    return json;
  }
  json["vertices"] = blocks.add<float>(body.mesh.positions, 3);
  json["normals"] = blocks.add<float>(body.mesh.normals, 3);
  json["triangles"] = blocks.add<std::uint32_t>(body.mesh.triangles, 3);
  if (!body.mesh.accent.empty()) json["accent"] = blocks.add<std::uint32_t>(body.mesh.accent, 3);
  return json;
}

std::string frameOfMotion(const char* type, const MotionView& view, std::string_view members, const MotionView* sent) {
  Json header = headerOf(type, members);
  if (sent && sent->scene != view.scene) sent = nullptr;
  Blocks blocks;
  Json tracks = Json::array();
  for (std::size_t body = 0; body < view.tracks.size(); ++body) {
    const bool known = sent && body < sent->tracks.size() && sent->tracks[body] == view.tracks[body];
    if (!known) tracks.push_back(trackOf(view.tracks[body], body, blocks));
  }
  add(header, "scene", view.scene);
  add(header, "end", view.end);
  add(header, "status", nameOf(view.status));
  add(header, "message", view.message);
  add(header, "gravity", listOf(view.gravity));
  add(header, "impacts", impactsOf(view));
  add(header, "contacts", contactsOf(view));
  add(header, "count", view.tracks.size());
  add(header, "tracks", std::move(tracks));
  return frameOf(header, blocks);
}

}  // namespace

std::string motionFrame(const MotionView& view, std::string_view members, const MotionView* sent) {
  return frameOfMotion("motion", view, members, sent);
}

std::string alternativeFrame(const MotionView& view, std::string_view members) {
  return frameOfMotion("alternative", view, members, nullptr);
}

std::string sceneFrame(const SceneView& view, std::string_view members, const SceneView* sent) {
  Json header = headerOf("scene", members);
  if (sent && sent->scene != view.scene) sent = nullptr;
  Blocks blocks;
  Json bodies = Json::array();
  for (std::size_t body = 0; body < view.bodies.size(); ++body) {
    const bool known = sent && body < sent->bodies.size() && sent->bodies[body].looksLike(view.bodies[body]);
    if (!known) bodies.push_back(bodyOf(view.bodies[body], body, blocks));
  }
  add(header, "scene", view.scene);
  add(header, "count", view.bodies.size());
  add(header, "extent", {{"min", listOf(view.low)}, {"max", listOf(view.high)}});
  add(header, "bodies", std::move(bodies));
  return frameOf(header, blocks);
}

std::string fileFrame(const std::string& name, std::string_view bytes, std::string_view members) {
  Json header = headerOf("exported", members);
  add(header, "name", name);
  add(header, "size", bytes.size());
  return frameOf(header, Blocks()).append(bytes);
}

}  // namespace carom::studio
