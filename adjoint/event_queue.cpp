#include "adjoint/event_queue.h"

#include <algorithm>

namespace carom {

void EventQueue::set(int body, double time, bool is_horizon) {
  const auto b = static_cast<std::uint32_t>(body);
  const std::uint32_t place = place_[b];
  if (time == kNever) {
    if (place == kNone) return;
    const Entry last = heap_.back();
    heap_.pop_back();
    place_[b] = kNone;
    if (place == heap_.size()) return;
    moveUp(place, last);
    moveDown(placeOf(last), last);
    return;
  }
  const Entry entry{time, is_horizon ? b | kHorizon : b};
  if (place == kNone) {
    heap_.push_back(entry);
    moveUp(heap_.size() - 1, entry);
  } else if (entry < heap_[place]) {
    moveUp(place, entry);
  } else {
    moveDown(place, entry);
  }
}

void EventQueue::moveUp(std::size_t i, const Entry& entry) {
  while (i > 0) {
    const std::size_t parent = (i - 1) / kChildren;
    if (!(entry < heap_[parent])) break;
    put(i, heap_[parent]);
    i = parent;
  }
  put(i, entry);
}

void EventQueue::moveDown(std::size_t i, const Entry& entry) {
  for (std::size_t child; (child = kChildren * i + 1) < heap_.size(); i = child) {
    const std::size_t last = std::min(child + kChildren, heap_.size());
    for (std::size_t other = child + 1; other < last; ++other)
      if (heap_[other] < heap_[child]) child = other;
    if (!(heap_[child] < entry)) break;
    put(i, heap_[child]);
  }
  put(i, entry);
}

}  // namespace carom
