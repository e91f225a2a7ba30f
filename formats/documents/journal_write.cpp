// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "editing/session_numbers.h"
#include "formats/documents/journal_json.h"
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
  out.members("release_iterations", options.release_iterations);
  out.members("drag_seconds", stop(options.drag_seconds), "release_seconds", stop(options.release_seconds));
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

/// What is done, by its kind.
void writeDeed(JsonWriter& out, const SessionGesture& gesture, const std::string& where) {
  switch (gesture.kind) {
    case Kind::controls:
      out.key("controls").beginArray();
      for (const Control& control : gesture.controls) writeControl(out, control);
      out.endArray();
      return;
    case Kind::nail:
      return writeOne(out, "nail", *gesture.constraint, where);
    case Kind::unnail:
      out.members("unnail", gesture.nail);
      return;
    case Kind::drag:
      writeOne(out, "drag", *gesture.constraint, where);
      out.objects("targets", gesture.targets, Layout::line, [&](const DragTarget& target) {
        out.members("milliseconds", target.milliseconds, "place", target.place);
        if (target.orientation) out.members("orientation", *target.orientation);
        if (target.cut_after) out.members("cut_after", *target.cut_after);
      });
      out.members("ending", nameOf(gesture.ending));
      return;
    case Kind::undo:
    case Kind::redo:
      out.members(gesture.kind == Kind::undo ? "undo" : "redo", true);
  }
}

void writeGesture(JsonWriter& out, const SessionGesture& gesture, const std::string& where) {
  out.members("milliseconds", gesture.milliseconds);
  writeDeed(out, gesture, where);
  const bool makes_nail = gesture.kind == Kind::nail ||
                          (gesture.kind == Kind::drag && gesture.ending == SessionGesture::Ending::release_nailed);
  if (makes_nail) out.members("id", gesture.nail);
  if (gesture.cut_after) out.members("cut_after", *gesture.cut_after);
  out.members("reached", gesture.reached, "distance", gesture.distance, "numbers", gesture.numbers);
}

}  // namespace

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
              [&](const SessionGesture& gesture) { writeGesture(out, gesture, "/gestures/" + std::to_string(i++)); });
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
