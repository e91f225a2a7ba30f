// SPDX-License-Identifier: MIT
// Solves a set of edits that the program makes itself, by several ways, and says how many of them were met, how fast,
// and how small the changes are.
//   edits_bench --tasks 300 --config search --failures
// bench/charts/edits.measure runs it for the chart.

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "bench/edits/report.h"
#include "bench/edits/serve.h"
#include "examples/support/project_file.h"
#include "formats/documents/scene_json.h"

namespace carom::bench {
namespace {

constexpr const char* kUsage =
    "edits_bench [--tasks N] [--every N] [--seed S] [--only FAMILY] [--task INDEX] [--config NAME[,NAME...]]\n"
    "            [--budget SECONDS] [--threads T] [--list] [--failures] [--csv FILE] [--summary FILE] [--families "
    "FILE]\n"
    "            [--best FILE] [--improve] [--save FOLDER] [--serve] [--search-seed N]\n"
    "  --tasks     how many (all), the first     --only      of one family: ball, box, hull, meeting, chain, ...\n"
    "  --every     N: only every N-th\n"
    "  --task      one task alone               --config    of the configurations (all)\n"
    "  --budget    s, of each edit (5)          --threads   tasks at a time (1: times are right)\n"
    "  --list      says what tasks there are    --failures  lists what was not met, with status and message\n"
    "  --csv       one line a task              --summary   one line a configuration\n"
    "  --families  one line a family and configuration\n"
    "  --improve   keeps smaller changes in the file of the best known (--best)\n"
    "  --save      writes every task as a scene document, edit-INDEX.json\n"
    "  --serve     answers questions about tasks, see serve.h\n"
    "  --search-seed  of the samples (0): variants are compared by several, as which edits end badly is chance\n";

struct Settings {
  int tasks = kTasks, threads = 1;
  std::uint64_t seed = 1;
  std::optional<int> task;
  int search_seed = 0;
  int every = 1;
  std::string only, configurations, csv, summary, families, save, best = projectFile("bench/edits/best_known.csv");
  double budget = 5;
  bool list = false, failures = false, improve = false, serves = false;
};

Settings readSettings(int argc, char** argv) {
  Settings s;
  std::map<std::string, bool*> flags = {
      {"--list", &s.list}, {"--failures", &s.failures}, {"--improve", &s.improve}, {"--serve", &s.serves}};
  std::map<std::string, std::function<void(const std::string&)>> values = {
      {"--tasks", [&](const std::string& v) { s.tasks = std::stoi(v); }},
      {"--seed", [&](const std::string& v) { s.seed = std::stoull(v); }},
      {"--search-seed", [&](const std::string& v) { s.search_seed = std::stoi(v); }},
      {"--task", [&](const std::string& v) { s.task = std::stoi(v); }},
      {"--every", [&](const std::string& v) { s.every = std::max(1, std::stoi(v)); }},
      {"--only", [&](const std::string& v) { s.only = v; }},
      {"--config", [&](const std::string& v) { s.configurations = "," + v + ","; }},
      {"--budget", [&](const std::string& v) { s.budget = std::stod(v); }},
      {"--threads", [&](const std::string& v) { s.threads = std::max(1, std::stoi(v)); }},
      {"--csv", [&](const std::string& v) { s.csv = v; }},
      {"--summary", [&](const std::string& v) { s.summary = v; }},
      {"--families", [&](const std::string& v) { s.families = v; }},
      {"--best", [&](const std::string& v) { s.best = v; }},
      {"--save", [&](const std::string& v) { s.save = v; }},
  };
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (const auto flag = flags.find(word); flag != flags.end()) {
      *flag->second = true;
    } else if (const auto value = values.find(word); value != values.end() && i + 1 < argc) {
      value->second(argv[++i]);
    } else {
      throw std::runtime_error("found '" + word + "', expected\n" + kUsage);
    }
  }
  return s;
}

/// Calls work(0) ... work(count - 1), several at a time; says on a terminal how far it is.
void forEach(int count, int threads, const char* what, const std::function<void(int)>& work) {
  const bool terminal = isatty(STDERR_FILENO) != 0;
  std::atomic<int> next = 0, done = 0;
  std::exception_ptr failure;
  std::atomic<bool> failed = false;
  const auto run = [&] {
    for (int i = next++; i < count && !failed; i = next++) {
      try {
        work(i);
      } catch (...) {
        if (!failed.exchange(true)) failure = std::current_exception();
      }
      if (const int so_far = ++done; terminal) std::fprintf(stderr, "\r%s %d of %d ", what, so_far, count);
    }
  };
  std::vector<std::thread> workers;
  for (int t = 1; t < threads; ++t) workers.emplace_back(run);
  run();
  for (std::thread& worker : workers) worker.join();
  if (terminal) std::fprintf(stderr, "\r%60s\r", "");
  if (failure) std::rethrow_exception(failure);
}

std::vector<Task> makeTasks(const Settings& s) {
  std::vector<int> indices;
  for (int i = s.task.value_or(0); i < s.task.value_or(kTasks - 1) + 1; i += s.every)
    if (s.only.empty() || s.only == nameOf(wantedOf(i).family)) indices.push_back(i);
  if (static_cast<int>(indices.size()) > s.tasks) indices.resize(static_cast<std::size_t>(s.tasks));
  std::vector<Task> tasks(indices.size());
  forEach(static_cast<int>(indices.size()), s.threads, "task", [&](int i) {
    const std::size_t k = static_cast<std::size_t>(i);
    tasks[k] = makeTask(s.seed, indices[k]);
  });
  return tasks;
}

std::vector<Run> runAll(const Settings& s, const std::vector<Task>& tasks) {
  std::vector<Run> runs;
  for (const Configuration& configuration : configurations()) {
    const std::string name = configuration.name;
    if (!s.configurations.empty() && s.configurations.find("," + name + ",") == std::string::npos) continue;
    Configuration seeded = configuration;
    seeded.options.seed = s.search_seed;
    Run run{&configuration, std::vector<Outcome>(tasks.size())};
    forEach(static_cast<int>(tasks.size()), s.threads, configuration.name, [&](int i) {
      const std::size_t k = static_cast<std::size_t>(i);
      run.outcomes[k] = solve(tasks[k], seeded, s.budget);
    });
    runs.push_back(std::move(run));
  }
  if (runs.empty()) {
    std::string names;
    for (const Configuration& configuration : configurations()) names += std::string(" ") + configuration.name;
    throw std::runtime_error("--config: found '" + s.configurations + "', expected some of" + names);
  }
  return runs;
}

void saveScenes(const std::string& folder, const std::vector<Task>& tasks) {
  for (const Task& task : tasks) {
    Document document;
    document.scene = task.start;
    document.duration = task.duration;
    document.controls = task.controls;
    document.constraints = task.constraints;
    saveDocument(folder + "/edit-" + std::to_string(task.index) + ".json", document);
  }
}

void run(const Settings& s) {
  if (s.serves) {
    BestKnown best(s.best);
    serve(s.seed, std::cin, std::cout, best);
    return;
  }
  const std::vector<Task> tasks = makeTasks(s);
  if (!s.save.empty()) saveScenes(s.save, tasks);
  if (s.list) printList(tasks);
  if (s.list || !s.save.empty()) return;
  BestKnown best(s.best);
  const std::vector<Run> runs = runAll(s, tasks);
  for (const Run& run : runs)
    for (std::size_t i = 0; i < tasks.size(); ++i)
      if (run.outcomes[i].met) best.offer(tasks[i], run.outcomes[i].objective, run.configuration->name);
  if (s.improve) best.save();
  printSummary(tasks, runs, best);
  if (s.failures) printFailures(tasks, runs);
  if (!s.csv.empty()) writeOutcomes(s.csv, tasks, runs, best);
  if (!s.summary.empty()) writeSummary(s.summary, tasks, runs, best, false);
  if (!s.families.empty()) writeSummary(s.families, tasks, runs, best, true);
}

}  // namespace
}  // namespace carom::bench

int main(int argc, char** argv) {
  try {
    carom::bench::run(carom::bench::readSettings(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "edits_bench: %s\n", error.what());
    return 1;
  }
}
