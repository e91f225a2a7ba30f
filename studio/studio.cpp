// SPDX-License-Identifier: MIT
#include "studio/studio.h"

#include <filesystem>
#include <limits>
#include <thread>

#include "adjoint/base/errors.h"
#include "studio/dispatcher.h"
#include "studio/gate.h"
#include "studio/mailbox.h"
#include "studio/net.h"
#include "studio/page_files.h"
#include "studio/worker.h"
#include "studio/workspace.h"

namespace carom::studio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kSessionName = 8;  // random bytes
constexpr std::size_t kNonce = 16;
/// Steps of simulations: about a quarter of a second's worth for an update, and two seconds' for a release.
constexpr double kDragSteps = 1e5, kReleaseSteps = 1.5e6;

/// The folder of the workspace, and the name of the first scene in it.
struct Start {
  std::string folder, scene;
};

Start startOf(const StudioOptions& options) {
  if (options.scene.empty()) return {options.folder, ""};
  std::error_code error;
  const fs::path scene = fs::canonical(options.scene, error);
  if (error) throw InputError("found no file '" + options.scene + "', expected a scene document");
  if (options.folder.empty()) return {scene.parent_path().string(), scene.filename().string()};
  const fs::path below = scene.lexically_relative(fs::canonical(options.folder, error));
  if (error) throw InputError("found no folder '" + options.folder + "', expected one");
  if (below.empty() || *below.begin() == "..")
    throw InputError("found '" + options.scene + "', expected a scene below the folder '" + options.folder + "'");
  return {options.folder, below.generic_string()};
}

HttpAnswer pageAnswer(const PageFiles& files, const Request& request) {
  const PageFile* file = files.find(pathOf(request.target));
  if (file == nullptr) return {404, "text/plain; charset=utf-8", "found no such file\n", {}};
  if (!file->asksForNonce()) return {200, file->type, file->content, {}};
  const std::string nonce = randomHex(kNonce);
  return {200, file->type, file->withNonce(nonce), securityHeaders(nonce)};
}

WorkerOptions workerOptions(const StudioOptions& options, const fs::path& share) {
  WorkerOptions worker{options.limits, randomHex(kSessionName), "", {}, options.solving};
  if (fs::is_directory(share / "scenes")) worker.gallery = (share / "scenes").string();
  if (fs::is_directory(share / "gallery"))
    for (const auto& entry : fs::directory_iterator(share / "gallery"))
      if (entry.path().extension() == ".png") worker.pictures.push_back(entry.path().stem().string());
  return worker;
}

}  // namespace

SessionOptions countedWork() {
  SessionOptions options;
  options.drag_seconds = options.release_seconds = std::numeric_limits<double>::infinity();
  options.drag_steps = kDragSteps, options.release_steps = kReleaseSteps;
  return options;
}

int studio(const StudioOptions& options) {
  const std::string share = options.share.empty() ? studioFolder() : options.share;
  const PageFiles files(share);
  const Start start = startOf(options);
  Workspace workspace(start.folder);
  const std::string token = newToken();
  Mailbox mailbox(options.limits.commands);
  Net* net = nullptr;  // made last, as it needs the others
  Dispatcher dispatcher(mailbox, token, options.limits,
                        {[&](SocketId to, const std::string& text) {
                           net->send(to, {[text] { return text; }, text.size(), false, false, false});
                         },
                         [&](SocketId socket) { net->welcome(socket); },
                         [&](SocketId socket, CloseReason reason, std::chrono::milliseconds after) {
                           net->close(socket, std::move(reason), after);
                         }});
  Worker worker(mailbox, workspace, {[&](SocketId to, Outgoing message) { net->send(to, std::move(message)); }},
                workerOptions(options, share));
  if (!start.scene.empty()) worker.openFirst(start.scene);
  Net server(options.port, options.limits,
             {[&](const Request& request) { return pageAnswer(files, request); },
              [&](SocketId from, const std::string& text) { return dispatcher.message(from, text); },
              [&](SocketId socket) { dispatcher.gone(socket); }});
  net = &server;
  mailbox.onRoom([&](SocketId socket) { server.resume(socket); });
  std::jthread session([&](const std::stop_token& stop) { worker.run(stop); });
  const std::stop_callback at_end(options.stop, [&] { server.stop(); });
  if (options.ready) options.ready("http://127.0.0.1:" + std::to_string(server.port()) + "/#" + token);
  server.run();
  session.request_stop();
  mailbox.stopAll();
  return 0;
}

}  // namespace carom::studio
