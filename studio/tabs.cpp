// SPDX-License-Identifier: MIT
#include "studio/tabs.h"

#include "studio/answers.h"
#include "studio/frames.h"

namespace carom::studio {
namespace {

/// About how many bytes a frame has.
std::size_t bytesOf(const MotionView& view) {
  std::size_t numbers = 0;
  for (const DisplayTrack& track : view.tracks) numbers += 10 * track.arcs.size() + 3 * track.turns.size();
  return 1000 + 100 * view.impacts.size() + 8 * numbers;
}
std::size_t bytesOf(const SceneView& view) {
  std::size_t numbers = 0;
  for (const BodyView& body : view.bodies) numbers += body.mesh.positions.size() * 2 + body.mesh.triangles.size();
  return 1000 + 4 * numbers;
}

}  // namespace

std::string Tabs::nameOf(SocketId socket) const {
  const auto found = tabs_.find(socket);
  return found == tabs_.end() ? "" : found->second.name;
}

void Tabs::tell(SocketId socket, std::string text) const {
  const std::size_t bytes = text.size();
  post_.send(socket, {[text = std::move(text)] { return text; }, bytes, false, false, false});
}

void Tabs::send(SocketId socket, std::int64_t id, const std::string& name, std::string bytes) const {
  const std::size_t size = bytes.size();
  post_.send(socket, {[name, id, bytes = std::move(bytes)] { return fileFrame(name, bytes, answering(id, "{}")); }, size, true, false, false});
}

void Tabs::tellAll(SocketId asker, std::int64_t id, const std::string& text) const {
  for (const auto& [socket, tab] : tabs_) tell(socket, answering(socket == asker ? id : 0, text));
}

void Tabs::showMotionTo(SocketId socket, std::int64_t id, std::shared_ptr<const MotionView> view,
                        const std::string& members, bool gives_way) const {
  const auto tab = tabs_.find(socket);
  if (tab == tabs_.end()) return;
  const std::size_t bytes = bytesOf(*view);
  const auto encode = [view = std::move(view), members = answering(id, members), has = tab->second.has] {
    std::string frame = motionFrame(*view, members, has->motion.get());
    has->motion = view;
    return frame;
  };
  post_.send(socket, {encode, bytes, true, gives_way, true});
}

void Tabs::showMotion(SocketId asker, std::int64_t id, std::shared_ptr<const MotionView> view,
                      const std::string& members, bool gives_way) const {
  for (const auto& [socket, tab] : tabs_) showMotionTo(socket, socket == asker ? id : 0, view, members, gives_way);
}

void Tabs::showAlternative(SocketId socket, std::shared_ptr<const MotionView> view, const std::string& members) const {
  if (!tabs_.contains(socket)) return;
  const std::size_t bytes = bytesOf(*view);
  post_.send(socket, {[view = std::move(view), members] { return alternativeFrame(*view, members); }, bytes, true, false, false});
}

void Tabs::showSceneTo(SocketId socket, std::int64_t id, std::shared_ptr<const SceneView> view) const {
  const auto tab = tabs_.find(socket);
  if (tab == tabs_.end()) return;
  const std::size_t bytes = bytesOf(*view);
  const auto encode = [view = std::move(view), id, has = tab->second.has] {
    std::string frame = sceneFrame(*view, answering(id, "{}"), has->scene.get());
    has->scene = view;
    return frame;
  };
  post_.send(socket, {encode, bytes, true, false, false});
}

void Tabs::showScene(SocketId asker, std::int64_t id, std::shared_ptr<const SceneView> view) const {
  for (const auto& [socket, tab] : tabs_) showSceneTo(socket, socket == asker ? id : 0, view);
}

}  // namespace carom::studio
