// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "studio/net.h"
#include "studio/views.h"

namespace carom::studio {

/// How messages leave; calls may come from any thread.
struct Post {
  std::function<void(SocketId, Outgoing)> send;
};

/// The pages that have said hello, and what each of them has: frames leave out what is the same there. What a page has
/// changes when a frame is really sent, by the thread that sends it; everything else belongs to the session's thread.
class Tabs {
 public:
  explicit Tabs(Post post) : post_(std::move(post)) {}

  void add(SocketId socket, const std::string& name) { tabs_[socket] = {name, std::make_shared<Has>()}; }
  void remove(SocketId socket) { tabs_.erase(socket); }
  /// The name that the page gave itself; empty: it is gone.
  std::string nameOf(SocketId socket) const;

  /// A text to one page.
  void tell(SocketId socket, std::string text) const;
  /// A file to one page, as the answer to command `id`.
  void send(SocketId socket, std::int64_t id, const std::string& name, std::string bytes) const;
  /// A text to all pages; to `asker` as the answer to command `id`.
  void tellAll(SocketId asker, std::int64_t id, const std::string& text) const;
  /// A motion to all pages. `gives_way`: a newer one makes it needless.
  void showMotion(SocketId asker, std::int64_t id, std::shared_ptr<const MotionView> view, const std::string& members,
                  bool gives_way) const;
  /// A motion to one page.
  void showMotionTo(SocketId socket, std::int64_t id, std::shared_ptr<const MotionView> view,
                    const std::string& members, bool gives_way) const;
  /// One of other motions to one page, with all its tracks.
  void showAlternative(SocketId socket, std::shared_ptr<const MotionView> view, const std::string& members) const;
  /// A scene to all pages.
  void showScene(SocketId asker, std::int64_t id, std::shared_ptr<const SceneView> view) const;
  /// A scene to one page.
  void showSceneTo(SocketId socket, std::int64_t id, std::shared_ptr<const SceneView> view) const;

 private:
  struct Has {
    std::shared_ptr<const MotionView> motion;
    std::shared_ptr<const SceneView> scene;
  };
  struct Tab {
    std::string name;
    std::shared_ptr<Has> has;
  };

  Post post_;
  std::map<SocketId, Tab> tabs_;
};

}  // namespace carom::studio
