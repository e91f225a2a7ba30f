// SPDX-License-Identifier: MIT
#include "studio/studio.h"

#include <filesystem>
#include <limits>
#include <memory>
#include <regex>
#include <thread>

#include "adjoint/base/errors.h"
#include "studio/compressed_files.h"
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
constexpr std::size_t kNonceBytes = 16;
/// Steps of simulations: about a quarter of a second's worth for an update, and two seconds' for a release.
constexpr double kDragSteps = 1e5, kReleaseSteps = 7e5;

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

/// Where a server can be talked to.
struct Address {
  unsigned short port = 0;
  std::string token;
};

/// "http://127.0.0.1:PORT/#TOKEN", as this program printed it; of anything else nothing.
Address addressOf(const std::string& text) {
  std::smatch parts;
  static const std::regex kForm("http://127\\.0\\.0\\.1:([1-9][0-9]{0,4})/#([0-9a-f]+)");
  if (!std::regex_match(text, parts, kForm) || parts[2].length() != static_cast<long>(newToken().size())) return {};
  const unsigned long port = std::stoul(parts[1]);
  if (port > std::numeric_limits<unsigned short>::max()) return {};
  return {static_cast<unsigned short>(port), parts[2]};
}

/// At the port of the server before, where that can be had, so that its pages find this one by themselves.
std::unique_ptr<Net> listen(const StudioOptions& options, unsigned short before, const NetHandlers& handlers) {
  if (options.port == 0 && before != 0) {
    try {
      return std::make_unique<Net>(before, options.limits, handlers);
    } catch (const InputError&) {  // somebody else has it now
    }
  }
  return std::make_unique<Net>(options.port, options.limits, handlers);
}

HttpAnswer pageAnswer(const PageFiles& files, const CompressedFiles& compressed, const Request& request) {
  const PageFile* file = files.find(pathOf(request.target));
  if (file == nullptr) return {404, "text/plain; charset=utf-8", "found no such file\n", {}};
  if (const std::string* bytes = compressed.find(pathOf(request.target)); bytes != nullptr && acceptsGzip(request.encodings))
    return {200, file->type, *bytes, {{"Content-Encoding", "gzip"}, {"Vary", "Accept-Encoding"}}};
  if (!file->asksForNonce()) return {200, file->type, file->content, {}};
  const std::string nonce = randomHex(kNonceBytes);
  return {200, file->type, file->withNonce(nonce), securityHeaders(nonce)};
}

WorkerOptions workerOptions(const StudioOptions& options, const fs::path& share, const PageFiles& files) {
  WorkerOptions worker{options.limits, randomHex(kSessionName), "", {}, options.solving, options.recent, &files};
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
  const CompressedFiles compressed(files);
  const Start start = startOf(options);
  Workspace workspace(start.folder);
  Mailbox mailbox(options.limits.commands);
  Net* net = nullptr;  // made last, as it needs the others
  Worker worker(mailbox, workspace, {[&](SocketId to, Outgoing message) { net->send(to, std::move(message)); }},
                workerOptions(options, share, files));
  if (!start.scene.empty()) worker.openFirst(start.scene);
  const Address before = addressOf(worker.addressBefore());
  std::unique_ptr<Dispatcher> dispatcher;  // its token depends on the port
  const NetHandlers handlers{[&](const Request& request) { return pageAnswer(files, compressed, request); },
                             [&](SocketId from, const std::string& text) { return dispatcher->message(from, text); },
                             [&](SocketId socket) { dispatcher->gone(socket); }};
  const std::unique_ptr<Net> server = listen(options, before.port, handlers);
  net = server.get();
  // who has the port of before now may have heard the token of before from a page that looked for this server
  const std::string token = server->port() == before.port ? before.token : newToken();
  dispatcher = std::make_unique<Dispatcher>(
      mailbox, token, options.limits,
      Dispatcher::Line{[&](SocketId to, const std::string& text) {
                         net->send(to, {[text] { return text; }, text.size(), false, false, false});
                       },
                       [&](SocketId socket) { net->welcome(socket); },
                       [&](SocketId socket, CloseReason reason, std::chrono::milliseconds after) {
                         net->close(socket, std::move(reason), after);
                       }});
  if (token == before.token) dispatcher->provesFrom(std::chrono::steady_clock::now() + options.limits.no_proof);
  const std::string address = "http://127.0.0.1:" + std::to_string(server->port()) + "/#" + token;
  worker.setAddress(address);
  mailbox.onRoom([&](SocketId socket) { server->resume(socket); });
  std::jthread session([&](const std::stop_token& stop) { worker.run(stop); });
  const std::stop_callback at_end(options.stop, [&] { server->stop(); });
  if (options.ready) options.ready(address);
  server->run();
  session.request_stop();
  mailbox.stopAll();
  return 0;
}

}  // namespace carom::studio
