// SPDX-License-Identifier: MIT
// Who may speak, and in which order, without a network.
#include "studio/dispatcher.h"

#include <gtest/gtest.h>

#include "studio/gate.h"
#include "studio/proof.h"
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
                           EXPECT_EQ(after, reason.code == 1013 ? std::chrono::milliseconds(0) : Limits().wrong_token);
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

TEST_F(Dispatchers, ProvesThatItKnowsTheToken) {
  const std::string nonce(64, 'a');
  EXPECT_TRUE(say(1, {{"type", "prove"}, {"id", 1}, {"nonce", nonce}}));
  EXPECT_EQ(told[1].at(0), (Json{{"type", "proof"}, {"re", 1}, {"proof", hmacSha256("secret", nonce)}}));
  EXPECT_TRUE(mailbox.isEmpty() && welcomed.empty() && closed.empty()) << "nobody was let in by that";
  EXPECT_TRUE(say(1, {{"type", "hello"}, {"id", 2}, {"protocol", 1}, {"token", "secret"}, {"tab", "t"}}));
  EXPECT_EQ(welcomed, (std::vector<SocketId>{1}));
  say(1, {{"type", "prove"}, {"id", 3}, {"nonce", nonce}});
  EXPECT_EQ(told[1].at(1)["code"], "bad_message");
  say(2, {{"type", "prove"}, {"id", 1}, {"nonce", "short"}});
  EXPECT_EQ(told[2].at(0)["pointer"], "/nonce");
}

TEST_F(Dispatchers, GivesNoProofTooSoon) {
  dispatcher.provesFrom(std::chrono::steady_clock::now() + std::chrono::hours(1));
  say(1, {{"type", "prove"}, {"id", 1}, {"nonce", std::string(64, 'a')}});
  EXPECT_TRUE(told[1].empty());
  EXPECT_EQ(closed[1], 1013);
  hello(2);
  EXPECT_EQ(welcomed, (std::vector<SocketId>{2})) << "a page that was loaded from this server needs none";
}

// FIPS 180-4 and RFC 4231.
TEST(Proof, IsHmacSha256) {
  const auto hash = [](const std::string& text) {
    const auto bytes = sha256(text);
    return hexOf(std::string(bytes.begin(), bytes.end()));
  };
  EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(hash(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(hmacSha256(std::string(20, '\x0b'), "Hi There"),
            "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7");
  EXPECT_EQ(hmacSha256("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(hmacSha256(std::string(131, '\xaa'), "Test Using Larger Than Block-Size Key - Hash Key First"),
            "60e431591ee0b67f0d8a26aacbf5b77f8e0bc6213728c5140546040f0ee37f54");
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
