// SPDX-License-Identifier: MIT
#include "bench/edits/best_known.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace carom::bench {
namespace {

constexpr const char* kHeader = "seed,task,hidden_objective,objective,found_by";
/// Other machines may round otherwise.
constexpr double kSameTask = 1e-6;

bool isSame(double hidden, double other) { return std::abs(hidden - other) <= kSameTask * other; }

}  // namespace

BestKnown::BestKnown(std::string file) : file_(std::move(file)) { read(); }

void BestKnown::read() {
  std::ifstream in(file_);
  std::string line;
  while (std::getline(in, line)) {
    if (line.empty() || line == kHeader) continue;
    unsigned long long seed = 0;
    int index = 0;
    Entry entry;
    char found_by[64] = "";
    if (std::sscanf(line.c_str(), "%llu,%d,%lf,%lf,%63s", &seed, &index, &entry.hidden, &entry.objective, found_by) !=
        5)
      throw std::runtime_error(file_ + ": found '" + line + "', expected " + kHeader);
    entry.found_by = found_by;
    const auto known = entries_.find({seed, index});
    if (known == entries_.end() ||
        (isSame(entry.hidden, known->second.hidden) && entry.objective < known->second.objective))
      entries_[{seed, index}] = entry;
  }
}

const BestKnown::Entry* BestKnown::entryOf(const Task& task) const {
  const auto found = entries_.find({task.seed, task.index});
  if (found == entries_.end()) return nullptr;
  const Entry& entry = found->second;
  return isSame(entry.hidden, task.hidden_objective) ? &entry : nullptr;
}

double BestKnown::of(const Task& task) const {
  const Entry* entry = entryOf(task);
  return entry ? std::min(entry->objective, task.hidden_objective) : task.hidden_objective;
}

void BestKnown::offer(const Task& task, double objective, const std::string& found_by) {
  const Entry* entry = entryOf(task);
  if (!entry) entry = &(entries_[{task.seed, task.index}] = {task.hidden_objective, task.hidden_objective, "hidden"});
  // The same solution found again, a little nearer, does not change the file.
  if (objective < (1 - 1e-9) * entry->objective)
    entries_[{task.seed, task.index}] = {task.hidden_objective, objective, found_by};
}

void BestKnown::save() {
  read();
  std::FILE* out = std::fopen(file_.c_str(), "w");
  if (!out) throw std::runtime_error(file_ + ": cannot be written");
  std::fprintf(out, "%s\n", kHeader);
  for (const auto& [key, entry] : entries_)
    std::fprintf(out, "%llu,%d,%.12g,%.12g,%s\n", static_cast<unsigned long long>(key.first), key.second, entry.hidden,
                 entry.objective, entry.found_by.c_str());
  if (std::fclose(out) != 0) throw std::runtime_error(file_ + ": cannot be written");
}

}  // namespace carom::bench
