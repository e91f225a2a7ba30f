// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "adjoint/motion/motion.h"
#include "formats/base/document.h"

namespace carom::export_tests {

struct SvgElement {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  int parent = -1;

  double number(const std::string& key) const;  ///< fails the test when it is not a finite number
};

struct SvgBox {
  double x = 0, y = 0, width = 0, height = 0;
  std::string words;  ///< of a text
  bool overlaps(const SvgBox& o) const;
  bool holds(const Vec2& p, double slack = 0) const;
};

/// A picture as its elements, in the order of the file. What is not well-formed XML fails the test.
class SvgPicture {
 public:
  explicit SvgPicture(const std::string& xml) { read(xml); }

  const std::vector<SvgElement>& elements() const { return elements_; }
  /// The attribute of an element, or of the nearest around it that has it.
  std::string inherited(int element, const std::string& key) const;
  bool isWithin(int element, const std::string& key, const std::string& value) const;
  /// Elements with a class, or within a group of that class, but for the titles of others; of one view, or of both where none is named.
  std::vector<int> ofClass(const std::string& name, const std::string& view = "") const;

  /// Where texts are, by widths of letters of a common font.
  std::vector<SvgBox> textBoxes() const;
  /// Classes of all that is drawn in the views, and of what the legend explains.
  std::set<std::string> drawnClasses() const, explainedClasses() const;
  SvgBox panel(const std::string& view) const;
  std::string words() const;  ///< all texts, a line each

  /// Pixels of a point of the world in a view, as the numbers of its axes say; `across` and `up` in metres.
  Vec2 pixel(const std::string& view, double across, double up) const;

 private:
  void read(const std::string& xml);
  std::vector<SvgElement> elements_;
};

/// Points of path data, curves taken in `pieces`; in each subpath. All numbers must be finite.
std::vector<std::vector<Vec2>> pathPoints(const std::string& data, int pieces);

/// Draws a motion and reads the picture.
std::string drawnSvg(const Document& document, const Motion& motion, const Motion* before = nullptr);

/// What must be true of every picture: well-formed, finite, at most 500 kB, no two texts on each other, all within the
/// frame, and in the legend just what is drawn.
void expectGoodPicture(const std::string& svg);

}  // namespace carom::export_tests
