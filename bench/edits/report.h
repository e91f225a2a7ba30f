// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/edits/best_known.h"
#include "bench/edits/outcome.h"

namespace carom::bench {

/// All outcomes of one configuration, one a task.
struct Run {
  const Configuration* configuration = nullptr;
  std::vector<Outcome> outcomes;
};

/// Figures of some tasks of one run. Times and iterations are of all these tasks; ratios (objective over the best
/// known) of those met.
struct Summary {
  int tasks = 0;
  double met = 0;              ///< %; NaN where there are no tasks, as all that follows
  double same = 0, other = 0;  ///< %, of those that need the same impact sequence, and of those that need another
  double lacking = 0;          ///< %, of those whose start lacks what is held
  int infeasible = 0;          ///< called so although every task can be met
  double median_ms = 0, p95_ms = 0, longest_ms = 0;
  double median_cpu_ms = 0, p95_cpu_ms = 0;
  double median_iterations = 0;
  double median_ratio = 0, p95_ratio = 0, worst_ratio = 0;
  double above_1 = 0, above_2 = 0;  ///< %, of those met: ratios above 1.01 and above 2
  int claimed_not_met = 0, met_not_claimed = 0;
};
/// Of the tasks that `counts` picks.
Summary summarise(const std::vector<Task>& tasks, const Run& run, const BestKnown& best,
                  const std::function<bool(const Task&)>& counts);
Summary summarise(const std::vector<Task>& tasks, const Run& run, const BestKnown& best);

/// How many tasks there are of each family with each goal and number of impacts, and what varies in them.
void printList(const std::vector<Task>& tasks);
void printSummary(const std::vector<Task>& tasks, const std::vector<Run>& runs, const BestKnown& best);
/// One line a failure: index, what the task is, status and message.
void printFailures(const std::vector<Task>& tasks, const std::vector<Run>& runs);
/// One line a task and configuration; one line a configuration, or one a family of each. Throw std::runtime_error where
/// a file cannot be written.
void writeOutcomes(const std::string& file, const std::vector<Task>& tasks, const std::vector<Run>& runs,
                   const BestKnown& best);
void writeSummary(const std::string& file, const std::vector<Task>& tasks, const std::vector<Run>& runs,
                  const BestKnown& best, bool by_family);

}  // namespace carom::bench
