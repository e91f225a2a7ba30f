// SPDX-License-Identifier: MIT
// carom replay: plays the journal of an edit session again.
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>
#include <memory>

#include "cli/command.h"
#include "cli/loading.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/streams.h"
#include "cli/table.h"
#include "cli/units.h"
#include "editing/session_replay.h"
#include "editing/session_numbers.h"
#include "formats/base/in_file.hpp"
#include "formats/documents/journal_json.h"

namespace carom::cli {

using namespace formats_detail;

namespace {

struct ReplayArguments {
  std::string journal, output;
};

/// An orientation is a quaternion here.
std::string unitOfNumber(const std::string& name) { return name.starts_with("orientation") ? "" : unitOf(name); }

std::string describe(const SessionGesture& gesture) {
  std::string text = nameOf(gesture.kind);
  if (gesture.constraint) text += " '" + gesture.constraint->body + "'";
  if (gesture.grabbed_nail) text += ", nail " + std::to_string(*gesture.grabbed_nail);
  if (gesture.kind == SessionGesture::Kind::nail_on) text += gesture.on ? ", switched on" : ", switched off";
  if (gesture.kind == SessionGesture::Kind::keep_sequence) text += gesture.on ? ", on" : ", off";
  if (!gesture.name.empty()) text += ": " + gesture.name;
  if (gesture.kind == SessionGesture::Kind::drag && gesture.ending != SessionGesture::Ending::release)
    text += gesture.ending == SessionGesture::Ending::cancel ? ", cancelled" : ", then nailed";
  return text;
}

void print(Output& out, const SessionJournal& journal, const std::vector<ReplayedGesture>& played) {
  Table table({">gesture", "", ">updates", ">slowest [ms]", "reached", ">distance [m]", ">nails, error [SI]",
               "as recorded"});
  for (std::size_t i = 0; i < played.size(); ++i) {
    const ReplayedGesture& gesture = played[i];
    table.row({std::to_string(i), describe(journal.gestures[i]), std::to_string(gesture.updates),
               Output::brief(gesture.slowest_milliseconds), gesture.update.reached ? "yes" : "no",
               out.number(gesture.update.distance), out.number(gesture.update.nail_error),
               gesture.differences.empty() ? "yes" : "no"});
  }
  if (!table.empty()) table.print(out);
  for (std::size_t i = 0; i < played.size(); ++i)
    if (!played[i].update.message.empty()) out.text() << "gesture " << i << ": " << played[i].update.message << '\n';
}

Exit replay(const ReplayArguments& options, Output& out) {
  if (isStandard(options.output)) out.reserveForContent();
  if (!options.output.empty()) requireOutput(options.output);
  const JournalDocument document = readJournalFrom(options.journal);
  const std::string name = nameOfInput(options.journal);
  OdeContacts contacts = inFile(name, [&] { return OdeContacts(document.journal.scene); });
  std::vector<ReplayedGesture> played;
  bool same = true;
  inFile(name, [&] {
    SessionReplay replay(document.journal, contacts);
    Progress progress(out, "replaying");
    while (!replay.done()) {
      progress.show("gesture " + std::to_string(played.size()) + " of " +
                    std::to_string(document.journal.gestures.size()));
      played.push_back(replay.next());
      same = same && played.back().differences.empty();
    }
    if (!options.output.empty()) {
      Document end = documentOf(replay.session(), document.folder);
      end.name = document.name, end.notes = document.notes;
      saveSceneTo(out, options.output, end);
    }
    if (out.json()) {
      out.document(replayJson(name, document.journal, played, replay.session(), options.output));
      return;
    }
    print(out, document.journal, played);
    Table numbers({"number", ">value", "unit"});
    for (const SessionNumber& number : sessionNumbers(replay.session().scene(), replay.session().controls()))
      numbers.row({number.name, out.number(number.value), unitOfNumber(number.name)});
    if (!numbers.empty()) {
      out.text() << '\n';
      numbers.print(out);
    }
    if (!options.output.empty()) sayWritten(out, options.output);
  });
  if (same) return Exit::done;
  for (std::size_t i = 0; i < played.size(); ++i)
    for (const std::string& difference : played[i].differences)
      out.fail(name + ": /gestures/" + std::to_string(i) + ": " + difference);
  return Exit::check_failed;
}

Action declareReplay(CLI::App& app) {
  const auto options = std::make_shared<ReplayArguments>();
  app.add_option("journal", options->journal, "The journal of an edit session; - for standard input")
      ->required()
      ->type_name("J.json");
  addOutput(app, options->output, "Write the scene at its end here; - for standard output", "OUT.json");
  return [options](Output& out) { return replay(*options, out); };
}

}  // namespace

const Command kReplayCommand{
    "replay", "Replay the journal of an edit session",
    "Replays every gesture with the work limits of the journal and without time limits, and prints its\n"
    "distance from the target. The outcome of a gesture is compared with the recorded one, bit by bit; a\n"
    "difference is reported, and the exit code is 4.\n"
    "\n"
    "Examples:\n"
    "  carom replay session.json\n"
    "  carom replay session.json -o edited.json && carom export edited.json -o edited.glb\n"
    "  carom replay session.json --json | jq '.gestures[] | select(.reached | not)'",
    declareReplay};

}  // namespace carom::cli
