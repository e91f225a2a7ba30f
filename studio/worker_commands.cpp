// SPDX-License-Identifier: MIT
// What a worker does at one go: all but drags.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "formats/export/export_motion.h"
#include "formats/json/json.hpp"
#include "studio/body_edits.h"
#include "studio/motion_page.h"
#include "studio/refusal.h"
#include "studio/worker.h"

namespace carom::studio {

void Worker::requireNoHold() const {
  if (hold_) throw Refusal("busy", "a body is held; release it first");
}

EditSession& Worker::sessionAtRest(const Asker& asker) {
  EditSession& session = sessionFor(asker);
  requireNoHold();
  return session;
}

/// After a step: a new motion, and what changed besides.
void Worker::sayChange(const Asker& asker, const SessionUpdate& update) {
  ++rev_;
  keepStep();
  sayMotion(asker, update, false, false);
  sayState(asker);
}

/// What has been done is on the disk before a page hears of it.
void Worker::keepStep() {
  for (const std::size_t done = scene_->session().journal().gestures.size(); kept_ < done; ++kept_)
    autosave_->append(scene_->stepLine(kept_));
  sayProblem();
}

void Worker::sayProblem() {
  const std::string problem = autosave_->takeProblem();
  if (!problem.empty()) tabs_.tellAll(0, 0, noticeMessage(problem));
}

/// Steps that were made on this file before come back; those that were made on another text of it are kept aside.
void Worker::takeSteps(const OpenedFile& file, const std::string& name, const std::optional<std::string>& path) {
  const std::string file_name = path ? std::filesystem::path(*path).filename().string() : scene_->suggestedName();
  autosave_ = std::make_unique<Autosave>(workspace_.folderOf(path.value_or("")), file_name);
  kept_ = recovered_ = 0;
  std::optional<formats_detail::StepLines> steps = autosave_->find();
  problem_ = autosave_->takeProblem();
  if (steps && (steps->saved == file.text || steps->opened == file.text)) {
    try {
      scene_ = std::make_unique<OpenScene>(file, *steps, name, path);
      autosave_->goOn(*steps);
      kept_ = steps->history.journal.gestures.size();
      recovered_ = steps->history.past.size();
      address_before_ = steps->address;
      if (!address_.empty()) autosave_->append(formats_detail::addressLine(address_));
      return;
    } catch (const InputError&) {
      problem_ = "The steps of '" + file_name + "' are not valid for it; they are in '" +
                 autosave_->setAside() + "'.";
    }
  } else if (steps && !steps->history.past.empty()) {
    problem_ = "'" + file_name + "' was written by another program since steps were made on it; these are in '" +
               autosave_->setAside() + "'.";
  }
  autosave_->begin(scene_->firstStepLine() + formats_detail::addressLine(address_));
}

void Worker::setAddress(std::string address) {
  address_ = std::move(address);
  if (!autosave_) return;
  if (recovered_ > 0)
    autosave_->append(formats_detail::addressLine(address_));
  else if (kept_ == 0)
    autosave_->begin(scene_->firstStepLine() + formats_detail::addressLine(address_));
}

void Worker::perform(const Asker& asker, const Hello& hello) {
  tabs_.add(asker.socket, hello.tab);
  tabs_.tell(asker.socket, answering(asker.id, welcomeMessage(options_.session, workspace_.folder(), recovered_,
                                                               options_.limits)));
  if (scene_) {
    tabs_.showSceneTo(asker.socket, asker.id, scene_view_);
    const MotionNews news{rev_, 0, -1, false, false, &scene_->session().last(), nullptr};
    tabs_.showMotionTo(asker.socket, asker.id, view_, motionMembers(news), false);
  }
  tabs_.tell(asker.socket, answering(asker.id, stateMessage(rev_, scene_.get(), constrainedBy(), recovered_)));
  if (!problem_.empty()) tabs_.tell(asker.socket, noticeMessage(std::exchange(problem_, "")));
}

void Worker::perform(const Asker& asker, const Undo&) {
  EditSession& session = sessionFor(asker);
  const SessionUpdate update = session.undo();
  hold_.reset();
  sayScene({}, *update.motion);
  sayChange(asker, update);
}

void Worker::perform(const Asker& asker, const Redo&) {
  EditSession& session = sessionAtRest(asker);
  const SessionUpdate update = session.redo();
  sayScene({}, *update.motion);
  sayChange(asker, update);
}

// What it stopped has ended when it is read.
void Worker::perform(const Asker& asker, const Stop&) {
  endTry();
  if (scene_) sayMotion(asker, scene_->session().last(), false, false);
  sayState(asker);
}

void Worker::perform(const Asker& asker, const MeetNails&) {
  EditSession& session = sessionAtRest(asker);
  sayChange(asker, session.meetNails(mailbox_.beginWork()));
}

void Worker::perform(const Asker& asker, const MakeNail& nail) {
  EditSession& session = sessionAtRest(asker);
  if (nail.constraint.empty())
    session.nailAsItIs(nail.body, nail.at);
  else
    session.nail(readConstraintText(nail.constraint, session.scene(), session.duration(), "/constraint"),
                 mailbox_.beginWork());
  sayChange(asker, session.last());
}

void Worker::perform(const Asker& asker, const SetNail& nail) {
  EditSession& session = sessionAtRest(asker);
  session.setNail(NailId{nail.nail},
                  readConstraintText(nail.constraint, session.scene(), session.duration(), "/constraint"),
                  mailbox_.beginWork());
  sayChange(asker, session.last());
}

void Worker::perform(const Asker& asker, const NailOn& nail) {
  EditSession& session = sessionAtRest(asker);
  session.setNailOn(NailId{nail.nail}, nail.on);
  sayChange(asker, session.last());
}

void Worker::perform(const Asker& asker, const Unnail& nail) {
  EditSession& session = sessionAtRest(asker);
  if (nail.sketch.empty()) {
    session.unnail(NailId{nail.nail});
  } else {
    SessionContent content = session.content();
    const auto drawn = [&](const auto& one) { return one.second.soft && one.second.notes == nail.sketch; };
    if (std::erase_if(content.nails, drawn) == 0) throw InputError("/sketch", "found no sketch '" + nail.sketch + "'");
    session.setContent(content, "removal of '" + nail.sketch + "'");
  }
  sayChange(asker, session.last());
}

void Worker::perform(const Asker& asker, const KeepSequence& keep) {
  EditSession& session = sessionAtRest(asker);
  session.keepSequence(keep.on);
  sayChange(asker, session.last());
}

void Worker::perform(const Asker& asker, const SetControls& set) {
  EditSession& session = sessionAtRest(asker);
  requireRev(set.rev);
  session.setControls(readControlsText(set.controls, session.scene(), "/controls"));
  sayChange(asker, session.last());
}

void Worker::perform(const Asker& asker, const SetNumbers& set) {
  EditSession& session = sessionAtRest(asker);
  requireRev(set.rev);
  const SessionContent content = scene_->edited(set.edits);
  requireRoom(content.scene, session.scene());
  session.setContent(content, nameOfEdits(set.edits, session.scene()));
  tried_.reset();
  sayScene({}, session.motion());
  sayChange(asker, session.last());
}

void Worker::show(const OpenedFile& file, const std::string& name, std::optional<std::string> path) {
  auto opened = std::make_unique<OpenScene>(file, name, path, options_.solving);
  if (autosave_) autosave_->forget();
  scene_ = std::move(opened);
  takeSteps(file, name, path);
  if (path) recent_.add(workspace_.folder() + "/" + *path);
  ++opened_;
  scene_view_.reset();
  hold_.reset(), tried_.reset();
  sizes_vary_ = false;
  ++rev_;
}

/// Examples are nobody's own files: they open as copies that are not saved.
bool Worker::isExample(const std::string& path) const {
  return gallery_ && workspace_.folderOf(path) == gallery_->folder();
}

void Worker::openFirst(const std::string& path) {
  show(workspace_.open(path), path, isExample(path) ? std::nullopt : std::optional(path));
  sayAll({});
}

void Worker::perform(const Asker& asker, const Open& open) {
  if (scene_) sessionFor(asker);
  requireNoHold();
  if (scene_ && scene_->isChanged() && !open.replace) throw FileConflict("the open scene has unsaved changes");
  if (open.gallery && !gallery_) throw InputError("found no gallery, expected one beside the page");
  tabs_.tell(asker.socket, answering(asker.id, progressMessage("opening " + open.path)));
  const OpenedFile file = (open.gallery ? *gallery_ : workspace_).open(open.path);
  const bool example = open.gallery || isExample(open.path);
  show(file, open.path, example ? std::nullopt : std::optional(open.path));
  sayAll(asker);
  sayKeptProblem();
}

void Worker::sayKeptProblem() {
  if (!problem_.empty()) tabs_.tellAll(0, 0, noticeMessage(std::exchange(problem_, "")));
}

void Worker::perform(const Asker& asker, const Save& save) {
  session();
  if (hold_) return saves_.push_back({asker.socket, {asker.id, save}});
  const std::optional<std::string> path = save.path ? save.path : scene_->path();
  if (!path) throw InputError("found no name for the scene, expected one");
  const std::string folder = workspace_.folderOf(*path);
  const std::optional<FileStamp> known = path == scene_->path() ? scene_->stamp() : std::nullopt;
  const std::string text = scene_->textIn(folder);
  const FileStamp stamp = workspace_.save(*path, text, known, save.replace);
  scene_->wasSaved(*path, {text, stamp, folder});
  recent_.add(workspace_.folder() + "/" + *path);
  if (folder == autosave_->folder()) autosave_->rename(std::filesystem::path(*path).filename().string());
  autosave_->append(formats_detail::savedLine(text));
  sayProblem();
  tabs_.tell(asker.socket, answering(asker.id, savedMessage(*path, rev_)));
  sayState(asker);
}

void Worker::perform(const Asker& asker, const Export& what) {
  EditSession& session = sessionAtRest(asker);
  const Document document = scene_->document();
  const std::string stem = std::filesystem::path(scene_->path().value_or(scene_->suggestedName())).stem().string();
  std::shared_ptr<const Motion> before;
  if (what.before) before = scene_->simulated({scene_->opened().scene, scene_->opened().duration, {}, {}});
  std::string bytes;
  if (what.format == "html") {
    if (options_.page == nullptr) throw InputError("found no page of the studio, expected it");
    const ShownMotion now{document, session.motion()};
    const auto opened = before ? std::optional<ShownMotion>({scene_->opened(), *before}) : std::nullopt;
    bytes = motionPage(*options_.page, document.name.empty() ? stem : document.name, now, opened ? &*opened : nullptr);
  } else {
    ExportOptions options;
    options.before = before.get();
    if (what.cubic) options.gltf.keys = GltfKeys::cubic;
    bytes = motionText(what.format, stem, document, session.motion(), options);
  }
  tabs_.send(asker.socket, asker.id, stem + "." + what.format, std::move(bytes));
}

void Worker::perform(const Asker& asker, const List& list) {
  tabs_.tell(asker.socket, answering(asker.id, filesMessage(list.path, workspace_.list(list.path, list.meshes), recent_.below(workspace_.folder()))));
}

void Worker::perform(const Asker& asker, const Gallery&) {
  if (gallery_ && shown_in_gallery_.empty()) {
    for (const ListedFile& file : gallery_->list("")) {
      if (file.folder) continue;
      const auto document = formats_detail::treeOf(gallery_->open(file.path).text, formats_detail::NoJson::discards);
      const std::string stem = file.name.substr(0, file.name.rfind('.'));
      const auto text = [&](const char* member) {
        const bool there = document.is_object() && document.contains(member) && document[member].is_string();
        return there ? document[member].get<std::string>() : std::string();
      };
      const auto& pictures = options_.pictures;
      const bool picture = std::find(pictures.begin(), pictures.end(), stem) != pictures.end();
      const std::string name = text("name").empty() ? stem : text("name");
      shown_in_gallery_.push_back({file.path, name, text("notes"), picture ? "/gallery/" + stem + ".png" : ""});
    }
  }
  tabs_.tell(asker.socket, answering(asker.id, galleryMessage(shown_in_gallery_)));
}

}  // namespace carom::studio
