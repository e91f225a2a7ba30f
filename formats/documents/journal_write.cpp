// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "editing/session_numbers.h"
#include "formats/documents/journal_json.h"
#include "formats/documents/journal_write.hpp"
#include "formats/documents/scene_writer.hpp"
#include "formats/json/json_writer.hpp"

namespace carom {

using namespace formats_detail;

namespace {

using Layout = JsonWriter::Layout;
using Kind = SessionGesture::Kind;

void writeOptions(JsonWriter& out, const SessionOptions& options) {
  const auto stop = [](double seconds) { return std::isfinite(seconds) ? std::optional(seconds) : std::nullopt; };
  out.key("options").beginObject();
  out.members("measure_from", options.measure_from == MeasureFrom::grab ? "grab" : "start");
  out.members("sequence", options.sequence == SequencePolicy::stay ? "stay" : "prefer_start");
  out.members("tolerance", options.tolerance, "drag_simulations", options.drag_simulations);
  out.members("dwell_simulations", options.dwell_simulations, "release_iterations", options.release_iterations);
  out.members("drag_seconds", stop(options.drag_seconds), "release_seconds", stop(options.release_seconds));
  if (std::isfinite(options.drag_steps)) out.members("drag_steps", options.drag_steps);
  if (std::isfinite(options.release_steps)) out.members("release_steps", options.release_steps);
  if (options.unmet_nails_off) out.members("unmet_nails_off", true);
  out.endObject();
}

/// One constraint has to stay one: what would become several objects is refused.
void requireOneOfAKind(const Constraint& constraint, const std::string& where) {
  for (std::size_t i = 0; i < constraint.targets.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (constraint.targets[i].quantity == constraint.targets[k].quantity)
        throw InputError(where, "found two targets \"" + constraint.targets[i].quantity +
                                    "\", expected one of a kind: a second nail can hold the other");
}

void writeOne(JsonWriter& out, const char* member, const Constraint& constraint, const std::string& where) {
  requireWritable(constraint, where + "/" + member);
  requireOneOfAKind(constraint, where + "/" + member);
  writeConstraint(out.key(member), constraint);
}

void writeControls(JsonWriter& out, const char* member, const std::vector<Control>& controls) {
  out.key(member).beginArray();
  for (const Control& control : controls) writeControl(out, control);
  out.endArray();
}

void writeDrag(JsonWriter& out, const SessionGesture& gesture, const std::string& where) {
  writeOne(out, "drag", *gesture.constraint, where);
  if (gesture.grabbed_nail) out.members("grab_nail", *gesture.grabbed_nail);
  if (!gesture.controls.empty()) writeControls(out, "also_vary", gesture.controls);
  out.objects("targets", gesture.targets, Layout::line, [&](const DragTarget& target) {
    out.members("milliseconds", target.milliseconds, "place", target.place);
    if (target.orientation) out.members("orientation", *target.orientation);
    if (!target.components.empty()) {
      out.key("components").beginArray(Layout::line);
      for (const std::string& component : target.components) out.value(component);
      out.endArray();
    }
    if (target.dwell) out.members("dwell", true);
    if (target.cut_after) out.members("cut_after", *target.cut_after);
  });
  out.members("ending", nameOf(gesture.ending));
}

/// The content as a scene document, whose constraints are the nails, and their numbers.
void writeContent(JsonWriter& out, const SessionGesture& gesture, const std::string& folder, const std::string& where) {
  const SessionContent& content = *gesture.content;
  Document document{content.scene, content.duration, content.controls, {}, folder};
  for (const auto& [id, constraint] : content.nails) {
    requireOneOfAKind(constraint, where + "/content/constraints/" + std::to_string(document.constraints.size()));
    document.constraints.push_back(constraint);
  }
  writeDocument(out.key("content"), document);
  std::vector<std::optional<int>> ids;
  for (const auto& [id, constraint] : content.nails)
    ids.push_back(id == NailId() ? std::nullopt : std::optional(id.value));
  out.members("ids", ids).unlessEmpty("name", gesture.name);
}

/// What is done, by its kind.
void writeDeed(JsonWriter& out, const SessionGesture& gesture, const std::string& folder, const std::string& where) {
  switch (gesture.kind) {
    case Kind::controls:
      return writeControls(out, "controls", gesture.controls);
    case Kind::nail:
      return writeOne(out, "nail", *gesture.constraint, where);
    case Kind::set_nail:
      return writeOne(out, "set_nail", *gesture.constraint, where);
    case Kind::nail_on:
    case Kind::keep_sequence:
      out.members(nameOf(gesture.kind), gesture.on);
      return;
    case Kind::unnail:
      out.members("unnail", gesture.nail);
      return;
    case Kind::drag:
      return writeDrag(out, gesture, where);
    case Kind::content:
      return writeContent(out, gesture, folder, where);
    case Kind::meet_nails:
    case Kind::undo:
    case Kind::redo:
      out.members(nameOf(gesture.kind), true);
  }
}

void writeGesture(JsonWriter& out, const SessionGesture& gesture, const std::string& folder, const std::string& where) {
  out.members("milliseconds", gesture.milliseconds);
  writeDeed(out, gesture, folder, where);
  if (gesture.nail >= 0 && gesture.kind != Kind::unnail) out.members("id", gesture.nail);
  if (gesture.cut_after) out.members("cut_after", *gesture.cut_after);
  out.members("reached", gesture.reached, "distance", gesture.distance, "numbers", gesture.numbers);
}

}  // namespace

std::string formats_detail::gestureText(const SessionGesture& gesture, const std::string& folder) {
  JsonWriter out;
  out.beginObject();
  writeGesture(out, gesture, folder, "");
  out.endObject();
  return out.take();
}

std::string writeJournal(const JournalDocument& document) {
  const SessionJournal& journal = document.journal;
  JsonWriter out;
  out.beginObject();
  out.unlessEmpty("$schema", document.schema).members("carom_journal", 1);
  writeDocument(out.key("scene"), {journal.scene, journal.duration, journal.controls, journal.nails, document.folder,
                                   document.name, document.notes, ""});
  writeOptions(out, journal.options);
  std::size_t i = 0;
  out.objects("gestures", journal.gestures, Layout::block,
              [&](const SessionGesture& gesture) {
                writeGesture(out, gesture, document.folder, "/gestures/" + std::to_string(i++));
              });
  out.endObject();
  return out.take();
}

std::string replayJson(const std::string& file, const SessionJournal& journal,
                       const std::vector<ReplayedGesture>& gestures, const EditSession& session,
                       const std::string& output) {
  const bool same =
      std::all_of(gestures.begin(), gestures.end(), [](auto& played) { return played.differences.empty(); });
  JsonWriter out;
  out.beginObject();
  out.members("file", file, "same", same);
  std::size_t i = 0;
  out.objects("gestures", gestures, Layout::block, [&](const ReplayedGesture& played) {
    const SessionGesture& gesture = journal.gestures[i++];
    const SessionUpdate& update = played.update;
    out.members("gesture", nameOf(gesture.kind), "body", gesture.constraint ? gesture.constraint->body : "");
    out.members("reached", update.reached, "distance", update.distance, "nail_error", update.nail_error);
    out.members("iterations", update.iterations, "milliseconds", update.milliseconds, "updates", played.updates);
    out.members("slowest_milliseconds", played.slowest_milliseconds, "message", update.message);
    out.key("differences").beginArray();
    for (const std::string& difference : played.differences) out.value(difference);
    out.endArray();
  });
  out.objects("numbers", sessionNumbers(session.scene(), session.controls()), Layout::line,
              [&](const SessionNumber& number) { out.members("name", number.name, "value", number.value); });
  out.members("output", textOrNone(output)).endObject();
  return out.take();
}

}  // namespace carom
