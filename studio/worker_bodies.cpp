// SPDX-License-Identifier: MIT
// Scenes that begin empty, bodies that come and go, and numbers that are tried.
#include <algorithm>

#include "formats/documents/scene_json.h"
#include "studio/body_edits.h"
#include "studio/refusal.h"
#include "studio/worker.h"

namespace carom::studio {
/// A name that no file of the folder has.
std::string Worker::newName() const {
  const std::vector<ListedFile> files = workspace_.list("");
  for (int n = 1;; ++n) {
    const std::string name = n == 1 ? "scene.json" : "scene-" + std::to_string(n) + ".json";
    if (std::ranges::none_of(files, [&](const ListedFile& file) { return file.name == name; })) return name;
  }
}

void Worker::perform(const Asker& asker, const NewScene& make) {
  if (scene_) sessionFor(asker);
  requireNoHold();
  if (scene_ && scene_->isChanged() && !make.replace) throw FileConflict("the open scene has unsaved changes");
  show({kEmptyScene, {}, workspace_.folderOf("")}, newName(), std::nullopt);
  sayAll(asker);
  sayKeptProblem();
}

template <class Make>
void Worker::changeBodies(const Asker& asker, std::int64_t rev, const std::string& name, const Make& make) {
  EditSession& session = sessionAtRest(asker);
  requireRev(rev);
  const Document document = scene_->document();
  const SessionContent before = session.content(), content = make(EditedDocument{document, before});
  requireRoom(content.scene, before.scene);
  session.setContent(content, name);
  sayScene({}, session.motion());
  sayChange(asker, session.last());
}

void Worker::perform(const Asker& asker, const AddBody& add) {
  const auto make = [&](const EditedDocument& now) { return withBody(now, add.body, add.on); };
  changeBodies(asker, add.rev, "another body", make);
}

void Worker::perform(const Asker& asker, const RemoveBody& remove) {
  changeBodies(asker, remove.rev, "removal of '" + remove.body + "'",
               [&](const EditedDocument& now) { return withoutBody(now, remove.body); });
}

void Worker::perform(const Asker& asker, const CopyBody& copy) {
  changeBodies(asker, copy.rev, "copy of '" + copy.body + "'",
               [&](const EditedDocument& now) { return withCopy(now, copy.body); });
}

void Worker::perform(const Asker& asker, const RenameBody& rename) {
  changeBodies(asker, rename.rev, "name of '" + rename.name + "'",
               [&](const EditedDocument& now) { return renamed(now, rename.body, rename.name); });
}

void Worker::perform(const Asker& asker, const Try& what) {
  EditSession& session = sessionAtRest(asker);
  requireRev(what.set.rev);
  const SessionContent content = scene_->edited(what.set.edits);
  requireRoom(content.scene, session.scene());
  const std::shared_ptr<const Motion> motion = scene_->simulated(content);
  const bool reshaped = std::ranges::any_of(what.set.edits, [](const auto& edit) { return edit.first.find("/shape") != std::string::npos; });
  if (reshaped) sayScene({}, *motion);
  showTried(asker, {rev_, what.gesture, what.seq, false, false, nullptr, nullptr}, motion);
}

/// What is shown and not kept; `news` gets its update.
void Worker::showTried(const Asker& asker, const MotionNews& news, const std::shared_ptr<const Motion>& motion) {
  SessionUpdate update = session().last();
  update.motion = motion;
  update.reached = true;
  tried_ = asker.socket;
  view(motion);
  MotionNews told = news;
  told.update = &update;
  tabs_.showMotion(asker.socket, asker.id, view_, motionMembers(told), false);
}

/// Back to what is, after what was tried.
void Worker::endTry() {
  if (!tried_) return;
  tried_.reset();
  sayScene({}, scene_->session().motion());
}

}  // namespace carom::studio
