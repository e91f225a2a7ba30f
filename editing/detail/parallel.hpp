// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "adjoint/motion/contact_source.h"

/// Work on several cores, with answers that do not depend on how many. Internal to editing/.
namespace carom::editing_detail {

/// Threads that are kept from one batch of tasks to the next: starting them takes longer than many a batch. Both calls
/// return when all tasks are done, and throw what a task has thrown.
class ThreadPool {
 public:
  explicit ThreadPool(int threads);  ///< 0: as many as there are cores
  ~ThreadPool();

  /// Calls work(0) to work(count - 1), in any order.
  void forAll(std::size_t count, const std::function<void(std::size_t)>& work);
  /// The same one after the other, but for `ahead` of them at a time: work(i) begins when all up to work(i - ahead) are done.
  void inOrder(std::size_t count, std::size_t ahead, const std::function<void(std::size_t)>& work);

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;  // null: the caller's alone
};

/// Collision detection for whoever simulates at the moment: sources are independent of each other, and which one a
/// simulation gets makes no difference to it.
class ContactPool {
 public:
  /// `first` is kept by reference, and lent like the others.
  explicit ContactPool(ContactSource& first) : first_(first), free_{{&first, {}}} {}

  /// False where only one simulation can run at a time.
  bool isShareable() const { return first_.another() != nullptr; }

  /// Held for the time of some simulations.
  class Loan {
   public:
    explicit Loan(ContactPool& pool) : pool_(pool), source_(pool.take()) {}
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    ~Loan() { pool_.give(source_); }
    ContactSource& source() const { return *source_; }

   private:
    ContactPool& pool_;
    ContactSource* source_;
  };

 private:
  ContactSource* take();
  void give(ContactSource* source);

  std::mutex mutex_;
  ContactSource& first_;
  std::vector<std::unique_ptr<ContactSource>> made_;
  /// It goes to the thread that had it last, if that comes back: its memory is in the cache of that processor.
  struct Free {
    ContactSource* source;
    std::thread::id last_lent_to;
  };
  std::vector<Free> free_;
};

}  // namespace carom::editing_detail
