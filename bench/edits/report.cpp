// SPDX-License-Identifier: MIT
#include "bench/edits/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <stdexcept>

#include "bench/machine.h"

namespace carom::bench {
namespace {

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, Close>;

File openForWriting(const std::string& name) {
  File file(std::fopen(name.c_str(), "w"));
  if (!file) throw std::runtime_error(name + ": cannot be written");
  return file;
}

void printTable(const std::vector<Task>& tasks, const char* title, const char* (*row)(const Task&),
                int (*column)(const Task&), int columns, const char* (*heading)(int)) {
  std::map<std::string, std::vector<int>> counts;
  for (const Task& task : tasks) {
    std::vector<int>& line = counts[row(task)];
    line.resize(static_cast<std::size_t>(columns));
    ++line[static_cast<std::size_t>(column(task))];
  }
  std::printf("%-14s", title);
  for (int c = 0; c < columns; ++c) std::printf(" %12s", heading(c));
  std::printf("\n");
  for (const auto& [name, line] : counts) {
    std::printf("%-14s", name.c_str());
    for (int count : line) std::printf(" %12d", count);
    std::printf("\n");
  }
  std::printf("\n");
}

constexpr const char* kAll = "all";

/// Of all tasks, then of each family that there is.
std::vector<std::pair<std::string, Summary>> summaries(const std::vector<Task>& tasks, const Run& run,
                                                       const BestKnown& best) {
  std::vector<std::pair<std::string, Summary>> rows = {{kAll, summarise(tasks, run, best)}};
  for (int f = 0; f < kFamilies; ++f) {
    const Summary s =
        summarise(tasks, run, best, [f](const Task& t) { return static_cast<int>(t.wanted.family) == f; });
    if (s.tasks > 0) rows.emplace_back(nameOf(static_cast<Family>(f)), s);
  }
  return rows;
}

const char* familyOf(const Task& task) { return nameOf(task.wanted.family); }

const char* impactsHeading(int column) {
  constexpr const char* kNames[kMostImpacts] = {"1 impact", "2", "3", "4", "5", "6", "7", "8 or more"};
  return kNames[column];
}

}  // namespace

void printList(const std::vector<Task>& tasks) {
  printTable(
      tasks, "goals", familyOf, [](const Task& t) { return static_cast<int>(t.wanted.goal); }, kGoals,
      [](int g) { return nameOf(static_cast<Goal>(g)); });
  printTable(
      tasks, "impacts", familyOf, [](const Task& t) { return std::clamp(t.wanted.impacts, 1, kMostImpacts) - 1; },
      kMostImpacts, impactsHeading);
  printTable(
      tasks, "sequence", familyOf,
      [](const Task& t) { return !std::isfinite(t.miss)    ? 2
                                 : t.wanted.other_sequence ? 1
                                                           : 0; }, 3,
      [](int need) { return need == 2   ? "a row lacks"
                            : need == 1 ? "another"
                                        : "the same"; });
  std::map<std::string, int> kinds;
  int bounded = 0, weighted = 0, partial = 0, fewest = 1000, most = 0;
  for (const Task& task : tasks) {
    fewest = std::min(fewest, task.numbers), most = std::max(most, task.numbers);
    for (const Control& c : task.controls) {
      ++kinds[c.vary];
      bounded += !c.min.empty(), weighted += c.weight != 1, partial += !c.components.empty();
    }
  }
  std::printf("controls of %zu tasks (%d to %d numbers each):", tasks.size(), fewest, most);
  for (const auto& [kind, count] : kinds) std::printf(" %s %d,", kind.c_str(), count);
  std::printf("\nof these with bounds %d, weighted %d, with some of their components %d\n", bounded, weighted, partial);
}

void printSummary(const std::vector<Task>& tasks, const std::vector<Run>& runs, const BestKnown& best) {
  std::printf("%-16s%-10s%6s |%6s%6s%6s%6s%6s |%8s%9s%9s%9s%6s |%7s%7s%8s%7s%7s\n", "configuration", "family", "tasks",
              "met %", "same", "other", "lack", "infe.", "ms", "p95", "max", "cpu p95", "steps", "ratio", "p95",
              "worst", ">1.01 %", ">2 %");
  for (const Run& run : runs) {
    for (const auto& [family, s] : summaries(tasks, run, best)) {
      std::printf("%-16s%-10s%6d |%6.1f%6.1f%6.1f%6.1f%6d |%8.2f%9.1f%9.1f%9.1f%6.0f |%7.3f%7.3f%8.3g%7.1f%7.1f\n",
                  run.configuration->name, family.c_str(), s.tasks, s.met, s.same, s.other, s.lacking, s.infeasible,
                  s.median_ms, s.p95_ms, s.longest_ms, s.p95_cpu_ms, s.median_iterations, s.median_ratio, s.p95_ratio,
                  s.worst_ratio, s.above_1, s.above_2);
      if (family == kAll && s.claimed_not_met + s.met_not_claimed > 0)
        std::printf("  claimed but not met: %d; met but not claimed: %d\n", s.claimed_not_met, s.met_not_claimed);
    }
  }
}

void printFailures(const std::vector<Task>& tasks, const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const Outcome& o = run.outcomes[i];
      if (o.met) continue;
      const Task& t = tasks[i];
      std::printf(
          "%s: task %d (%s, %s, %d impacts, %s sequence, %d rows, %d numbers, hidden at %.3f, growth %.2g): "
          "%s after %d iterations, %.0f ms, residual %.3g. %s\n",
          run.configuration->name, t.index, nameOf(t.wanted.family), nameOf(t.wanted.goal), t.wanted.impacts,
          t.wanted.other_sequence ? "another" : "the same", t.rows, t.numbers, t.hidden_distance, t.growth,
          nameOf(o.status), o.iterations, o.milliseconds, o.residual, o.message.c_str());
    }
  }
}

