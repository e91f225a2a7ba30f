// SPDX-License-Identifier: MIT
#pragma once

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

/// Figures of one run. Times and iterations are of all tasks; ratios (objective over the best known) of those met.
struct Summary {
  double met = 0;                    ///< %
  double by_family[kFamilies] = {};  ///< %, NaN where there is none
  double by_goal[kGoals] = {};       ///< %
  double same = 0, other = 0;        ///< %, by whether another impact sequence is needed
  double median_ms = 0, p95_ms = 0;
  double median_cpu_ms = 0, p95_cpu_ms = 0;
  double median_iterations = 0;
  double median_ratio = 0, p95_ratio = 0, worst_ratio = 0;
  int claimed_not_met = 0, met_not_claimed = 0;
};
Summary summarise(const std::vector<Task>& tasks, const Run& run, const BestKnown& best);

/// How many tasks there are of each family with each goal and number of impacts, and what varies in them.
void printList(const std::vector<Task>& tasks);
void printSummary(const std::vector<Task>& tasks, const std::vector<Run>& runs, const BestKnown& best);
/// One line a failure: index, what the task is, status and message.
void printFailures(const std::vector<Task>& tasks, const std::vector<Run>& runs);
/// One line a task and configuration; one line a configuration. Throw std::runtime_error where a file cannot be
/// written.
void writeOutcomes(const std::string& file, const std::vector<Task>& tasks, const std::vector<Run>& runs,
                   const BestKnown& best);
void writeSummary(const std::string& file, const std::vector<Task>& tasks, const std::vector<Run>& runs,
                  const BestKnown& best);

}  // namespace carom::bench
