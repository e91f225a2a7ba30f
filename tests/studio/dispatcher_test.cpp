// SPDX-License-Identifier: MIT
// Who may speak, and in which order, without a network.
#include "studio/dispatcher.h"

#include <gtest/gtest.h>

#include "tests/studio/pages.h"

namespace carom::studio {
namespace {

struct Dispatchers : testing::Test {
  Mailbox mailbox{3};
  std::map<SocketId, std::vector<Json>> told;
  std::map<SocketId, int> closed;
  std::vector<SocketId> welcomed;
  Dispatcher dispatcher{mailbox,
                        "secret",
                        Limits(),
                        {[this](SocketId to, const std::string& text) { told[to].push_back(Json::parse(text)); },
                         [this](SocketId socket) { welcomed.push_back(socket); },
                         [this](SocketId socket, const CloseReason& reason, std::chrono::milliseconds after) {
                           EXPECT_EQ(after, Limits().wrong_token);
                           closed[socket] = reason.code;
                         }}};

  bool say(SocketId from, Json message) { return dispatcher.message(from, message.dump()); }
  bool hello(SocketId from, const char* token = "secret", int protocol = 1) {
    return say(from, {{"type", "hello"}, {"id", 1}, {"protocol", protocol}, {"token", token}, {"tab", "t"}});
  }
};

TEST_F(Dispatchers, HelloComesFirst) {
  EXPECT_TRUE(say(1, {{"type", "undo"}, {"id", 1}}));
  EXPECT_EQ(told[1].at(0)["code"], "unauthorized");
  EXPECT_EQ(closed[1], 4401);
  hello(1);
  EXPECT_TRUE(mailbox.isEmpty()) << "no second try";
  EXPECT_EQ(told[1].size(), 1u) << "and no answer";
  hello(2);
  say(2, {{"type", "undo"}, {"id", 2}});
  EXPECT_EQ(welcomed, (std::vector<SocketId>{2}));
  EXPECT_TRUE(std::holds_alternative<Hello>(mailbox.take({})->command.what));
  EXPECT_TRUE(std::holds_alternative<Undo>(mailbox.take({})->command.what));
  hello(2);
  EXPECT_EQ(told[2].at(0)["code"], "bad_message");
}

TEST_F(Dispatchers, TokenAndProtocolAreChecked) {
  for (const char* token : {"", "secre", "secreT", "secret ", "secret0"}) {
    hello(1, token);
    EXPECT_EQ(closed[1], 4401) << token;
    dispatcher.gone(1);
    closed.clear();
  }
  hello(2, "secret", 2);
  EXPECT_EQ(closed[2], 4400);
  EXPECT_TRUE(welcomed.empty() && mailbox.isEmpty());
}

TEST_F(Dispatchers, BadMessagesAreAnsweredAndGoNoFurther) {
  hello(1);
  mailbox.take({});
  EXPECT_TRUE(dispatcher.message(1, "{"));
  EXPECT_TRUE(say(1, {{"type", "nail_on"}, {"id", 5}, {"nail", 0}, {"on", 1}}));
  ASSERT_EQ(told[1].size(), 2u);
  EXPECT_FALSE(told[1][0].contains("re"));
  EXPECT_EQ(told[1][1]["re"], 5);
  EXPECT_EQ(told[1][1]["pointer"], "/on");
  EXPECT_TRUE(mailbox.isEmpty());
}

TEST_F(Dispatchers, NumbersIncrease) {
  hello(1);
  say(1, {{"type", "undo"}, {"id", 8}});
  say(1, {{"type", "redo"}, {"id", 8}});
  EXPECT_EQ(told[1].at(0)["pointer"], "/id");
  EXPECT_EQ(told[1].at(0)["message"], "found 8, expected more than 8, the number of the message before");
  mailbox.take({});
  EXPECT_TRUE(std::holds_alternative<Undo>(mailbox.take({})->command.what));
  EXPECT_TRUE(mailbox.isEmpty());
  hello(2);
  EXPECT_TRUE(say(2, {{"type", "undo"}, {"id", 2}})) << "each socket has its own";
  EXPECT_TRUE(told[2].empty());
}

TEST_F(Dispatchers, ASocketWithManyCommandsIsNotRead) {
  EXPECT_TRUE(hello(1));
  EXPECT_TRUE(say(1, {{"type", "undo"}, {"id", 2}}));
  EXPECT_FALSE(say(1, {{"type", "undo"}, {"id", 3}}));
}

TEST_F(Dispatchers, WhoGoesIsToldToTheWorkerWhereItWasLetIn) {
  hello(1);
  mailbox.take({});
  dispatcher.gone(1);
  EXPECT_TRUE(std::holds_alternative<Gone>(mailbox.take({})->command.what));
  dispatcher.gone(2);
  EXPECT_TRUE(mailbox.isEmpty());
}

}  // namespace
}  // namespace carom::studio
