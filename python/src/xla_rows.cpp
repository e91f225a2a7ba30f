// SPDX-License-Identifier: MIT
#include "python/src/xla_rows.hpp"

#include <map>
#include <mutex>

namespace carom::python {
namespace {

struct AllOffered {
  std::mutex guard;
  std::map<std::int64_t, std::shared_ptr<const NlpEvaluator>> by_number;
  std::int64_t last = 0;
};

AllOffered& allOffered() {
  static AllOffered all;
  return all;
}

}  // namespace

OfferedEvaluator::OfferedEvaluator(const NlpEvaluator& evaluator) {
  AllOffered& all = allOffered();
  const std::lock_guard lock(all.guard);
  number_ = ++all.last;
  all.by_number.emplace(number_, std::make_shared<const NlpEvaluator>(evaluator));
}

OfferedEvaluator::~OfferedEvaluator() {
  std::shared_ptr<const NlpEvaluator> mine;  // destroyed after the lock: functions of Python may go with it
  AllOffered& all = allOffered();
  const std::lock_guard lock(all.guard);
  const auto found = all.by_number.find(number_);
  mine = std::move(found->second);
  all.by_number.erase(found);
}

std::shared_ptr<const NlpEvaluator> OfferedEvaluator::find(std::int64_t number) {
  AllOffered& all = allOffered();
  const std::lock_guard lock(all.guard);
  const auto found = all.by_number.find(number);
  return found == all.by_number.end() ? nullptr : found->second;
}

}  // namespace carom::python
