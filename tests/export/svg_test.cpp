#include <gtest/gtest.h>

#include <regex>

#include "formats/export_svg.h"
#include "tests/export/hand_motion.h"

namespace carom::export_tests {
namespace {

int count(const std::string& text, const std::string& part) {
  int n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

// Every tag is closed in order, attributes are quoted, and no bare < or & stands in text.
void expectWellFormed(const std::string& xml) {
  static const std::regex tag("<(\\?[^<>]*\\?|/?[A-Za-z][\\w]*(?:\\s+[\\w:-]+=\"[^\"<]*\")*\\s*/?)>");
  static const std::regex bare("&(?!(amp|lt|gt|quot|#\\d+);)");
  std::vector<std::string> open;
  std::string text_between;
  std::sregex_iterator it(xml.begin(), xml.end(), tag);
  std::size_t end_of_last = 0;
  for (; it != std::sregex_iterator(); ++it) {
    text_between += xml.substr(end_of_last, static_cast<std::size_t>(it->position()) - end_of_last);
    end_of_last = static_cast<std::size_t>(it->position() + it->length());
    const std::string body = (*it)[1];
    const std::string name = std::regex_replace(body, std::regex("^/|[\\s/].*$"), "");
    if (body.front() == '?' || body.back() == '/') continue;
    if (body.front() != '/') {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << "nothing to close for " << body;
    ASSERT_EQ(body.substr(1), open.back());
    open.pop_back();
  }
  text_between += xml.substr(end_of_last);
  EXPECT_TRUE(open.empty());
  EXPECT_EQ(text_between.find_first_of("<>"), std::string::npos) << text_between.substr(0, 400);
  EXPECT_FALSE(std::regex_search(xml, bare));
}

std::string svgOf(const Document& document, const Motion& motion, const Motion* before = nullptr) {
  const std::string path = temporaryPath("m.svg");
  exportSvg(path, document, motion, before);
  return contentOf(path);
}

TEST(ExportSvg, IsWellFormedAndHoldsNoNan) {
  const Motion motion = handMotion(), before = handMotion(handDocument().scene, 1.2, {});
  const std::string svg = svgOf(handDocument(), motion, &before);
  expectWellFormed(svg);
  EXPECT_FALSE(std::regex_search(svg, std::regex("\\b(nan|inf)\\b", std::regex::icase)));
  EXPECT_NE(svg.find("viewBox=\"0 0 1000 "), std::string::npos);
  EXPECT_NE(svg.find("ball &lt;1&gt;"), std::string::npos);
}

TEST(ExportSvg, EachViewMarksEveryImpactOnce) {
  const Motion motion = handMotion();
  const std::string svg = svgOf(handDocument(), motion);
  const std::size_t side = svg.find("id=\"view-side\""), top = svg.find("id=\"view-top\"");
  ASSERT_NE(side, std::string::npos);
  ASSERT_NE(top, std::string::npos);
  const int events = static_cast<int>(motion.events.size());
  EXPECT_EQ(count(svg.substr(side, top - side), "class=\"impact\""), events);
  EXPECT_EQ(count(svg.substr(top), "class=\"impact\""), events);
}

TEST(ExportSvg, ANailIsAHoopAndAFreeComponentALine) {
  const std::string svg = svgOf(handDocument(), handMotion());
  const std::size_t top = svg.find("id=\"view-top\"");
  // The book's nail is a hoop in both views; of the ball's only x is nailed: a line in both.
  EXPECT_EQ(count(svg.substr(0, top), "class=\"nail\""), 1);
  EXPECT_EQ(count(svg.substr(top), "class=\"nail\""), 1);
  EXPECT_EQ(count(svg, "class=\"nail-line\""), 2);
  EXPECT_EQ(count(svg, "class=\"target-pose\""), 2);
}

TEST(ExportSvg, TheMotionBeforeIsDrawnOnlyWhenGiven) {
  const Motion motion = handMotion();
  EXPECT_EQ(count(svgOf(handDocument(), motion), "class=\"before\""), 0);
  EXPECT_EQ(count(svgOf(handDocument(), motion, &motion), "class=\"before\""), 2);
}

TEST(ExportSvg, ThinAndEmptyMotionsAreDrawnAsWell) {
  Document document = handDocument();
  document.constraints.clear();
  document.scene.bodies.resize(2);
  expectWellFormed(svgOf(document, handMotion(document.scene, 1, {})));  // nothing moves
  document = handDocument();
  expectWellFormed(svgOf(document, handMotion(document.scene, 0, {})));  // no time passes
  document.scene.bodies[2].velocity = {0, 3, 0};
  expectWellFormed(svgOf(document, handMotion(document.scene, 5, {})));  // along y
}

}  // namespace
}  // namespace carom::export_tests
