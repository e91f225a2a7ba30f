// SPDX-License-Identifier: MIT
#include "studio/worker.h"

#include <algorithm>

#include "studio/refusal.h"
#include "studio/throw_of.h"

namespace carom::studio {

Worker::Worker(Mailbox& mailbox, Workspace& workspace, Post post, WorkerOptions options)
    : mailbox_(mailbox), workspace_(workspace), options_(std::move(options)), tabs_(std::move(post)), recent_(options_.recent) {
  if (!options_.gallery.empty()) gallery_ = std::make_unique<Workspace>(options_.gallery);
}

Worker::~Worker() {
  if (scene_ && scene_->session().isGrabbed()) scene_->session().cancel();
  if (scene_ && autosave_ && !scene_->isChanged()) autosave_->forget();
}

void Worker::run(const std::stop_token& stop) {
  while (step(stop)) {
  }
}

bool Worker::step(const std::stop_token& stop) {
  const std::optional<Letter> letter = mailbox_.take(stop);
  if (!letter) return false;
  handle(*letter);
  while (!hold_ && !saves_.empty()) {
    const Letter save = std::move(saves_.front());
    saves_.erase(saves_.begin());
    handle(save);
  }
  while (hold_ && hold_->resting && mailbox_.isEmpty() && !stop.stop_requested()) {
    hold_->resting = false;  // where it fails
    const Asker holder{hold_->socket, 0};
    tellingProblems(holder, [&] { rest(); });
  }
  return true;
}

void Worker::handle(const Letter& letter) {
  const Asker asker{letter.from, letter.command.id};
  if (interrupts(letter.command)) endQuestion();
  tellingProblems(asker, [&] { std::visit([&](const auto& what) { perform(asker, what); }, letter.command.what); });
}

template <class Call>
void Worker::tellingProblems(const Asker& asker, const Call& call) {
  const auto refuse = [&](const Problem& problem) {
    tabs_.tell(asker.socket, answering(asker.id, errorMessage(problem)));
  };
  try {
    call();
  } catch (const Refusal& refusal) {
    refuse({refusal.code(), refusal.what(), "", ""});
  } catch (const std::exception& error) {
    refuse(problemOf(error));
  }
}

EditSession& Worker::session() {
  if (!scene_) throw InputError("found no open scene, expected one");
  return scene_->session();
}

EditSession& Worker::sessionFor(const Asker& asker) {
  EditSession& session = this->session();
  if (hold_ && hold_->socket != asker.socket)
    throw Refusal("busy", "another window of this studio holds a body; release it there first");
  return session;
}

void Worker::requireHold(const Asker& asker, std::int64_t gesture) const {
  if (!hold_ || hold_->socket != asker.socket || hold_->gesture != gesture)
    throw Refusal("not_held", "this gesture has ended");
}

void Worker::requireRev(std::int64_t rev) const {
  if (rev != rev_) throw Refusal("stale", "the scene has changed meanwhile");
}

std::string Worker::constrainedBy() const { return hold_ ? tabs_.nameOf(hold_->socket) : ""; }

template <class Take>
void Worker::beginGesture(const Asker& asker, std::int64_t gesture, const Take& take) {
  if (hold_) cancelHold({});  // of a page that forgot it
  const std::shared_ptr<const Motion> before = session().last().motion;
  const std::size_t varied = session().controls().size();
  const SessionUpdate update = take();
  const std::vector<Control>& controls = session().controls();
  hold_ = Hold{asker.socket, gesture, -1, before, controls.size() > varied};
  sizes_vary_ = std::any_of(controls.begin(), controls.end(), [](const Control& c) { return c.vary == "size"; });
  sayMotion(asker, update, false, false);
  sayState(asker);
}

// -------------------------------------------------------------------------------------------------- what pages are
// told

void Worker::sayMotion(const Asker& asker, const SessionUpdate& update, bool more, bool gives_way) {
  if (sizes_vary_ && viewed_ != update.motion) sayScene({}, *update.motion);
  view(update.motion);
  const std::int64_t gesture = hold_ ? hold_->gesture : 0, seq = hold_ ? hold_->seq : -1;
  const bool freed = hold_ && hold_->freed;
  const MotionNews news{rev_, gesture, seq, more, freed, &update, hold_ ? hold_->before.get() : nullptr};
  tabs_.showMotion(asker.socket, asker.id, view_, motionMembers(news), gives_way);
}

void Worker::view(const std::shared_ptr<const Motion>& motion) {
  if (viewed_ == motion) return;
  auto view = std::make_shared<MotionView>(viewOf(*motion));
  view->scene = opened_;
  view_ = std::move(view);
  viewed_ = motion;
}

void Worker::sayState(const Asker& asker) {
  tabs_.tellAll(asker.socket, asker.id, stateMessage(rev_, scene_.get(), constrainedBy(), recovered_));
}

void Worker::sayScene(const Asker& asker, const Motion& motion) {
  auto view = std::make_shared<SceneView>(sceneViewOf(motion));
  view->scene = opened_;
  const bool same = scene_view_ && std::ranges::equal(scene_view_->bodies, view->bodies, &BodyView::looksLike);
  if (same && asker.id == 0) return;
  scene_view_ = std::move(view);
  tabs_.showScene(asker.socket, asker.id, scene_view_);
}

void Worker::sayAll(const Asker& asker) {
  sayScene(asker, scene_->session().motion());
  sayMotion(asker, scene_->session().last(), false, false);
  sayState(asker);
}

// --------------------------------------------------------------------------------------------------------------- drags

void Worker::dragThere(const Vec3& place, const std::optional<Quat>& orientation, const std::vector<std::string>& components) {
  const std::stop_token stop = mailbox_.beginDrag();
  EditSession& session = this->session();
  const SessionUpdate update = orientation         ? session.dragTo(place, *orientation, stop)
                               : components.empty() ? session.dragTo(place, stop)
                                                    : session.slideTo(place, components, stop);
  hold_->resting = !update.reached;
}

void Worker::perform(const Asker& asker, const Grab& grab) {
  EditSession& session = sessionFor(asker);
  std::vector<Control> also_vary;
  if (!grab.also_vary.empty()) also_vary = readControlsText(grab.also_vary, session.scene(), "/also_vary");
  if (grab.free) also_vary = throwOf(grab.body);
  const AlsoVary wanted = grab.free ? AlsoVary::where_nothing_moves_it : AlsoVary::always;
  beginGesture(asker, grab.gesture,
               [&] { return session.grab(grab.body, grab.at, grab.grip, also_vary, wanted); });
}

void Worker::perform(const Asker& asker, const GrabNail& grab) {
  EditSession& session = sessionFor(asker);
  beginGesture(asker, grab.gesture, [&] { return session.grabNail(NailId{grab.nail}); });
}

void Worker::perform(const Asker& asker, const Drag& drag) {
  requireHold(asker, drag.gesture);
  dragThere(drag.place, drag.orientation, drag.components);
  hold_->seq = drag.seq;
  sayMotion({}, session().last(), hold_->resting && mailbox_.isEmpty(), true);
}

void Worker::rest() {
  EditSession& session = scene_->session();
  const std::stop_token stop = mailbox_.beginRest();
  const SessionUpdate update =
      session.dwell(stop, [this](const SessionUpdate& better) { sayMotion({}, better, true, true); });
  hold_->resting = update.stopped || (!update.reached && update.moved);
  if (!update.stopped || update.moved) sayMotion({}, session.last(), hold_->resting, true);
}

void Worker::perform(const Asker& asker, const Release& release) {
  requireHold(asker, release.gesture);
  EditSession& session = this->session();
  if (release.place && release.seq > hold_->seq) {
    dragThere(*release.place, release.orientation, release.components);
    hold_->seq = release.seq;
  }
  hold_->resting = false;
  const std::stop_token stop = mailbox_.beginWork();
  const SessionUpdate update = release.nail ? session.releaseNailed(NailAt::where_it_got, stop) : session.release(stop);
  ++rev_;
  keepStep();
  sayMotion(asker, update, false, false);
  hold_.reset();
  sayState(asker);
}

void Worker::perform(const Asker& asker, const Cancel& cancel) {
  requireHold(asker, cancel.gesture);
  cancelHold(asker);
}

void Worker::perform(const Asker& asker, const Gone&) {
  tabs_.remove(asker.socket);
  uploads_.erase(asker.socket);
  if (hold_ && hold_->socket == asker.socket) cancelHold({});
  if (tried_ == asker.socket) endTry(), sayMotion({}, session().last(), false, false);
}

void Worker::cancelHold(const Asker& asker) {
  const SessionUpdate update = session().cancel();
  keepStep();
  sayMotion(asker, update, false, false);
  hold_.reset();
  sayState(asker);
}

}  // namespace carom::studio
