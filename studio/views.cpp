// SPDX-License-Identifier: MIT
#include "studio/views.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "adjoint/base/errors.h"
#include "adjoint/motion/lasting_contact.h"
#include "adjoint/scene/scene.h"
#include "formats/drawing/motion_extent.hpp"
#include "formats/drawing/palette.hpp"
#include "formats/shapes/rows.hpp"

namespace carom::studio {
namespace {

using namespace formats_detail;

constexpr double kAnyHalfWidth = 1;  // planes are drawn by the page
constexpr std::size_t kMostContacts = 2000;

ImpactView impactOf(const Event& event) {
  ImpactView impact;
  impact.time = event.time, impact.mode = event.mode;
  double contacts = 0;
  for (const Contact& contact : event.contacts) {
    if (!contact.counted || contact.held) continue;
    impact.point += contact.at.point, ++contacts;
    impact.pairs.push_back({std::min(contact.a, contact.b), std::max(contact.a, contact.b)});
  }
  if (contacts > 0) impact.point /= contacts;
  const auto unique = [](auto& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  unique(impact.pairs);
  for (const auto& [a, b] : impact.pairs) impact.bodies.insert(impact.bodies.end(), {a, b});
  unique(impact.bodies);
  for (const int body : impact.bodies) {
    const Participant* participant = event.find(body);
    impact.nth.push_back(participant ? participant->impact : 0);
  }
  return impact;
}

// Those of one body with several others at once are one.
std::vector<ContactView> contactsOf(const Motion& motion) {
  std::vector<ContactView> views;
  for (const LastingContact& c : lastingContacts(motion)) {
    const auto same = std::find_if(views.rbegin(), views.rend(), [&](const ContactView& v) {
      return v.body == c.body && v.kind == c.kind && v.from == c.from && v.to == c.to;
    });
    if (same != views.rend()) {
      same->on.insert(std::lower_bound(same->on.begin(), same->on.end(), c.with), c.with);
    } else if (views.size() < kMostContacts) {
      views.push_back({c.body, {c.with}, c.kind, c.from, c.to});
    }
  }
  return views;
}

}  // namespace

MotionView viewOf(const Motion& motion) {
  MotionView view{motion.scene->gravity, motion.end, motion.status, motion.message, {}, {}, {}, 0};
  if (motion.has_events) view.contacts = contactsOf(motion);
  for (const Event& event : motion.events)
    if (event.counts()) view.impacts.push_back(impactOf(event));
  for (int body = 0; body < static_cast<int>(motion.scene->bodies.size()); ++body)
    view.tracks.push_back(displayTrack(motion, body));
  return view;
}

bool BodyView::looksLike(const BodyView& other) const {
  const bool as_placed = position == other.position && orientation.coeffs() == other.orientation.coeffs();
  return name == other.name && fixed == other.fixed && colour == other.colour && radius == other.radius &&
         center == other.center && plane == other.plane && mesh == other.mesh && (!fixed || as_placed);
}

SceneView sceneViewOf(const Motion& motion) {
  const Scene& scene = *motion.scene;
  const Extent extent = motionExtent(motion);
  SceneView view{{}, extent.min(), extent.max(), 0};
  for (int body = 0; body < static_cast<int>(scene.bodies.size()); ++body) {
    const Body& written = scene.bodies[static_cast<std::size_t>(body)];
    BodyView drawn;
    drawn.name = written.name, drawn.fixed = written.fixed;
    drawn.colour = bodyColour(scene, body).hex();
    drawn.center = (*motion.models)[static_cast<std::size_t>(body)].center;
    drawn.position = written.position, drawn.orientation = written.orientation;
    const double radius = radiusAbout(written.shape, drawn.center);
    if (std::isfinite(radius)) drawn.radius = radius;
    if (const Plane* plane = std::get_if<Plane>(&written.shape))
      drawn.plane = PlaneView{plane->normal, plane->offset};
    else
      drawn.mesh = displayMesh(scene, body, kAnyHalfWidth);
    view.bodies.push_back(std::move(drawn));
  }
  return view;
}

}  // namespace carom::studio
