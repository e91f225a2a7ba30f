// SPDX-License-Identifier: MIT
#include "studio/gate.h"

#include <gtest/gtest.h>

namespace carom::studio {
namespace {

constexpr unsigned short kPort = 4711;

Request page() { return {"GET", "/main.js", {"127.0.0.1:4711"}, {}, false, false}; }
Request socket() { return {"GET", "/socket", {"127.0.0.1:4711"}, {"http://127.0.0.1:4711"}, true, false}; }
int statusOf(const Request& request) { return judge(request, kPort).status; }

TEST(Gate, LetsInThePagesOfThisServer) {
  EXPECT_EQ(statusOf(page()), 200);
  EXPECT_EQ(statusOf(socket()), 200);
  Request local = socket();
  local.hosts = {"localhost:4711"}, local.origins = {"http://localhost:4711"};
  EXPECT_EQ(statusOf(local), 200);
  Request head = page();
  head.method = "HEAD";
  EXPECT_EQ(statusOf(head), 200);
}

TEST(Gate, RefusesEveryOtherHost) {
  for (const std::vector<std::string>& hosts :
       {std::vector<std::string>{}, {""}, {"127.0.0.1"}, {"127.0.0.1:4712"}, {"evil.example:4711"}, {"LOCALHOST:4711"},
        {"127.0.0.1:4711", "127.0.0.1:4711"}, {"127.0.0.1:04711"}, {"[::1]:4711"}, {" 127.0.0.1:4711"}}) {
    Request request = page();
    request.hosts = hosts;
    EXPECT_EQ(statusOf(request), 403) << (hosts.empty() ? "none" : hosts[0]);
    Request upgrade = socket();
    upgrade.hosts = hosts;
    EXPECT_EQ(statusOf(upgrade), 403) << (hosts.empty() ? "none" : hosts[0]);
  }
}

TEST(Gate, RefusesEveryOtherOriginOfASocket) {
  for (const std::vector<std::string>& origins :
       {std::vector<std::string>{}, {"null"}, {"http://evil.example"}, {"https://127.0.0.1:4711"}, {"http://127.0.0.1"},
        {"http://localhost:4711"}, {"http://127.0.0.1:4711/"}, {"http://127.0.0.1:4711", "http://127.0.0.1:4711"}}) {
    Request request = socket();
    request.origins = origins;
    EXPECT_EQ(statusOf(request), 403) << (origins.empty() ? "none" : origins[0]);
  }
}

TEST(Gate, RefusesOtherMethodsAndBodies) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "get", "TRACE", ""}) {
    Request request = page();
    request.method = method;
    EXPECT_EQ(statusOf(request), 405) << method;
  }
  Request body = page();
  body.body = true;
  EXPECT_EQ(statusOf(body), 400);
}

TEST(Gate, APathEndsBeforeTheQuery) {
  EXPECT_EQ(pathOf("/a.js?quality=low?x"), "/a.js");
  EXPECT_EQ(pathOf("/"), "/");
  EXPECT_EQ(pathOf("?"), "");
}

TEST(Gate, TokensAreLongAndNeverTheSame) {
  const std::string a = newToken(), b = newToken();
  EXPECT_EQ(a.size(), 64u);
  EXPECT_EQ(a.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(a, b);
  EXPECT_TRUE(sameToken(a, a));
  EXPECT_FALSE(sameToken(a, b));
  EXPECT_FALSE(sameToken("", a));
  EXPECT_FALSE(sameToken(a.substr(1), a));
  EXPECT_FALSE(sameToken(a + "0", a));
  std::string last = a;
  last.back() = last.back() == '0' ? '1' : '0';
  EXPECT_FALSE(sameToken(last, a));
}

TEST(Gate, ThePolicyAllowsWhatThePageNeedsAndNoMore) {
  const auto policyOf = [](const std::string& nonce) {
    for (const auto& [name, value] : securityHeaders(nonce))
      if (name == "Content-Security-Policy") return value;
    return std::string();
  };
  EXPECT_TRUE(policyOf("").starts_with("default-src 'none'; script-src 'self'; "));
  EXPECT_NE(policyOf("abc").find("script-src 'self' 'nonce-abc';"), std::string::npos);
  for (const char* part : {"connect-src 'self'", "frame-ancestors 'none'", "base-uri 'none'", "form-action 'none'"})
    EXPECT_NE(policyOf("").find(part), std::string::npos) << part;
  EXPECT_EQ(policyOf("abc").find("unsafe"), std::string::npos);
}

}  // namespace
}  // namespace carom::studio
