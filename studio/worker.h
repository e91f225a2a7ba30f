// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "studio/answers.h"
#include "studio/autosave.h"
#include "studio/background.h"
#include "studio/findings.h"
#include "studio/imports.h"
#include "studio/limits.h"
#include "studio/mailbox.h"
#include "studio/open_scene.h"
#include "studio/page_files.h"
#include "studio/protocol.h"
#include "studio/recent_files.h"
#include "studio/tabs.h"
#include "studio/workspace.h"

namespace carom::studio {

/// What a worker works with.
struct WorkerOptions {
  Limits limits;                      ///< told to pages
  std::string session;                ///< random name of this run
  std::string gallery;                ///< folder of the example scenes; empty: none
  std::vector<std::string> pictures;  ///< names of the scenes that have one, without ending
  SessionOptions solving;             ///< how sessions solve
  std::string recent = {};            ///< file of the scenes that were opened last; empty: they are not kept
  const PageFiles* page = nullptr;    ///< of which exported pages are made; outlives the worker
};

/// The thread of the session: does what pages ask, in order, and answers. While a body is held and has not reached its
/// target, and nothing else is asked for, it goes on towards it. One session for all pages; who holds a body keeps the
/// others from changing anything until it lets go or is gone.
class Worker {
 public:
  Worker(Mailbox& mailbox, Workspace& workspace, Post post, WorkerOptions options);
  /// Steps are kept for the next time where they were not saved.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Opens the scene that was named when the program was started. Throws FormatError.
  void openFirst(const std::string& path);
  /// Where the server before could be talked to whose steps were found; empty: there was none.
  const std::string& addressBefore() const { return address_before_; }
  /// Where this one can be. To be set before it works.
  void setAddress(std::string address);
  /// Works until it is asked to stop.
  void run(const std::stop_token& stop);
  /// Does the next command, and rests after it where that is due. False: asked to stop.
  bool step(const std::stop_token& stop);

 private:
  struct Asker {
    SocketId socket = 0;
    std::int64_t id = 0;
  };
  /// Who holds a body, and since when.
  struct Hold {
    SocketId socket = 0;
    std::int64_t gesture = 0, seq = -1;
    std::shared_ptr<const Motion> before;
    bool freed = false;    // its throw varies since
    bool resting = false;  // the hand rests before its target was reached
  };

  /// What a page asked for in the background; one at a time.
  struct Question {
    Asker asker;
    std::string type;  // of its message
    std::int64_t number = 0, rev = 0;
    bool answered = false;
    std::shared_ptr<const Findings> found;
  };

  void perform(const Asker& asker, const Hello& hello);
  void perform(const Asker&, const Prove&) {}  // answered before there is a session
  void perform(const Asker& asker, const Grab& grab);
  void perform(const Asker& asker, const GrabNail& grab);
  void perform(const Asker& asker, const Drag& drag);
  void perform(const Asker& asker, const Release& release);
  void perform(const Asker& asker, const Cancel& cancel);
  void perform(const Asker& asker, const Undo& undo);
  void perform(const Asker& asker, const Redo& redo);
  void perform(const Asker& asker, const Stop& stop);
  void perform(const Asker& asker, const MeetNails& meet);
  void perform(const Asker& asker, const MakeNail& nail);
  void perform(const Asker& asker, const SetNail& nail);
  void perform(const Asker& asker, const NailOn& nail);
  void perform(const Asker& asker, const Unnail& nail);
  void perform(const Asker& asker, const KeepSequence& keep);
  void perform(const Asker& asker, const SetControls& set);
  void perform(const Asker& asker, const SetNumbers& set);
  void perform(const Asker& asker, const Try& what);
  void perform(const Asker& asker, const AddBody& add);
  void perform(const Asker& asker, const RemoveBody& remove);
  void perform(const Asker& asker, const CopyBody& copy);
  void perform(const Asker& asker, const RenameBody& rename);
  void perform(const Asker& asker, const NewScene& make);
  void perform(const Asker& asker, const Open& open);
  void perform(const Asker& asker, const Save& save);
  void perform(const Asker& asker, const Export& what);
  void perform(const Asker& asker, const Why& why);
  void perform(const Asker& asker, const Alternatives& alternatives);
  void perform(const Asker& asker, const TakeRemedy& take);
  void perform(const Asker& asker, const Adopt& adopt);
  void perform(const Asker& asker, const FaceUp& face);
  void perform(const Asker& asker, const Sketch& sketch);
  void perform(const Asker& asker, const Upload& upload);
  void perform(const Asker& asker, const Import& import);
  void perform(const Asker& asker, const Found& found);
  void perform(const Asker& asker, const List& list);
  void perform(const Asker& asker, const Gallery& gallery);
  void perform(const Asker& asker, const Gone& gone);

