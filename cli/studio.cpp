// SPDX-License-Identifier: MIT
// carom studio: edits a motion in the browser, with the mouse.
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <unistd.h>
#include <CLI/App.hpp>
#include <CLI/Validators.hpp>

#include <array>
#include <cstdlib>
#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/interruption.h"
#include "studio/recent_files.h"
#include "studio/studio.h"

extern char** environ;

namespace carom::cli {
namespace {

struct StudioArguments {
  studio::StudioOptions options;
  bool open = true;
};

/// How the browser is started: it does not end with this program, nor hold its port, nor write into its output.
class Detached {
 public:
  Detached() {
    sigset_t none;
    ::sigemptyset(&none);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  }
  ~Detached() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
  Detached(const Detached&) = delete;
  Detached& operator=(const Detached&) = delete;

  posix_spawnattr_t attributes;
  posix_spawn_file_actions_t files;
};

/// Shows the address in the browser of the desktop, where there is one.
void openInBrowser(const std::string& address) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return;
  std::string program = "xdg-open", argument = address;
  const std::array<char*, 3> arguments{program.data(), argument.data(), nullptr};
  const Detached detached;
  pid_t process = 0;
  ::posix_spawnp(&process, program.c_str(), &detached.files, &detached.attributes, arguments.data(), environ);
}

Exit serve(const StudioArguments& arguments, Output& out) {
  const Interruption::Stoppable stoppable(out.interruption());
  studio::StudioOptions options = arguments.options;
  options.stop = stoppable.token();
  options.recent = studio::recentFilesPath();
  options.ready = [&](const std::string& address) {
    std::cout << address << std::endl;
    if (arguments.open) openInBrowser(address);
  };
  return static_cast<Exit>(studio::studio(options));
}

Action declareStudio(CLI::App& app) {
  const auto arguments = std::make_shared<StudioArguments>();
  studio::StudioOptions& options = arguments->options;
  app.add_option("scene", options.scene, "The scene document to open")->type_name("S.json");
  app.add_option("--folder", options.folder, "Folder in which to open and save (default: that of the scene, else the current one)")
      ->type_name("DIR");
  app.add_option("--port", options.port, "Port of 127.0.0.1 (default: any free one)")->type_name("N");
  app.add_flag("!--no-open", arguments->open, "Print the address without opening it in a browser");
  app.add_option("--page", options.share, "Folder of the page, instead of the installed one")
      ->type_name("DIR")
      ->group("");
  return [arguments](Output& out) { return serve(*arguments, out); };
}

}  // namespace

const Command kStudioCommand{
    "studio", "Edit a motion in the browser, with the mouse",
    "Serves a page to browsers on this machine only, until Ctrl-C. Prints the address, which contains a\n"
    "secret token: whoever has it may edit. On a desktop the address is opened.\n"
    "\n"
    "Examples:\n"
    "  carom studio examples/scenes/hat-on-coatrack.json\n"
    "  carom studio --folder scenes --port 8080 --no-open",
    declareStudio, false};

}  // namespace carom::cli
