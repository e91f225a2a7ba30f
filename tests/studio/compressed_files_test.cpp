// SPDX-License-Identifier: MIT
// Pages that are compressed, and who takes them so. That they are the same bytes a browser test says.
#include "studio/compressed_files.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/studio/share_folder.h"

namespace carom::studio {
namespace {

TEST(CompressedFiles, AreTheTextsThatAreWorthIt) {
  const ShareFolder share;
  share.write("page/long.js", std::string(20000, 'a'));
  share.write("page/short.js", "a");
  share.write("gallery/hat.png", std::string(20000, 'a'));
  const PageFiles files(share.path());
  CompressedFiles compressed(files);
  compressed.wait();
  ASSERT_NE(compressed.find("/long.js"), nullptr);
  EXPECT_LT(compressed.find("/long.js")->size(), 200u);
  EXPECT_TRUE(compressed.find("/long.js")->starts_with("\x1f\x8b\x08"));
  for (const char* path : {"/short.js", "/gallery/hat.png", "/none.js", "/index.html", "/"})
    EXPECT_EQ(compressed.find(path), nullptr) << path;
}

TEST(AcceptsGzip, WhereItIsNamedAndNotRefused) {
  for (const char* value : {"gzip", "deflate, gzip", "br,gzip;q=0.5", "*", "gzip; q=1.0", "gzip;q=0.01"})
    EXPECT_TRUE(acceptsGzip({value})) << value;
  for (const char* value : {"", "br", "gzip;q=0", "gzip; q=0.000", "x-gzip", "gzipped", "identity;q=1, *;q=0"})
    EXPECT_FALSE(acceptsGzip({value})) << value;
  EXPECT_FALSE(acceptsGzip({}));
  EXPECT_TRUE(acceptsGzip({"br", "gzip"})) << "in a second field";
}

}  // namespace
}  // namespace carom::studio
