// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "bench/edits/report.h"

namespace carom::bench {
namespace {

/// Smallest value that at least this part of all is not above.
double quantile(std::vector<double> values, double part) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(part * static_cast<double>(values.size())) - 1;
  return values[static_cast<std::size_t>(std::max(0.0, rank))];
}

/// How many of all, in percent.
struct Share {
  int all = 0, some = 0;
  void count(bool one) { ++all, some += one; }
  double percent() const { return all > 0 ? 100.0 * some / all : std::numeric_limits<double>::quiet_NaN(); }
};

}  // namespace

Summary summarise(const std::vector<Task>& tasks, const Run& run, const BestKnown& best,
                  const std::function<bool(const Task&)>& counts) {
  Summary s;
  Share met, same, other, lacking, above_1, above_2;
  std::vector<double> ms, cpu, iterations, ratios;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (!counts(tasks[i])) continue;
    const Outcome& o = run.outcomes[i];
    ++s.tasks, met.count(o.met);
    (tasks[i].wanted.other_sequence ? other : same).count(o.met);
    if (!std::isfinite(tasks[i].miss)) lacking.count(o.met);
    ms.push_back(o.milliseconds);
    cpu.push_back(o.cpu_milliseconds);
    iterations.push_back(o.iterations);
    if (o.met) {
      ratios.push_back(o.objective / best.of(tasks[i]));
      above_1.count(ratios.back() > 1.01), above_2.count(ratios.back() > 2);
    }
    s.infeasible += o.status == EditStatus::infeasible;
    s.claimed_not_met += o.claimed && !o.met;
    s.met_not_claimed += o.met && !o.claimed;
  }
  s.met = met.percent(), s.same = same.percent(), s.other = other.percent(), s.lacking = lacking.percent();
  s.above_1 = above_1.percent(), s.above_2 = above_2.percent();
  s.median_ms = quantile(ms, 0.5), s.p95_ms = quantile(ms, 0.95), s.longest_ms = quantile(ms, 1);
  s.median_cpu_ms = quantile(cpu, 0.5), s.p95_cpu_ms = quantile(cpu, 0.95);
  s.median_iterations = quantile(iterations, 0.5);
  s.median_ratio = quantile(ratios, 0.5), s.p95_ratio = quantile(ratios, 0.95), s.worst_ratio = quantile(ratios, 1);
  return s;
}

Summary summarise(const std::vector<Task>& tasks, const Run& run, const BestKnown& best) {
  return summarise(tasks, run, best, [](const Task&) { return true; });
}

}  // namespace carom::bench
