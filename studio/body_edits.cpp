// SPDX-License-Identifier: MIT
#include "studio/body_edits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "adjoint/scene/scene.h"
#include "formats/base/format_error.h"
#include "formats/base/short_text.hpp"
#include "formats/documents/scene_json.h"
#include "formats/json/json.hpp"
#include "formats/shapes/rows.hpp"
#include "ode_bridge/ode_contacts.h"

namespace carom::studio {

using namespace formats_detail;

namespace {

/// A name that no body has: the word itself, or with the first free number from 2 on.
std::string freeName(const Scene& scene, const std::string& word) {
  const auto taken = [&](const std::string& name) {
    return std::ranges::any_of(scene.bodies, [&](const Body& body) { return body.name == name; });
  };
  if (!taken(word)) return word;
  for (int n = 2;; ++n)
    if (const std::string name = word + " " + std::to_string(n); !taken(name)) return name;
}

/// "ball" of "ball 3".
std::string withoutNumber(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789");
  const bool numbered = end != std::string::npos && end + 1 < name.size() && name[end] == ' ' && end > 0;
  return numbered ? name.substr(0, end) : name;
}

std::size_t indexOf(const Scene& scene, const std::string& body) {
  const auto found = std::ranges::find(scene.bodies, body, &Body::name);
  if (found == scene.bodies.end()) throw InputError("/body", "found no body '" + body + "', expected one of the scene");
  return static_cast<std::size_t>(found - scene.bodies.begin());
}

/// A document of the same folder; errors name places in it.
Document parsed(const Json& text, const std::string& folder) {
  try {
    return parseDocument(compactText(text), "", folder);
  } catch (const FormatError& error) {
    throw InputError(error.where(), error.message());
  }
}

/// The names of bodies in a constraint, but for those in sequences, which stand in patterns.
std::vector<std::string*> namesIn(Constraint& constraint) {
  std::vector<std::string*> names = {&constraint.body, &constraint.at.with, &constraint.relative_to};
  for (Target& target : constraint.targets) names.push_back(&target.to);
  if (constraint.hits) {
    names.push_back(&constraint.hits->with);
    for (std::optional<ImpactOf>* other : {&constraint.hits->after, &constraint.hits->before})
      if (*other) names.insert(names.end(), {&(*other)->body, &(*other)->with});
  }
  return names;
}

/// Sequences name bodies in patterns: what holds the name may mean it.
bool isInSequence(const Constraint& constraint, const std::string& body) {
  return std::ranges::any_of(constraint.sequence, [&](const std::string& entry) { return entry.find(body) != std::string::npos; });
}

bool namesBody(Constraint constraint, const std::string& body) {
  return isInSequence(constraint, body) || std::ranges::any_of(namesIn(constraint), [&](const std::string* name) { return *name == body; });
}

/// How far a shape reaches from its origin against a direction, m; none for a plane.
std::optional<double> reachAgainst(const Body& body, const Vec3& normal) {
  const Quat upright = Quat::FromTwoVectors(normal, Vec3::UnitZ());
  const Extent extent = shapeExtent(body.shape, Vec3::Zero(), upright * body.orientation);
  return extent.isEmpty() ? std::nullopt : std::optional(-extent.min().z());
}

/// A body alone with those that it can overlap at a place, in front of them: in a scene of hundreds these are few.
Scene neighboursAt(const Scene& scene, std::size_t body, const Vec3& place) {
  Scene near;
  near.materials = scene.materials;
  near.bodies.push_back(scene.bodies[body]);
  near.bodies[0].position = place;
  const double own = radiusAbout(scene.bodies[body].shape, Vec3::Zero());
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& other = scene.bodies[i];
    const bool reaches = !((other.position - place).norm() > own + radiusAbout(other.shape, Vec3::Zero()));  // planes do everywhere
    if (i != body && reaches) near.bodies.push_back(other);
  }
  return near;
}

bool isFree(const Scene& scene, std::size_t body, const Vec3& place) {
  const OdeContacts contacts(neighboursAt(scene, body, place));
  return std::ranges::none_of(contacts.overlaps(), [](const StartOverlap& one) { return one.a == 0 || one.b == 0; });
}

/// The nearest place along the axes where a body overlaps nothing, to a thousandth of its size; none within many sizes.
std::optional<Vec3> freePlace(const Scene& scene, std::size_t body) {
  constexpr int kDoublings = 10, kHalvings = 12;
  const Body& placed = scene.bodies[body];
  const double size = radiusAbout(placed.shape, Vec3::Zero());
  if (!std::isfinite(size)) return std::nullopt;
  std::optional<Vec3> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)}) {
    double low = 0, high = size / 32;
    int n = 0;
    while (n < kDoublings && high < least && !isFree(scene, body, placed.position + high * axis)) low = high, high *= 2, ++n;
    if (n == kDoublings || high >= least) continue;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = (low + high) / 2;
      (isFree(scene, body, placed.position + middle * axis) ? high : low) = middle;
    }
    if (high < least) least = high, best = placed.position + high * axis;
  }
  return best;
}

}  // namespace

