// SPDX-License-Identifier: MIT
#include "formats/answers/result_json.h"

#include "formats/json/json_writer.hpp"

namespace carom {

using namespace formats_detail;

namespace {

using Layout = JsonWriter::Layout;

void writeContact(JsonWriter& out, const Contact& contact, const Scene& scene) {
  const auto nameAt = [&](int body) { return scene.bodies.at(static_cast<std::size_t>(body)).name; };
  out.key("bodies").texts({nameAt(contact.a), nameAt(contact.b)});
  out.key("point").vector(contact.at.point);
  out.key("normal").vector(contact.at.normal);
  out.key("elasticity").number(contact.pair.elasticity);
}

void writeEvent(JsonWriter& out, const Event& event, const Scene& scene) {
  out.beginObject();
  out.key("time").number(event.time);
  if (!event.contacts.empty()) writeContact(out, event.contacts.front(), scene);
  out.key("mode").text(nameOf(event.mode));
  out.key("margin").number(event.margins.smallest());
  out.key("margins").beginObject(Layout::line);
  out.key("grazing").number(event.margins.grazing);
  out.key("stick_slip").number(event.margins.stick_slip);
  out.endObject();
  if (event.mode == ImpactMode::joint) {
    out.key("contacts").beginArray();
    for (const Contact& contact : event.contacts) {
      out.beginObject(Layout::line);
      writeContact(out, contact, scene);
      out.endObject();
    }
    out.endArray();
  }
  out.endObject();
}

void writeOverlap(JsonWriter& out, const StartOverlap& overlap, const Scene& scene) {
  const auto nameAt = [&](int body) { return scene.bodies.at(static_cast<std::size_t>(body)).name; };
  out.beginObject(Layout::line);
  out.key("bodies").texts({nameAt(overlap.a), nameAt(overlap.b)});
  out.key("depth").number(overlap.depth);
  out.key("parted");
  overlap.parted ? out.number(*overlap.parted) : out.null();
  out.endObject();
}

void writeStates(JsonWriter& out, const Motion& motion, double time) {
  out.beginObject();
  out.key("time").number(time);
  out.key("bodies").beginObject();
  const std::vector<Body>& bodies = motion.scene->bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyState state = motion.stateAt(static_cast<int>(i), time);
    out.key(bodies[i].name).beginObject();
    out.key("position").vector(state.position);
    out.key("orientation").quaternion(state.orientation);
    out.key("velocity").vector(state.velocity);
    out.key("angular_velocity").vector(state.angular_velocity);
    out.endObject();
  }
  out.endObject().endObject();
}

}  // namespace

std::string motionJson(const Motion& motion, const std::vector<double>& at) {
  JsonWriter out;
  out.beginObject();
  out.key("status").text(nameOf(motion.status));
  out.key("message").text(motion.message);
  out.key("end").number(motion.end);
  out.key("overlaps").beginArray();
  for (const StartOverlap& overlap : motion.overlaps) writeOverlap(out, overlap, *motion.scene);
  out.endArray();
  out.key("events").beginArray();
  for (const Event& event : motion.events) writeEvent(out, event, *motion.scene);
  out.endArray();
  out.key("states").beginArray();
  if (at.empty()) writeStates(out, motion, motion.end);
  for (const double time : at) writeStates(out, motion, time);
  out.endArray();
  out.endObject();
  return out.take();
}

}  // namespace carom
