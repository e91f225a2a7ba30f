// SPDX-License-Identifier: MIT
#include "formats/answers/result_json.hpp"

#include <algorithm>

#include "adjoint/motion/lasting_contact.h"
#include "formats/json/json_writer.hpp"

namespace carom::formats_detail {

namespace {

using Layout = JsonWriter::Layout;

/// Writes the answer about one motion.
class MotionWriter {
 public:
  explicit MotionWriter(const Motion& motion) : motion_(motion), bodies_(motion.scene->bodies) {}

  std::string write(const std::vector<double>& at) {
    out_.beginObject();
    out_.members("status", nameOf(motion_.status), "message", motion_.message, "end", motion_.end);
    out_.objects("overlaps", motion_.overlaps, Layout::line, [&](const StartOverlap& overlap) {
      out_.members("bodies", names(overlap), "depth", overlap.depth, "parted", overlap.parted);
    });
    out_.objects("events", motion_.events, Layout::block, [&](const Event& event) { writeEvent(event); });
    const auto lasting = motion_.has_events ? lastingContacts(motion_) : std::vector<LastingContact>();
    out_.objects("contacts", lasting, Layout::line, [&](const LastingContact& contact) { writeLasting(contact); });
    out_.objects("states", at.empty() ? std::vector{motion_.end} : at, Layout::block,
                 [&](double time) { writeStates(time); });
    out_.endObject();
    return out_.take();
  }

 private:
  const std::string& name(int body) const { return bodies_.at(static_cast<std::size_t>(body)).name; }
  template <class Pair>
  std::array<std::string, 2> names(const Pair& pair) const {
    return {name(pair.a), name(pair.b)};
  }

  void writeContact(const Contact& contact) {
    out_.members("bodies", names(contact), "point", contact.at.point, "normal", contact.at.normal);
    out_.members("elasticity", contact.pair.elasticity);
  }

  void writeLasting(const LastingContact& contact) {
    const auto [a, b] = std::minmax(contact.body, contact.with);  // in the order of events
    std::vector<std::string> features;
    for (const FeaturePair& pair : contact.features) features.push_back(motion_.geometry->describe(a, b, pair));
    out_.members("bodies", std::array{name(contact.body), name(contact.with)}, "kind", nameOf(contact.kind));
    out_.members("features", features, "from", contact.from, "to", contact.to);
  }

  void writeEvent(const Event& event) {
    out_.members("time", event.time, "kind", nameOf(event.kind), "counts", event.counts());
    if (event.kind == EventKind::transition) out_.members("cause", nameOf(event.cause));
    if (event.settles_at) out_.members("settles_at", *event.settles_at);
    if (!event.contacts.empty()) writeContact(event.contacts.front());
    if (event.kind != EventKind::transition) writeLaw(event);
    if (event.mode == ImpactMode::joint || event.contacts.size() > 1)
      out_.objects("contacts", event.contacts, Layout::line, [&](const Contact& contact) { writeContact(contact); });
  }

  void writeLaw(const Event& event) {
    out_.members("mode", nameOf(event.mode), "margin", event.margins.smallest());
    out_.key("margins").beginObject(Layout::line);
    out_.members("grazing", event.margins.grazing, "stick_slip", event.margins.stick_slip).endObject();
  }

  void writeStates(double time) {
    out_.members("time", time).key("bodies").beginObject();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const BodyState state = motion_.stateAt(static_cast<int>(i), time);
      out_.key(bodies_[i].name).beginObject();
      out_.members("position", state.position, "orientation", state.orientation);
      out_.members("velocity", state.velocity, "angular_velocity", state.angular_velocity).endObject();
    }
    out_.endObject();
  }

  const Motion& motion_;
  const std::vector<Body>& bodies_;
  JsonWriter out_;
};

}  // namespace

std::string motionJson(const Motion& motion, const std::vector<double>& at) { return MotionWriter(motion).write(at); }

}  // namespace carom::formats_detail
