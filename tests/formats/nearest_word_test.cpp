// SPDX-License-Identifier: MIT
#include "formats/base/nearest_word.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace carom {

using namespace formats_detail;

namespace {

const std::vector<std::string> kWords{"position", "orientation", "velocity", "angular_velocity", "mass", "max", "min"};

TEST(NearestWord, slipsOfThePen) {
  const std::vector<std::pair<std::string, std::string>> slips = {
      {"posiiton", "position"},                 // two letters swapped
      {"postion", "position"},                  // one left out
      {"velocityy", "velocity"},                // one too many
      {"velosity", "velocity"},                 // another one
      {"Mass", "mass"},                         // case
      {"angular_velocty", "angular_velocity"},  // longer words may have more
      {"angular-velocty", "angular_velocity"},
      {"mx", "max"},
      {"angular", "angular_velocity"},  // a beginning
      {"positions_of_all", "position"},
  };
  for (const auto& [word, meant] : slips) {
    const std::optional<std::string> nearest = nearestWord(word, kWords);
    EXPECT_EQ(nearest.value_or("nothing"), meant) << word;
  }
}

TEST(NearestWord, otherWordsAreNoSlips) {
  for (const std::string word : {"colour", "", "x", "po", "spin", "vel", "gravity"})
    EXPECT_FALSE(nearestWord(word, kWords)) << word << " taken for " << *nearestWord(word, kWords);
  EXPECT_FALSE(nearestWord("position", std::vector<std::string>{}));
  EXPECT_FALSE(nearestWord(std::string(100000, 'm'), kWords));
  EXPECT_FALSE(nearestWord("mass", std::vector<std::string>{std::string(100000, 'm')}));
}

TEST(NearestWord, theFirstOfTwoAsNear) {
  EXPECT_EQ(nearestWord("mux", std::vector<std::string>{"mix", "max"}).value_or(""), "mix");
  EXPECT_EQ(nearestWord("max", kWords).value_or(""), "max");
}

}  // namespace
}  // namespace carom
