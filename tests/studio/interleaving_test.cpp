// SPDX-License-Identifier: MIT
// What comes of commands does not depend on when they come: those that wait together come to the same as a plain queue.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

constexpr int kInterleavings = 1000;

/// What the worker makes of commands, as far as targets go.
class Hand {
 public:
  void take(const Letter& letter) {
    std::visit([&](const auto& what) { perform(letter.from, what); }, letter.command.what);
  }
  /// Of every gesture that ended: which, how, and where its hand was last unless everything was put back.
  std::vector<std::string> ends;

 private:
  struct Held {
    SocketId socket;
    std::int64_t gesture, seq = -1;
    Vec3 place = Vec3::Zero();
    std::optional<Quat> orientation = std::nullopt;
  };
  bool holds(SocketId socket, std::int64_t gesture) const {
    return held_ && held_->socket == socket && held_->gesture == gesture;
  }
  void end(const std::string& how) {
    const double turn = held_->orientation ? held_->orientation->w() : -1;
    const std::string hand = how == "release" ? std::to_string(held_->place.x()) + " " + std::to_string(turn) : "";
    ends.push_back(how + " " + std::to_string(held_->socket) + " " + std::to_string(held_->gesture) + " " + hand);
    held_.reset();
  }
  void perform(SocketId from, const Grab& grab) {
    if (held_ && held_->socket != from) return;
    if (held_) end("cancel");
    held_ = Held{from, grab.gesture};
  }
  void perform(SocketId from, const Drag& drag) {
    if (!holds(from, drag.gesture)) return;
    held_->place = drag.place, held_->seq = drag.seq;
    if (drag.orientation) held_->orientation = drag.orientation;
  }
  void perform(SocketId from, const Release& release) {
    if (!holds(from, release.gesture)) return;
    if (release.place && release.seq > held_->seq) {
      held_->place = *release.place;
      if (release.orientation) held_->orientation = release.orientation;
    }
    end("release");
  }
  void perform(SocketId from, const Cancel& cancel) {
    if (holds(from, cancel.gesture)) end("cancel");
  }
  void perform(SocketId from, const Undo&) {
    if (held_ && held_->socket == from) end("cancel");
  }
  void perform(SocketId from, const Gone&) {
    if (held_ && held_->socket == from) end("cancel");
  }
  template <class Other>
  void perform(SocketId, const Other&) {}

  std::optional<Held> held_;
};

/// Commands of two pages: gestures, well formed or not, and what else may come between.
std::vector<Letter> randomLetters(std::mt19937_64& random) {
  const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<Letter> letters;
  std::int64_t id = 0, gesture[2] = {0, 0}, seq[2] = {0, 0};
  for (int k = 0; k < 40; ++k) {
    const int page = pick(4) == 0 ? 1 : 0;
    std::int64_t& g = gesture[page];
    const auto add = [&](auto what) { letters.push_back({SocketId(page + 1), {++id, std::move(what)}}); };
    const Vec3 place(1 + 0.001 * static_cast<double>(id), 0, 0);
    const Quat turn(0.5 + 1e-3 * static_cast<double>(id), 0, 0, 0);
    const bool turns = pick(3) == 0;
    const std::optional<Quat> orientation = turns ? std::optional(turn) : std::nullopt;
    switch (pick(12)) {
      case 0:
      case 1:
        ++g, seq[page] = 0;
        add(Grab{g, "ball", 0.3, {}, "", false});
        break;
      case 2: {
        const std::optional<Vec3> last = pick(2) == 0 ? std::optional(place) : std::nullopt;
        add(Release{g, seq[page] + pick(2), last, last ? orientation : std::nullopt, false});
        break;
      }
      case 3: {
        constexpr int kKinds = 7;
        switch (pick(kKinds)) {
          case 0:
            add(Cancel{g - pick(2)});
            break;
          case 1:
            add(Undo{});
            break;
          case 2:
            add(Redo{});
            break;
          case 3:
            add(Stop{});
            break;
          case 4:
            add(List{});
            break;
          case 5:
            add(Save{});
            break;
          default:
            add(Gone{});
        }
        break;
      }
      default:
        add(Drag{g - (pick(10) == 0 ? 1 : 0), ++seq[page], place, orientation});
    }
  }
  return letters;
}

TEST(Interleavings, WhatWaitsTogetherComesToTheSameAsAPlainQueue) {
  int ends = 0;
  for (unsigned seed = 1; seed <= kInterleavings; ++seed) {
    std::mt19937_64 random(seed);
    const std::vector<Letter> letters = randomLetters(random);
    Hand plain, batched;
    for (const Letter& letter : letters) plain.take(letter);
    Mailbox mailbox;
    for (const Letter& letter : letters) {
      mailbox.put(letter);
      while (!mailbox.isEmpty() && random() % 3 == 0) batched.take(*mailbox.take({}));
    }
    while (!mailbox.isEmpty()) batched.take(*mailbox.take({}));
    ASSERT_EQ(batched.ends, plain.ends) << "seed " << seed;
    ends += static_cast<int>(plain.ends.size());
  }
  EXPECT_GT(ends, 3 * kInterleavings);
}

/// The velocity with which the ball of the test scene is at (x, 0, z) after 0.3 s.
Vec3 velocityTo(double x, double z) { return {x / 0.3, 0, (z - 1) / 0.3 + 0.5 * 9.81 * 0.3}; }

TEST(Interleavings, AReleaseEndsWhereTheHandWasHoweverItsMessagesCome) {
  WorkerTest test;
  test.hello(1);
  test.worker->step({});
  for (unsigned seed = 1; seed <= kInterleavings; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> across(0.2, 0.7), up(0.9, 1.4);
    Json grab = kGrab;
    grab["gesture"] = seed;
    test.send(1, grab);
    const auto maybeWork = [&] {
      while (!test.mailbox.isEmpty() && random() % 3 == 0) test.worker->step({});
    };
    double x = 0, z = 0;
    const int drags = 1 + static_cast<int>(random() % 3);
    for (int seq = 1; seq <= drags; ++seq) {
      maybeWork();
      x = across(random), z = up(random);
      Json drag = dragTo(seq, x, z);
      drag["gesture"] = seed;
      test.send(1, drag);
    }
    maybeWork();
    Json release = {{"type", "release"}, {"gesture", seed}, {"seq", drags}};
    // as pages send it: the target again, a newer one, or none of its own
    if (const auto kind = random() % 3; kind > 0) {
      if (kind == 2) x = across(random), z = up(random), release["seq"] = drags + 1;
      release["place"] = {x, 0, z};
    }
    const std::int64_t asked = test.send(1, release);
    if (random() % 2 == 0) test.send(1, {{"type", "list"}});
    while (!test.mailbox.isEmpty()) test.worker->step({});
    const std::vector<Json> got = test.received.take(1);
    const auto answer = std::find_if(got.begin(), got.end(), isType("motion", asked));
    ASSERT_NE(answer, got.end()) << "seed " << seed;
    EXPECT_TRUE((*answer)["reached"]) << "seed " << seed;
    const Json numbers = lastOf(got, "state")["numbers"];
    const Vec3 wanted = velocityTo(x, z);
    for (int k = 0; k < 3; ++k) {
      const double error = std::abs(numbers[static_cast<std::size_t>(k)]["now"].get<double>() - wanted[k]);
      ASSERT_TRUE(error <= 1e-6) << "seed " << seed << ", component " << k << ": " << error;
    }
  }
}

}  // namespace
}  // namespace carom::studio