  void handle(const Letter& letter);
  template <class Call>
  void tellingProblems(const Asker& asker, const Call& call);  // what goes wrong is told to that page
  void rest();
  void cancelHold(const Asker& asker);
  EditSession& session();                       // fails where no scene is open
  EditSession& sessionFor(const Asker& asker);  // and where another page holds a body
  EditSession& sessionAtRest(const Asker& asker);  // and where this one does
  void requireHold(const Asker& asker, std::int64_t gesture) const;
  void requireRev(std::int64_t rev) const;
  void requireNoHold() const;
  void sayChange(const Asker& asker, const SessionUpdate& update);
  template <class Make>
  void changeBodies(const Asker& asker, std::int64_t rev, const std::string& name, const Make& make);
  void showTried(const Asker& asker, const MotionNews& news, const std::shared_ptr<const Motion>& motion);
  void endTry();
  template <class Find>
  void askInBackground(const Asker& asker, std::int64_t rev, const std::string& type, const Find& find);
  void takeFaceUp(const Asker& asker, const Findings& found);
  void takeSketch(const Asker& asker, const Findings& found);
  void endQuestion();
  const Findings& findingsFor(const Asker& asker, std::int64_t rev, const std::string& type);
  std::string newName() const;
  template <class Take>
  void beginGesture(const Asker& asker, std::int64_t gesture, const Take& take);
  void dragThere(const Vec3& place, const std::optional<Quat>& orientation, const std::vector<std::string>& components);
  bool isExample(const std::string& path) const;
  void sayKeptProblem();
  void keepStep();
  void sayProblem();
  void takeSteps(const OpenedFile& file, const std::string& name, const std::optional<std::string>& path);
  void show(const OpenedFile& file, const std::string& name, std::optional<std::string> path);
  void sayMotion(const Asker& asker, const SessionUpdate& update, bool more, bool gives_way);
  void view(const std::shared_ptr<const Motion>& motion);
  void sayState(const Asker& asker);
  void sayScene(const Asker& asker, const Motion& motion);
  void sayAll(const Asker& asker);
  std::string constrainedBy() const;

  Mailbox& mailbox_;
  Workspace& workspace_;
  const WorkerOptions options_;
  Tabs tabs_;
  std::unique_ptr<Workspace> gallery_;
  RecentFiles recent_;
  std::vector<GalleryScene> shown_in_gallery_;  // once asked for
  std::unique_ptr<OpenScene> scene_;
  std::unique_ptr<Autosave> autosave_;  // of scene_
  std::size_t kept_ = 0;                // gestures of its journal
  std::size_t recovered_ = 0;           // steps that came back with the scene
  std::string problem_;                 // of the disk, that no page has heard
  std::string address_, address_before_;
  std::optional<Hold> hold_;
  std::optional<SocketId> tried_;  // by whom, what is shown and not kept
  std::vector<Letter> saves_;  // asked for in a gesture: they wait for its end
  std::int64_t rev_ = 0;
  std::int64_t opened_ = 0;  // scenes so far
  bool sizes_vary_ = false;               // in the gesture under way
  std::shared_ptr<const Motion> viewed_;  // what view_ shows
  std::shared_ptr<const MotionView> view_;
  std::shared_ptr<const SceneView> scene_view_;
  std::optional<Question> question_;
  std::int64_t questions_ = 0;
  std::map<SocketId, UploadedFile> uploads_;
  Background background_;  // last: its job ends before the others go
};

}  // namespace carom::studio
