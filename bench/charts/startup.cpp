// SPDX-License-Identifier: MIT
// What one call of the command takes as a whole process, from its start to its end: of nothing (`true`), of a tiny
// scene, and of an edit, the only one that opens Ipopt.

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/charts/chart.h"
#include "examples/support/project_file.h"

namespace carom::charts {
namespace {

constexpr int kRuns = 200;

struct Call {
  std::string name;
  std::vector<std::string> words;
};

struct Cost {
  double wall, cpu;  // s
};

std::vector<Call> calls() {
  const std::string carom = CAROM_COMMAND, scenes = projectFile("examples/scenes");
  const std::string tiny = scenes + "/two-balls.json", edited = scenes + "/book-on-shelf.json";
  return {{"nothing (true)", {"/bin/true"}},
          {"carom --version", {carom, "--version"}},
          {"carom validate", {carom, "validate", tiny}},
          {"carom simulate", {carom, "simulate", tiny}},
          {"carom gradient", {carom, "gradient", tiny}},
          {"carom edit of the book", {carom, "edit", edited}}};
}

double seconds(const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); }

Cost run(const Call& call) {
  std::vector<char*> words;
  for (const std::string& word : call.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {1, 2}) posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
  const double start = now();
  pid_t process = 0;
  const int refused = posix_spawn(&process, words[0], &files, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  int status = 0;
  rusage used{};
  if (refused != 0 || wait4(process, &status, 0, &used) != process || status != 0)
    throw std::runtime_error(call.name + " failed");
  return {now() - start, seconds(used.ru_utime) + seconds(used.ru_stime)};
}

template <class Of>
double median(std::vector<Cost>& costs, Of of) {
  std::sort(costs.begin(), costs.end(), [&](const Cost& a, const Cost& b) { return of(a) < of(b); });
  return of(costs[costs.size() / 2]);
}

}  // namespace

void measure(Csv& csv) {
  csv.columns({"call", "wall", "cpu", "least_wall"});
  const std::vector<Call> all = calls();
  std::vector<std::vector<Cost>> costs(all.size());
  Progress progress(kRuns);
  for (int k = 0; k < kRuns; ++k) {  // in turn, so that all are of the same minute
    progress.next("round of calls");
    for (std::size_t i = 0; i < all.size(); ++i) costs[i].push_back(run(all[i]));
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double cpu = median(costs[i], [](const Cost& c) { return c.cpu; });
    const double wall = median(costs[i], [](const Cost& c) { return c.wall; });
    csv.row({all[i].name, wall, cpu, costs[i].front().wall});
  }
}

}  // namespace carom::charts
