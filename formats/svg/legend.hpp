// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "formats/svg/canvas.hpp"

namespace carom::formats_detail {

/// Kinds of things that are drawn, in the order of the legend. Each is a class of its elements (classOf).
enum class Mark {
  path,
  crowd_path,
  crowd_shade,
  before,
  start,
  end,
  roll,
  slide,
  pivot,
  ride,
  rest,
  ghost,
  crowd_ghost,
  impact,
  impact_cell,
  nail,
  nail_elsewhere,
  nail_line,
  nail_range,
  target_pose,
  avoid,
  inside,
  fixed
};
const char* classOf(Mark mark);

/// Steps of a scale: shades or sizes of one colour, with what each stands for.
struct ScaleStep {
  std::string words;
  double size = 0;     ///< diameter of a dot, px; 0: a shade
  double opacity = 1;  ///< of a shade
};

/// What is explained below the views: layers enter what they draw, when they draw it.
class Legend {
 public:
  struct Entry {
    Mark mark;
    std::string words;
    std::string colour;
    std::string dashes = "none";
    double width = 2.2;                 ///< of a line, px
    std::vector<ScaleStep> scale = {};  ///< behind the words
  };

  /// Enters a mark; one of the same kind and words is entered once.
  void add(Entry entry);
  /// Counts what was left out, by its name in the plural, such as "impact numbers".
  void leaveOut(const std::string& what, int count = 1);
  void merge(const Legend& other);

  double height(double width) const;
  void draw(SvgCanvas& canvas, const Vec2& corner, double width) const;

 private:
  std::vector<Entry> sorted() const;
  std::vector<std::string> leftOutLines(double width) const;
  std::vector<Entry> entries_;
  std::map<std::string, int> left_out_;
};

}  // namespace carom::formats_detail
