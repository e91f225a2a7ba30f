// SPDX-License-Identifier: MIT
#include "studio/page_files.h"

#include <gtest/gtest.h>

#include "adjoint/base/errors.h"
#include "tests/studio/share_folder.h"

namespace carom::studio {
namespace {

TEST(PageFiles, AreFoundByExactNamesAlone) {
  const ShareFolder share;
  share.write("page/view/view.js", "view");
  share.write("page/node_modules/other/secret.js", "no");
  share.write("page/tests/a.js", "no");
  share.write("page/.hidden.js", "no");
  share.write("page/package.json", "no");
  share.write("gallery/hat.svg", "<svg/>");
  const PageFiles files(share.path());
  ASSERT_NE(files.find("/"), nullptr);
  EXPECT_EQ(files.find("/"), files.find("/index.html"));
  ASSERT_NE(files.find("/view/view.js"), nullptr);
  EXPECT_EQ(files.find("/view/view.js")->content, "view");
  EXPECT_EQ(files.find("/view/view.js")->type, "text/javascript; charset=utf-8");
  ASSERT_NE(files.find("/three/build/three.module.js"), nullptr);
  ASSERT_NE(files.find("/gallery/hat.svg"), nullptr);
  EXPECT_EQ(files.find("/gallery/hat.svg")->type, "image/svg+xml");
  for (const char* path : {"", "index.html", "//index.html", "/view/../index.html", "/view", "/view/", "/%69ndex.html",
                           "/INDEX.HTML", "/package.json", "/node_modules/other/secret.js", "/tests/a.js",
                           "/.hidden.js", "/../secret", "/view/view.js/", "/etc/passwd"})
    EXPECT_EQ(files.find(path), nullptr) << path;
}

TEST(PageFiles, HoldWhatWasThereAtTheStart) {
  const ShareFolder share;
  const PageFiles files(share.path());
  share.write("page/index.html", "changed");
  share.write("page/late.js", "late");
  EXPECT_EQ(files.find("/")->content, ShareFolder::kIndex);
  EXPECT_EQ(files.find("/late.js"), nullptr);
}

TEST(PageFiles, APageMayAskForANonce) {
  const ShareFolder share;
  const PageFiles files(share.path());
  ASSERT_TRUE(files.find("/")->asksForNonce());
  const std::string text = files.find("/")->withNonce("0123abcd");
  EXPECT_EQ(text.find("{{nonce}}"), std::string::npos);
  EXPECT_NE(text.find("<script nonce=\"0123abcd\">"), std::string::npos);
  EXPECT_NE(text.find("<style nonce=\"0123abcd\">"), std::string::npos);
  EXPECT_FALSE(files.find("/main.js")->asksForNonce());
}

TEST(PageFiles, SayWhatToRunWithoutThree) {
  const ShareFolder share;
  share.remove("three/build/three.core.js");
  try {
    const PageFiles files(share.path());
    FAIL() << "nothing was missed";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("three.js is not installed"), std::string::npos) << text;
    EXPECT_NE(text.find("scripts/setup studio"), std::string::npos) << text;
  }
  EXPECT_THROW(PageFiles("/nowhere"), InputError);
}

}  // namespace
}  // namespace carom::studio
