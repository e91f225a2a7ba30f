// SPDX-License-Identifier: MIT
// Writers and a taker of the mailbox at once; also for the thread sanitizer.
#include "studio/mailbox.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <thread>

#include "tests/studio/letters.h"

namespace carom::studio {
namespace {

// Every command arrives once, in the order of its socket.
TEST(Mailbox, ServesManyThreads) {
  constexpr std::int64_t kEach = 2000;
  Mailbox mailbox(64);
  std::vector<std::thread> writers;
  for (SocketId from = 1; from <= 3; ++from)
    writers.emplace_back([&mailbox, from] {
      for (std::int64_t id = 1; id <= kEach; ++id) {
        mailbox.put({from, {id, List{}}});
        mailbox.put(drag(from, id));
      }
    });
  std::array<std::int64_t, 4> last{};
  std::array<std::int64_t, 4> seq{};
  for (std::int64_t lists = 0; lists < 3 * kEach;) {
    const Letter next = mailbox.take({}).value();
    mailbox.beginRest();
    if (const Drag* d = std::get_if<Drag>(&next.command.what)) {
      EXPECT_GT(d->seq, seq[next.from]);
      seq[next.from] = d->seq;
      continue;
    }
    EXPECT_EQ(next.command.id, last[next.from] + 1);
    last[next.from] = next.command.id;
    ++lists;
  }
  for (std::thread& writer : writers) writer.join();
}

// What is put stops what is done at the same time, and whoever was told to wait is told when there is room.
TEST(Mailbox, StopsWorkAndTellsOfRoomFromAnotherThread) {
  constexpr int kCommands = 300;
  Mailbox mailbox(2);
  std::atomic<bool> room = true;
  mailbox.onRoom([&](SocketId) {
    room = true;
    room.notify_one();
  });
  std::thread writer([&] {
    for (std::int64_t id = 1; id <= kCommands; ++id) {
      room.wait(false);
      room = false;
      if (mailbox.put({1, {id, Undo{}}})) room = true;
    }
  });
  for (std::int64_t id = 1; id <= kCommands; ++id) {
    EXPECT_EQ(mailbox.take({}).value().command.id, id);
    const std::stop_token work = mailbox.beginWork(), rest = mailbox.beginRest(), drag = mailbox.beginDrag();
    if (id == kCommands) break;
    std::atomic<bool> stopped = false;
    const std::stop_callback at_stop(work, [&] {
      stopped = true;
      stopped.notify_one();
    });
    stopped.wait(false);  // the next command comes
    EXPECT_FALSE(mailbox.isEmpty());
    EXPECT_TRUE(work.stop_requested() && rest.stop_requested() && drag.stop_requested());
  }
  writer.join();
  EXPECT_TRUE(mailbox.isEmpty());
}

}  // namespace
}  // namespace carom::studio
