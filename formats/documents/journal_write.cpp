// SPDX-License-Identifier: MIT
#include <cmath>

#include "formats/documents/scene_writer.hpp"
#include "formats/documents/journal_json.h"
#include "editing/session_numbers.h"
#include "formats/json/json_writer.hpp"

namespace carom {

using namespace formats_detail;

namespace {

using Layout = JsonWriter::Layout;
using Kind = SessionGesture::Kind;

void writeStop(JsonWriter& out, const char* member, double seconds) {
  out.key(member);
  std::isfinite(seconds) ? out.number(seconds) : out.null();
}

void writeOptions(JsonWriter& out, const SessionOptions& options) {
  out.key("options").beginObject();
  out.key("measure_from").text(options.measure_from == MeasureFrom::grab ? "grab" : "start");
  out.key("sequence").text(options.sequence == SequencePolicy::stay ? "stay" : "prefer_start");
  out.key("tolerance").number(options.tolerance);
  out.key("drag_simulations").integer(options.drag_simulations);
  out.key("release_iterations").integer(options.release_iterations);
  writeStop(out, "drag_seconds", options.drag_seconds);
  writeStop(out, "release_seconds", options.release_seconds);
  out.endObject();
}

/// One constraint has to stay one: what would become several objects is refused.
void writeOne(JsonWriter& out, const char* member, const Constraint& constraint, const std::string& where) {
  requireWritable(constraint, where + "/" + member);
  for (std::size_t i = 0; i < constraint.targets.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (constraint.targets[i].quantity == constraint.targets[k].quantity)
        throw InputError(where + "/" + member, "found two targets \"" + constraint.targets[i].quantity +
                                                   "\", expected one of a kind: a second nail can hold the other");
  writeConstraint(out.key(member), constraint);
}

void writeTarget(JsonWriter& out, const DragTarget& target) {
  out.beginObject(Layout::line);
  out.key("milliseconds").number(target.milliseconds);
  out.key("place").vector(target.place);
  if (target.orientation) out.key("orientation").quaternion(*target.orientation);
  if (target.cut_after) out.key("cut_after").integer(*target.cut_after);
  out.endObject();
}

void writeGesture(JsonWriter& out, const SessionGesture& gesture, const std::string& where) {
  out.beginObject();
  out.key("milliseconds").number(gesture.milliseconds);
  switch (gesture.kind) {
    case Kind::controls:
      out.key("controls").beginArray();
      for (const Control& control : gesture.controls) writeControl(out, control);
      out.endArray();
      break;
    case Kind::nail:
      writeOne(out, "nail", *gesture.constraint, where);
      break;
    case Kind::unnail:
      out.key("unnail").integer(gesture.nail);
      break;
    case Kind::drag:
      writeOne(out, "drag", *gesture.constraint, where);
      out.key("targets").beginArray();
      for (const DragTarget& target : gesture.targets) writeTarget(out, target);
      out.endArray();
      out.key("ending").text(nameOf(gesture.ending));
      break;
    case Kind::undo:
      out.key("undo").boolean(true);
      break;
    case Kind::redo:
      out.key("redo").boolean(true);
      break;
  }
  const bool makes_nail = gesture.kind == Kind::nail ||
                          (gesture.kind == Kind::drag && gesture.ending == SessionGesture::Ending::release_nailed);
  if (makes_nail) out.key("id").integer(gesture.nail);
  if (gesture.cut_after) out.key("cut_after").integer(*gesture.cut_after);
  out.key("reached").boolean(gesture.reached);
  out.key("distance").number(gesture.distance);
  out.key("numbers").numbers(gesture.numbers);
  out.endObject();
}

}  // namespace

std::string writeJournal(const JournalDocument& document) {
  const SessionJournal& journal = document.journal;
  JsonWriter out;
  out.beginObject();
  if (!document.schema.empty()) out.key("$schema").text(document.schema);
  out.key("carom_journal").integer(1);
  writeDocument(out.key("scene"), {journal.scene, journal.duration, journal.controls, journal.nails,
                                           document.folder, document.name, document.notes, ""});
  writeOptions(out, journal.options);
  out.key("gestures").beginArray();
  for (std::size_t i = 0; i < journal.gestures.size(); ++i)
    writeGesture(out, journal.gestures[i], "/gestures/" + std::to_string(i));
  out.endArray();
  out.endObject();
  return out.take();
}

std::string replayJson(const std::string& file, const SessionJournal& journal,
                       const std::vector<ReplayedGesture>& gestures, const EditSession& session,
                       const std::string& output) {
  JsonWriter out;
  bool same = true;
  for (const ReplayedGesture& gesture : gestures) same = same && gesture.differences.empty();
  out.beginObject();
  out.key("file").text(file);
  out.key("same").boolean(same);
  out.key("gestures").beginArray();
  for (std::size_t i = 0; i < gestures.size(); ++i) {
    const ReplayedGesture& played = gestures[i];
    out.beginObject();
    out.key("gesture").text(nameOf(journal.gestures[i].kind));
    out.key("body").text(journal.gestures[i].constraint ? journal.gestures[i].constraint->body : "");
    out.key("reached").boolean(played.update.reached);
    out.key("distance").number(played.update.distance);
    out.key("nail_error").number(played.update.nail_error);
    out.key("iterations").integer(played.update.iterations);
    out.key("milliseconds").number(played.update.milliseconds);
    out.key("updates").integer(played.updates);
    out.key("slowest_milliseconds").number(played.slowest_milliseconds);
    out.key("message").text(played.update.message);
    out.key("differences").beginArray();
    for (const std::string& difference : played.differences) out.text(difference);
    out.endArray();
    out.endObject();
  }
  out.endArray();
  out.key("numbers").beginArray();
  for (const SessionNumber& number : sessionNumbers(session.scene(), session.controls())) {
    out.beginObject(Layout::line);
    out.key("name").text(number.name);
    out.key("value").number(number.value);
    out.endObject();
  }
  out.endArray();
  out.key("output");
  output.empty() ? out.null() : out.text(output);
  out.endObject();
  return out.take();
}

}  // namespace carom