void writeOutcomes(const std::string& file, const std::vector<Task>& tasks, const std::vector<Run>& runs,
                   const BestKnown& best) {
  const File out = openForWriting(file);
  std::fprintf(out.get(), "# %s\n", machineLine().c_str());
  std::fprintf(out.get(),
               "task,family,goal,impacts,other_sequence,rows,numbers,hidden_distance,growth,configuration,met,"
               "status,residual,objective,best_known,iterations,ms,cpu_ms,sequence_changed\n");
  for (const Run& run : runs) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const Task& t = tasks[i];
      const Outcome& o = run.outcomes[i];
      std::fprintf(out.get(), "%d,%s,%s,%d,%d,%d,%d,%.4g,%.3g,%s,%d,%s,%.3g,%.9g,%.9g,%d,%.3f,%.3f,%d\n", t.index,
                   nameOf(t.wanted.family), nameOf(t.wanted.goal), t.wanted.impacts, t.wanted.other_sequence ? 1 : 0,
                   t.rows, t.numbers, t.hidden_distance, t.growth, run.configuration->name, o.met ? 1 : 0,
                   nameOf(o.status), o.residual, o.objective, best.of(t), o.iterations, o.milliseconds,
                   o.cpu_milliseconds, o.sequence_changed ? 1 : 0);
    }
  }
}

void writeSummary(const std::string& file, const std::vector<Task>& tasks, const std::vector<Run>& runs,
                  const BestKnown& best, bool by_family) {
  const File out = openForWriting(file);
  std::fprintf(out.get(), "# %s\n", machineLine().c_str());
  std::fprintf(
      out.get(),
      "configuration,label,%stasks,met,same_sequence,other_sequence,lacking,infeasible,median_ms,p95_ms,max_ms,"
      "median_cpu_ms,p95_cpu_ms,median_iterations,median_ratio,p95_ratio,worst_ratio,above_1,above_2\n",
      by_family ? "family," : "");
  for (const Run& run : runs) {
    for (const auto& [family, s] : summaries(tasks, run, best)) {
      if (by_family == (family == kAll)) continue;
      std::fprintf(out.get(),
                   "%s,\"%s\",%s%s%d,%.1f,%.1f,%.1f,%.1f,%d,%.2f,%.1f,%.1f,%.2f,%.1f,%.0f,%.3f,%.3f,%.3g,%.1f,%.1f\n",
                   run.configuration->name, run.configuration->label, by_family ? family.c_str() : "",
                   by_family ? "," : "", s.tasks, s.met, s.same, s.other, s.lacking, s.infeasible, s.median_ms,
                   s.p95_ms, s.longest_ms, s.median_cpu_ms, s.p95_cpu_ms, s.median_iterations, s.median_ratio,
                   s.p95_ratio, s.worst_ratio, s.above_1, s.above_2);
    }
  }
}

}  // namespace carom::bench
