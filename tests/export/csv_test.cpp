// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <sstream>

#include "adjoint/base/errors.h"
#include "formats/export/export_motion.h"
#include "tests/export/hand_motion.h"

namespace carom::export_tests {
namespace {

using Cells = std::vector<std::string>;

std::vector<Cells> rowsOf(const std::string& text) {
  std::vector<Cells> rows;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    Cells cells;
    std::istringstream cell_in(line);
    for (std::string cell; std::getline(cell_in, cell, ',');) cells.push_back(cell);
    rows.push_back(cells);
  }
  return rows;
}

BodyState expected(const Motion& motion, const Cells& row) {
  const int body = bodyIndex(*motion.scene, row[1]);
  if (row[2] == "before") return motion.stateBefore(std::stoi(row[3]) - 1, body);
  return motion.stateAt(body, std::stod(row[0]));
}

TEST(ExportCsv, EveryNumberIsReadBackExactly) {
  const Motion motion = handMotion();
  const std::string path = temporaryPath("m.csv");
  exportMotion(path, handDocument(), motion, {.csv_rate = 50});
  const auto rows = rowsOf(contentOf(path));
  ASSERT_GT(rows.size(), 100u);
  ASSERT_EQ(rows[0].size(), 18u);
  EXPECT_EQ(rows[0][0], "time [s]");
  double last = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const Cells& row = rows[i];
    ASSERT_EQ(row.size(), 18u) << i;
    EXPECT_GE(std::stod(row[0]), last);
    last = std::stod(row[0]);
    const BodyState s = expected(motion, row);
    const double numbers[] = {s.position.x(),        s.position.y(),    s.position.z(),         s.orientation.w(),
                              s.orientation.x(),     s.orientation.y(), s.orientation.z(),      s.velocity.x(),
                              s.velocity.y(),        s.velocity.z(),    s.angular_velocity.x(), s.angular_velocity.y(),
                              s.angular_velocity.z()};
    for (std::size_t k = 0; k < 13; ++k) EXPECT_EQ(std::stod(row[4 + k]), numbers[k]) << "row " << i << " cell " << k;
    EXPECT_EQ(row[17], "flight");
  }
  EXPECT_EQ(last, motion.end);
}

TEST(ExportCsv, EachImpactHasOneRowBeforeAndOneAfter) {
  const Motion motion = handMotion();
  const std::string path = temporaryPath("m.csv");
  exportMotion(path, handDocument(), motion);
  std::map<std::string, int> seen;
  for (const Cells& row : rowsOf(contentOf(path)))
    if (row.size() > 3 && !row[3].empty()) ++seen[row[2] + row[3]];
  for (int e = 1; e <= static_cast<int>(motion.events.size()); ++e) {
    EXPECT_EQ(seen["before" + std::to_string(e)], 1) << e;
    EXPECT_EQ(seen["after" + std::to_string(e)], 1) << e;
  }
}

TEST(ExportCsv, NamesWithCommasAndQuotesAreQuoted) {
  Document document = handDocument();
  document.scene.bodies[4].name = "a, \"b\"";
  const std::string path = temporaryPath("m.csv");
  exportMotion(path, document, handMotion(document.scene, 0.1, {}));
  EXPECT_NE(contentOf(path).find(",\"a, \"\"b\"\"\",sample,"), std::string::npos);
}

TEST(ExportCsv, RefusesARateThatIsNoRate) {
  for (const double rate : {0.0, -1.0, std::nan(""), 1e300})
    EXPECT_THROW(exportMotion(temporaryPath("m.csv"), handDocument(), handMotion(), {.csv_rate = rate}), InputError)
        << rate;
  EXPECT_FALSE(std::filesystem::exists(temporaryPath("m.csv")));
}

}  // namespace
}  // namespace carom::export_tests
