// SPDX-License-Identifier: MIT
#include "formats/documents/step_lines.hpp"

#include <algorithm>
#include <vector>

#include "adjoint/base/errors.h"
#include "formats/base/in_file.hpp"
#include "formats/documents/journal_write.hpp"
#include "formats/documents/scene_json.h"
#include "formats/json/json.hpp"

namespace carom::formats_detail {
namespace {

using Kind = SessionGesture::Kind;

std::string stepLineOf(const Json& tree) { return compactText(tree) + "\n"; }

Json stepNailsOf(const EditSession& session) {
  Json nails = Json::array();
  for (const NailState& nail : session.nailStates()) nails.push_back({{"id", nail.id.value}, {"on", nail.on}});
  return nails;
}

SessionHistoryPoint stepPointOf(const Json& now, const Json& nails, const std::string& folder) {
  const Document document = parseDocument(compactText(now), "", folder);
  SessionHistoryPoint point{document.scene, document.duration, document.controls, {}, ""};
  if (nails.size() != document.constraints.size())
    fail("/nails", std::to_string(nails.size()) + " numbers", std::to_string(document.constraints.size()));
  for (std::size_t i = 0; i < nails.size(); ++i)
    point.nails.push_back({NailId{nails[i]["id"].get<int>()}, document.constraints[i], nails[i]["on"].get<bool>()});
  return point;
}

/// Whole lines, and how many bytes they have.
std::vector<std::string_view> wholeLines(std::string_view text, std::size_t& bytes) {
  std::vector<std::string_view> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', bytes)) {
    lines.push_back(text.substr(bytes, end - bytes));
    bytes = end + 1;
  }
  return lines;
}

/// Follows the steps: what was undone is the future.
void followStep(SessionHistory& history, Kind kind, std::size_t depth, const std::string& step, SessionHistoryPoint now) {
  const auto go = [&](std::vector<SessionHistoryPoint>& from, std::vector<SessionHistoryPoint>& to) {
    history.now.step = from.back().step;
    to.push_back(std::move(history.now));
    history.now = std::move(from.back());
    from.pop_back();
  };
  if (kind == Kind::undo && depth + 1 == history.past.size()) return go(history.past, history.future);
  if (kind == Kind::redo && depth == history.past.size() + 1 && !history.future.empty())
    return go(history.future, history.past);
  if (depth == history.past.size() + 1) {
    history.now.step = step;
    history.past.push_back(std::move(history.now));
    history.future.clear();
  } else if (depth != history.past.size()) {
    fail("/depth", std::to_string(depth), "a step more or less than " + std::to_string(history.past.size()));
  }
  history.now = std::move(now);
}

}  // namespace

std::string firstStepLine(const EditSession& session, const Document& document, std::string_view opened) {
  JournalDocument without{session.journal(), document.folder, document.name, document.notes, ""};
  without.journal.gestures.clear();
  return stepLineOf({{kStepsMember, 1},
                 {"opened", opened},
                 {"journal", treeOf(writeJournal(without))},
                 {"nails", stepNailsOf(session)}});
}

std::string savedLine(std::string_view text) { return stepLineOf({{"saved", text}}); }

std::string addressLine(std::string_view address) { return stepLineOf({{"address", address}}); }

std::string stepLine(const EditSession& session, std::size_t gesture, const Document& now, std::string& before) {
  const Json nails = stepNailsOf(session);
  const SessionGesture& done = session.journal().gestures.at(gesture);
  Json line = {{"gesture", treeOf(gestureText(done, now.folder))},
               {"depth", session.undoDepth()},
               {"step", session.undoName()}};
  std::string text = writeDocument(now);
  text += compactText(nails);
  if (text != before) line["now"] = treeOf(writeDocument(now)), line["nails"] = nails;
  before = std::move(text);
  return stepLineOf(line);
}

bool areStepLines(std::string_view text) { return text.starts_with("{\"" + std::string(kStepsMember) + "\""); }

StepLines readStepLines(std::string_view text, const std::string& name, const std::string& folder) {
  return inFile(name, [&] {
    StepLines read;
    const std::vector<std::string_view> lines = wholeLines(text, read.bytes);
    if (lines.empty()) fail("", "no whole line", "steps of a session");
    const Json head = treeOf(lines[0], NoJson::discards);
    if (!head.is_object() || !head.contains("journal") || !head.contains("opened"))
      fail("line 1", "another line", "the first of the steps of a session");
    Json journal = head["journal"];
    read.opened = read.saved = head["opened"].get<std::string>();
    std::vector<Json> steps;
    for (std::size_t i = 1; i < lines.size(); ++i) {
      Json step = treeOf(lines[i], NoJson::discards);
      if (step.is_object() && step.contains("saved")) {
        read.saved = step["saved"].get<std::string>();
        continue;
      }
      if (step.is_object() && step.contains("address")) {
        read.address = step["address"].get<std::string>();
        continue;
      }
      if (!step.is_object() || !step.contains("gesture") || !step.contains("depth"))
        fail("line " + std::to_string(i + 1), "another line", "a step of a session");
      journal["gestures"].push_back(step["gesture"]);
      steps.push_back(std::move(step));
    }
    read.journal = parseJournal(compactText(journal), "", folder);
    SessionHistory& history = read.history;
    history.journal = read.journal.journal;
    const SessionJournal& began = history.journal;
    history.now = {began.scene, began.duration, began.controls, {}, ""};
    for (std::size_t i = 0; i < began.nails.size(); ++i)
      history.now.nails.push_back({NailId{static_cast<int>(i)}, began.nails[i], head["nails"].at(i)["on"].get<bool>()});
    history.next_nail = static_cast<int>(began.nails.size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Json& step = steps[i];
      const bool changed = step.contains("now");
      followStep(history, began.gestures[i].kind, step["depth"].get<std::size_t>(), step["step"].get<std::string>(),
             changed ? stepPointOf(step["now"], step["nails"], folder) : history.now);
      for (const SessionHistoryNail& nail : history.now.nails)
        history.next_nail = std::max(history.next_nail, nail.id.value + 1);
    }
    return read;
  });
}

}  // namespace carom::formats_detail
