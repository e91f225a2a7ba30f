// SPDX-License-Identifier: MIT
#include "studio/mailbox.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/studio/letters.h"

namespace carom::studio {
namespace {

template <class What>
Letter letter(SocketId from, std::int64_t id, What what = {}) {
  return {from, {id, what}};
}
std::int64_t takeId(Mailbox& mailbox) { return mailbox.take({}).value().command.id; }

TEST(Mailbox, KeepsCommandsInOrder) {
  Mailbox mailbox;
  for (std::int64_t id = 1; id <= 5; ++id) mailbox.put(letter<Undo>(1, id));
  for (std::int64_t id = 1; id <= 5; ++id) EXPECT_EQ(takeId(mailbox), id);
  EXPECT_TRUE(mailbox.isEmpty());
}

TEST(Mailbox, KeepsTheNewestDragOfEachSocket) {
  Mailbox mailbox;
  mailbox.put(letter<Grab>(1, 1));
  for (std::int64_t seq = 0; seq < 50; ++seq) mailbox.put(drag(1, seq));
  mailbox.put(drag(2, 7));
  mailbox.put(letter<List>(1, 2));
  mailbox.put(drag(1, 60));
  EXPECT_EQ(takeId(mailbox), 1);
  EXPECT_EQ(takeId(mailbox), 107);
  EXPECT_EQ(takeId(mailbox), 2);
  EXPECT_EQ(takeId(mailbox), 160);
  EXPECT_TRUE(mailbox.isEmpty());
}

TEST(Mailbox, ADragIsLeftOutOnlyWhereNothingIsLostByIt) {
  Release own;
  own.gesture = 1, own.seq = 4, own.place = Vec3::Zero();
  Release bare = own, turned = own, other = own;
  bare.place.reset();
  other.gesture = 2;
  turned.orientation = Quat::Identity();
  const auto kept = [](Letter waiting, Letter next) {
    Mailbox mailbox;
    mailbox.put(std::move(waiting));
    mailbox.put(std::move(next));
    mailbox.take({});
    return !mailbox.isEmpty();
  };
  EXPECT_FALSE(kept(drag(1, 3), letter<Release>(1, 9, own)));
  EXPECT_TRUE(kept(drag(1, 3), letter<Release>(1, 9, bare))) << "it has no target of its own";
  EXPECT_TRUE(kept(drag(1, 4), letter<Release>(1, 9, own))) << "its target is not a newer one";
  EXPECT_TRUE(kept(drag(1, 3), letter<Release>(1, 9, other)));
  EXPECT_TRUE(kept(drag(2, 3), letter<Release>(1, 9, own)));
  EXPECT_TRUE(kept(drag(1, 3), letter<Redo>(1, 9))) << "which is refused while a body is held";
  EXPECT_FALSE(kept(drag(1, 3), letter<Undo>(1, 9)));
  EXPECT_FALSE(kept(drag(1, 3), letter<Cancel>(1, 9, Cancel{1})));
  EXPECT_TRUE(kept(drag(1, 3), letter<Cancel>(1, 9, Cancel{2})));
  EXPECT_FALSE(kept(drag(1, 3), letter<Gone>(1, 0)));
  Letter with_turn = drag(1, 3);
  std::get<Drag>(with_turn.command.what).orientation = Quat::Identity();
  EXPECT_TRUE(kept(with_turn, letter<Release>(1, 9, own))) << "the turn would be lost";
  EXPECT_TRUE(kept(with_turn, drag(1, 4)));
  EXPECT_FALSE(kept(with_turn, letter<Release>(1, 9, turned)));
}

TEST(Mailbox, WorkIsStoppedByCommandsThatChangeSomething) {
  Mailbox mailbox;
  const auto stops = [&](Letter next) {
    while (!mailbox.isEmpty()) mailbox.take({});
    const std::stop_token work = mailbox.beginWork();
    EXPECT_FALSE(work.stop_requested());
    mailbox.put(std::move(next));
    return work.stop_requested();
  };
  EXPECT_TRUE(stops(letter<Stop>(1, 1)));
  EXPECT_TRUE(stops(letter<Grab>(1, 1)));
  EXPECT_TRUE(stops(letter<Undo>(1, 1)));
  EXPECT_TRUE(stops(letter<Open>(1, 1)));
  EXPECT_FALSE(stops(drag(1, 1)));
  EXPECT_FALSE(stops(letter<Save>(1, 1)));
  EXPECT_FALSE(stops(letter<Hello>(1, 1)));
  EXPECT_FALSE(stops(letter<List>(1, 1)));
}

TEST(Mailbox, AHandThatMovesEndsItsRest) {
  Mailbox mailbox;
  const std::stop_token rest = mailbox.beginRest();
  EXPECT_FALSE(rest.stop_requested());
  mailbox.put(drag(1, 1));
  EXPECT_TRUE(rest.stop_requested());
  EXPECT_TRUE(mailbox.beginRest().stop_requested()) << "what waits stops it before it begins";
  EXPECT_FALSE(mailbox.beginWork().stop_requested());
}

TEST(Mailbox, AnUpdateOfADragRunsToItsEndUnlessTheGestureEnds) {
  Mailbox mailbox;
  const std::stop_token update = mailbox.beginDrag();
  mailbox.put(drag(1, 1));
  mailbox.put(letter<Release>(1, 2));
  mailbox.put(letter<Grab>(1, 3));
  EXPECT_FALSE(update.stop_requested());
  mailbox.put(letter<Cancel>(1, 4));
  EXPECT_TRUE(update.stop_requested());
}

TEST(Mailbox, WorkIsStoppedByWhatWaitsAlready) {
  Mailbox mailbox;
  mailbox.put(letter<Stop>(1, 1));
  EXPECT_TRUE(mailbox.beginWork().stop_requested());
}

TEST(Mailbox, ASocketWithManyCommandsIsNotReadUntilThereIsRoom) {
  Mailbox mailbox(3);
  std::vector<SocketId> room;
  mailbox.onRoom([&](SocketId socket) { room.push_back(socket); });
  EXPECT_TRUE(mailbox.put(letter<Undo>(1, 1)));
  EXPECT_TRUE(mailbox.put(letter<Undo>(1, 2)));
  EXPECT_FALSE(mailbox.put(letter<Undo>(1, 3)));
  EXPECT_TRUE(mailbox.put(letter<Undo>(2, 4))) << "others are read on";
  mailbox.take({});
  EXPECT_EQ(room, (std::vector<SocketId>{1}));
  mailbox.take({});
  EXPECT_EQ(room.size(), 1u);
}

TEST(Mailbox, TakeEndsWhereItIsStopped) {
  Mailbox mailbox;
  std::stop_source stop;
  std::thread taker([&] { EXPECT_FALSE(mailbox.take(stop.get_token()).has_value()); });
  stop.request_stop();
  taker.join();
}

TEST(Mailbox, StopAllStopsWhatBeginsLater) {
  Mailbox mailbox;
  const std::stop_token work = mailbox.beginWork();
  mailbox.stopAll();
  EXPECT_TRUE(work.stop_requested());
  EXPECT_TRUE(mailbox.beginRest().stop_requested());
}

}  // namespace
}  // namespace carom::studio
