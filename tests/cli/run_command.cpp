// SPDX-License-Identifier: MIT
#include "tests/cli/run_command.h"
#include "examples/support/project_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace carom::test {
namespace {

/// The words as exec takes them, while they live.
std::vector<char*> pointersTo(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

int exitCode(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -1 - WTERMSIG(status); }

// Only functions that are safe between fork and exec.
[[noreturn]] void becomeCommand(char* const* words, const char* out, const char* err) {
  const int out_file = open(out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  const int err_file = open(err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (out_file < 0 || err_file < 0) _exit(126);
  dup2(out_file, STDOUT_FILENO);
  dup2(err_file, STDERR_FILENO);
  execv(words[0], words);
  _exit(127);
}

CommandRun runProcess(std::vector<std::string> words) {
  std::vector<char*> pointers = pointersTo(words);
  const std::string out = temporaryPath("stdout"), err = temporaryPath("stderr");
  const pid_t process = fork();
  if (process == 0) becomeCommand(pointers.data(), out.c_str(), err.c_str());
  int status = 0;
  waitpid(process, &status, 0);
  CommandRun run;
  run.code = exitCode(status);
  run.out = readText(out);
  run.err = readText(err);
  return run;
}

struct TemporaryFolder {
  std::string path = testing::TempDir() + "carom-cli-" + std::to_string(getpid());

  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
};

}  // namespace

std::string commandPath() { return CAROM_COMMAND; }

CommandRun runCommand(const std::vector<std::string>& arguments) { return runProgram(commandPath(), arguments); }

CommandRun runProgram(const std::string& path, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return runProcess(words);
}

CommandRun runShell(const std::string& line) {
  const std::filesystem::path folder = std::filesystem::path(commandPath()).parent_path();
  return runProcess({"/bin/sh", "-c", "PATH='" + folder.string() + "':$PATH; " + line});
}

CommandRun runOnTerminal(Terminal terminal, const std::vector<std::string>& arguments,
                         const std::vector<std::string>& variables) {
  std::vector<std::string> words{"/usr/bin/env", "-u", "NO_COLOR", "TERM=xterm"};
  words.insert(words.end(), variables.begin(), variables.end());
  words.push_back(commandPath());
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers = pointersTo(words);
  const std::string other = temporaryPath("no-terminal");
  winsize size{50, 120, 0, 0};
  int screen = -1;
  const pid_t process = forkpty(&screen, nullptr, nullptr, &size);
  if (process == 0) {
    const int file = open(other.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (file < 0) _exit(126);
    if (terminal == Terminal::out) dup2(file, STDERR_FILENO);
    if (terminal == Terminal::error) dup2(file, STDOUT_FILENO);
    execv(pointers[0], pointers.data());
    _exit(127);
  }
  std::string shown;
  char part[4096];
  for (ssize_t count = 0; (count = read(screen, part, sizeof part)) > 0;)
    shown.append(part, static_cast<std::size_t>(count));
  int status = 0;
  waitpid(process, &status, 0);
  close(screen);
  CommandRun run;
  run.code = exitCode(status);
  run.out = terminal == Terminal::error ? readText(other) : shown;
  run.err = terminal == Terminal::error ? shown : readText(other);
  return run;
}

nlohmann::json runJson(std::vector<std::string> arguments, int code) {
  arguments.push_back("--json");
  const CommandRun run = runCommand(arguments);
  EXPECT_EQ(run.code, code) << run.err;
  const nlohmann::json answer = nlohmann::json::parse(run.out, nullptr, false);
  EXPECT_FALSE(answer.is_discarded()) << "not one JSON document:\n" << run.out;
  return answer;
}

std::vector<std::string> membersOf(const nlohmann::json& object) {
  std::vector<std::string> names;
  for (const auto& member : object.items()) names.push_back(member.key());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> sceneNames() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(projectFile("examples/scenes")))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string scenePath(const std::string& name) {
  return projectFile("examples/scenes/") + name + ".json";
}

std::string readText(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string temporaryPath(const std::string& name) {
  static const TemporaryFolder folder;
  return folder.path + "/" + name;
}

void writeText(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string writeTemporary(const std::string& name, const std::string& text) {
  const std::string path = temporaryPath(name);
  writeText(path, text);
  return path;
}

}  // namespace carom::test