SessionContent withBody(const EditedDocument& now, const std::string& body, const std::optional<OnSurface>& on) {
  Json json = treeOf(writeDocument(now.document)), added = treeOf(body);
  added["name"] = freeName(now.content.scene, added["name"].get<std::string>());
  json["bodies"].push_back(added);
  SessionContent content = now.content;
  Body placed = parsed(json, now.document.folder).scene.bodies.back();
  if (on) {
    const std::optional<double> reach = reachAgainst(placed, on->normal);
    if (!reach) throw InputError("/body/shape", "found a plane, expected a shape that can stand on something");
    placed.position = on->point + *reach * on->normal;
  }
  content.scene.bodies.push_back(std::move(placed));
  return content;
}

SessionContent withoutBody(const EditedDocument& now, const std::string& body) {
  const std::size_t index = indexOf(now.content.scene, body);
  SessionContent content = now.content;
  content.scene.bodies.erase(content.scene.bodies.begin() + static_cast<std::ptrdiff_t>(index));
  std::erase_if(content.scene.tilts, [&](const Tilt& tilt) { return tilt.body == body; });
  std::erase_if(content.controls, [&](const Control& control) { return control.body == body; });
  std::erase_if(content.nails, [&](const auto& nail) { return namesBody(nail.second, body); });
  return content;
}

SessionContent withCopy(const EditedDocument& now, const std::string& body) {
  const std::size_t index = indexOf(now.content.scene, body);
  SessionContent content = now.content;
  Body copy = content.scene.bodies[index];
  const double size = radiusAbout(copy.shape, Vec3::Zero());
  if (!std::isfinite(size)) throw InputError("/body", "found a plane, expected a body that ends somewhere");
  copy.name = freeName(content.scene, withoutNumber(copy.name));
  content.scene.bodies.push_back(copy);
  const std::size_t last = content.scene.bodies.size() - 1;
  constexpr int kTries = 40;
  const Vec3 from = copy.position;
  for (int n = 1; n <= kTries; ++n)
    for (const Vec3& axis : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0), Vec3(-1, 0, 0)}) {
      const Vec3 place = from + 2.1 * size * n * axis;
      if (!isFree(content.scene, last, place)) continue;
      content.scene.bodies[last].position = place;
      return content;
    }
  throw InputError("/body", "found no free place beside '" + body + "', expected one");
}

SessionContent renamed(const EditedDocument& now, const std::string& body, const std::string& name) {
  const std::size_t index = indexOf(now.content.scene, body);
  SessionContent content = now.content;
  const auto rename = [&](std::string& one) {
    if (one == body) one = name;
  };
  content.scene.bodies[index].name = name;
  for (Tilt& tilt : content.scene.tilts) rename(tilt.body);
  for (Control& control : content.controls) rename(control.body);
  for (auto& [id, constraint] : content.nails) {
    if (isInSequence(constraint, body))
      throw InputError("/name", "found a sequence that may name '" + body + "', expected none: patterns are not written anew");
    for (std::string* one : namesIn(constraint)) rename(*one);
  }
  return content;
}

void requireRoom(const Scene& scene, const Scene& before) {
  const auto changed = [&](int index) {
    const Body& body = scene.bodies[static_cast<std::size_t>(index)];
    const auto old = std::ranges::find(before.bodies, body.name, &Body::name);
    return old == before.bodies.end() || old->position != body.position || old->orientation.coeffs() != body.orientation.coeffs() ||
           old->fixed != body.fixed || radiusAbout(old->shape, Vec3::Zero()) != radiusAbout(body.shape, Vec3::Zero()) ||
           shapeExtent(old->shape, Vec3::Zero(), Quat::Identity()).sizes() != shapeExtent(body.shape, Vec3::Zero(), Quat::Identity()).sizes();
  };
  std::vector<int> others;
  for (int i = 0; i < static_cast<int>(scene.bodies.size()); ++i)
    if (changed(i)) others.push_back(i);
  if (others.empty()) return;
  const auto nameOf = [](const Scene& in, int body) { return in.bodies[static_cast<std::size_t>(body)].name; };
  std::set<std::set<std::string>> known;  // pairs that overlap already
  for (const StartOverlap& overlap : OdeContacts(before).overlaps()) known.insert({nameOf(before, overlap.a), nameOf(before, overlap.b)});
  for (const StartOverlap& overlap : OdeContacts(scene).overlaps()) {
    const int own = changed(overlap.b) ? overlap.b : changed(overlap.a) ? overlap.a : -1;
    if (own < 0 || known.contains({nameOf(scene, overlap.a), nameOf(scene, overlap.b)})) continue;
    const auto name = [&](int body) { return "'" + nameOf(scene, body) + "'"; };
    const std::optional<Vec3> place = freePlace(scene, static_cast<std::size_t>(own));
    throw Overlap(name(own) + " would overlap " + name(own == overlap.b ? overlap.a : overlap.b) + " by " +
                      shortNumber(1000 * overlap.depth) + " mm at the start.",
                  nameOf(scene, own), place);
  }
}

}  // namespace carom::studio
