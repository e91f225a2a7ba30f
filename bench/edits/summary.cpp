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

double percentMet(const std::vector<Task>& tasks, const Run& run, const std::function<bool(const Task&)>& counts) {
  int all = 0, met = 0;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    if (!counts(tasks[i])) continue;
    ++all, met += run.outcomes[i].met;
  }
  return all > 0 ? 100.0 * met / all : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Summary summarise(const std::vector<Task>& tasks, const Run& run, const BestKnown& best) {
  Summary s;
  const auto percent = [&](const auto& counts) { return percentMet(tasks, run, counts); };
  s.met = percent([](const Task&) { return true; });
  for (int f = 0; f < kFamilies; ++f)
    s.by_family[f] = percent([f](const Task& t) { return static_cast<int>(t.wanted.family) == f; });
  for (int g = 0; g < kGoals; ++g)
    s.by_goal[g] = percent([g](const Task& t) { return static_cast<int>(t.wanted.goal) == g; });
  s.same = percent([](const Task& t) { return !t.wanted.other_sequence; });
  s.other = percent([](const Task& t) { return t.wanted.other_sequence; });
  std::vector<double> ms, cpu, iterations, ratios;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const Outcome& o = run.outcomes[i];
    ms.push_back(o.milliseconds);
    cpu.push_back(o.cpu_milliseconds);
    iterations.push_back(o.iterations);
    if (o.met) ratios.push_back(o.objective / best.of(tasks[i]));
    s.claimed_not_met += o.claimed && !o.met;
    s.met_not_claimed += o.met && !o.claimed;
  }
  s.median_ms = quantile(ms, 0.5), s.p95_ms = quantile(ms, 0.95);
  s.median_cpu_ms = quantile(cpu, 0.5), s.p95_cpu_ms = quantile(cpu, 0.95);
  s.median_iterations = quantile(iterations, 0.5);
  s.median_ratio = quantile(ratios, 0.5), s.p95_ratio = quantile(ratios, 0.95), s.worst_ratio = quantile(ratios, 1);
  return s;
}

}  // namespace carom::bench
