// SPDX-License-Identifier: MIT
// Questions that are answered in the background, and steps that take an answer over.
#include <algorithm>
#include <cmath>

#include "studio/findings.h"
#include "studio/frames.h"
#include "studio/refusal.h"
#include "studio/worker.h"

namespace carom::studio {

template <class Find>
void Worker::askInBackground(const Asker& asker, std::int64_t rev, const std::string& type, const Find& find) {
  EditSession& session = sessionAtRest(asker);
  requireRev(rev);
  question_ = Question{asker, type, ++questions_, rev_, false, nullptr};
  background_.start([find, &mailbox = mailbox_, number = questions_, snapshot = session.snapshot()](const std::stop_token& stop) {
    find(mailbox, number, snapshot, stop);
  });
}

void Worker::perform(const Asker& asker, const Why& why) {
  askInBackground(asker, why.rev, "why", findRemedies);
}

void Worker::perform(const Asker& asker, const Alternatives& alternatives) {
  askInBackground(asker, alternatives.rev, "alternatives",
                  [most = alternatives.count](Mailbox& mailbox, std::int64_t number, const SessionSnapshot& snapshot, const std::stop_token& stop) {
                    findAlternatives(mailbox, number, snapshot, most, stop);
                  });
}

void Worker::perform(const Asker& asker, const FaceUp& face) {
  bodyIndex(session().scene(), face.body);
  askInBackground(asker, face.rev, "face_up",
                  [face](Mailbox& mailbox, std::int64_t number, const SessionSnapshot& snapshot, const std::stop_token& stop) {
                    findFaceUpFor(mailbox, number, snapshot, face, stop);
                  });
}

void Worker::perform(const Asker& asker, const Sketch& sketch) {
  bodyIndex(session().scene(), sketch.body);
  askInBackground(asker, sketch.rev, "sketch",
                  [sketch](Mailbox& mailbox, std::int64_t number, const SessionSnapshot& snapshot, const std::stop_token& stop) {
                    findSketchFor(mailbox, number, snapshot, sketch, stop);
                  });
}

void Worker::takeFaceUp(const Asker& asker, const Findings& found) {
  if (found.face.content) {
    session().setContent(*found.face.content, "a face up");
    sayChange({}, session().last());
  }
  tabs_.tell(asker.socket, answering(asker.id, faceUpMessage(found, rev_)));
}

/// The first answer is shown and not kept; the last one is a step.
void Worker::takeSketch(const Asker& asker, const Findings& found) {
  if (found.fitted) {
    tried_.reset();
    session().setContent(*found.fitted, "sketch of '" + found.fitted->nails.back().second.body + "'");
    sayScene({}, session().motion());
    sayChange({}, session().last());
  } else if (found.more) {
    showTried({asker.socket, 0}, {rev_, 0, -1, true, false, nullptr, nullptr}, found.first);
  } else {
    endTry();
    sayMotion({}, session().last(), false, false);
  }
  tabs_.tell(asker.socket, answering(asker.id, sketchMessage(found, rev_)));
}

void Worker::perform(const Asker&, const Found& found) {
  if (!question_ || question_->answered || found.what->question != question_->number) return;
  question_->found = found.what;
  question_->answered = !found.what->more;
  const auto& [asker, type, number, rev, answered, what] = *question_;
  if (type == "face_up") return takeFaceUp(asker, *what);
  if (type == "sketch") return takeSketch(asker, *what);
  if (type == "why") return tabs_.tell(asker.socket, answering(asker.id, whyMessage(*what, rev)));
  for (std::size_t i = 0; i < what->motions.size(); ++i) {
    auto view = std::make_shared<MotionView>(*what->motions[i]);
    view->scene = opened_;
    tabs_.showAlternative(asker.socket, view, alternativeMembers(*what, i, rev));
  }
  tabs_.tell(asker.socket, answering(asker.id, alternativesMessage(*what, rev)));
}

/// Who asked is told that no answer comes any more.
void Worker::endQuestion() {
  background_.cancel();
  if (!question_ || question_->answered) return;
  question_->answered = true;
  if (question_->type == "sketch" && tried_) endTry(), sayMotion({}, session().last(), false, false);
  tabs_.tell(question_->asker.socket, answering(question_->asker.id, cancelledMessage(question_->type, question_->rev)));
}

/// What was found for a question about the scene as it is.
const Findings& Worker::findingsFor(const Asker& asker, std::int64_t rev, const std::string& type) {
  sessionAtRest(asker);
  requireRev(rev);
  if (!question_ || !question_->found || question_->type != type || question_->rev != rev_)
    throw Refusal("stale", "the scene has changed meanwhile");
  return *question_->found;
}

void Worker::perform(const Asker& asker, const TakeRemedy& take) {
  const Findings& found = findingsFor(asker, take.rev, "why");
  const auto remedy = std::ranges::find(found.why.remedies, take.name, &SessionRemedy::name);
  if (remedy == found.why.remedies.end()) throw Refusal("stale", "this remedy has another name by now");
  session().setContent(remedy->content, remedy->name);
  sayScene({}, session().motion());
  sayChange(asker, session().last());
}

void Worker::perform(const Asker& asker, const Adopt& adopt) {
  const Findings& found = findingsFor(asker, adopt.rev, "alternatives");
  const auto index = static_cast<std::size_t>(adopt.index);
  if (index >= found.others.found.size())
    throw InputError("/index", "found " + std::to_string(adopt.index) + ", expected less than " + std::to_string(found.others.found.size()));
  SessionContent content = session().content();
  content.scene = found.others.found[index].scene;
  session().setContent(content, "another solution");
  sayScene({}, session().motion());
  sayChange(asker, session().last());
  question_->rev = rev_;  // the others meet the same still
}

}  // namespace carom::studio
