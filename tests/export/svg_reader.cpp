// SPDX-License-Identifier: MIT
#include "tests/export/svg_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "formats/export/export_motion.h"
#include "formats/svg/export_svg.h"
#include "tests/export/hand_motion.h"

namespace carom::export_tests {
namespace {

// Widths in a sans-serif font, in shares of its size.
double letterWidth(char c) {
  if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) return 0;
  if (std::strchr("ijl'|", c)) return 0.23;
  if (std::strchr(".,:;!()[]ftrI/ -", c)) return 0.30;
  if (std::strchr("mMW%@w", c)) return 0.85;
  if (c >= 'A' && c <= 'Z') return 0.70;
  return 0.55;
}

std::string unescaped(std::string text) {
  for (const auto& [name, letter] : {std::pair{"&lt;", "<"}, {"&gt;", ">"}, {"&quot;", "\""}, {"&amp;", "&"}})
    for (std::size_t at = 0; (at = text.find(name, at)) != std::string::npos; ++at)
      text.replace(at, std::strlen(name), letter);
  return text;
}

bool hasBareAmpersand(const std::string& text) {
  for (std::size_t at = 0; (at = text.find('&', at)) != std::string::npos; ++at) {
    const std::string rest = text.substr(at, 6);
    if (rest.rfind("&lt;", 0) != 0 && rest.rfind("&gt;", 0) != 0 && rest.rfind("&amp;", 0) != 0 && rest != "&quot;")
      return true;
  }
  return false;
}

// A tag without its brackets: name and attributes.
SvgElement readTag(const std::string& tag) {
  SvgElement element;
  std::size_t at = tag.find_first_of(" /");
  element.name = tag.substr(0, at);
  while (at != std::string::npos && (at = tag.find_first_not_of(" /", at)) != std::string::npos) {
    const std::size_t equals = tag.find("=\"", at), end = equals == std::string::npos ? equals : tag.find('"', equals + 2);
    if (end == std::string::npos) {
      ADD_FAILURE() << "attribute without quotes: " << tag;
      break;
    }
    const std::string key = tag.substr(at, equals - at), value = tag.substr(equals + 2, end - equals - 2);
    EXPECT_FALSE(key.empty() || element.attributes.contains(key)) << tag;
    EXPECT_FALSE(hasBareAmpersand(value) || value.find('<') != std::string::npos) << tag;
    element.attributes[key] = unescaped(value);
    at = end + 1;
  }
  return element;
}

}  // namespace

double SvgElement::number(const std::string& key) const {
  const auto found = attributes.find(key);
  if (found == attributes.end()) {
    ADD_FAILURE() << name << " has no " << key;
    return NAN;
  }
  char* end = nullptr;
  const double value = std::strtod(found->second.c_str(), &end);
  EXPECT_TRUE(*end == 0 && !found->second.empty() && std::isfinite(value)) << name << " " << key << " " << found->second;
  return value;
}

bool SvgBox::overlaps(const SvgBox& o) const {
  return o.x < x + width && x < o.x + o.width && o.y < y + height && y < o.y + o.height;
}

bool SvgBox::holds(const Vec2& p, double slack) const {
  return p.x() >= x - slack && p.y() >= y - slack && p.x() <= x + width + slack && p.y() <= y + height + slack;
}

void SvgPicture::read(const std::string& xml) {
  std::vector<int> open;
  std::size_t at = 0;
  while (at < xml.size()) {
    const std::size_t tag = xml.find('<', at);
    const std::string between = xml.substr(at, tag == std::string::npos ? tag : tag - at);
    EXPECT_FALSE(hasBareAmpersand(between) || between.find('>') != std::string::npos) << between;
    if (!open.empty()) elements_[static_cast<std::size_t>(open.back())].text += unescaped(between);
    if (tag == std::string::npos) break;
    const std::size_t end = xml.find('>', tag);
    ASSERT_NE(end, std::string::npos) << "a tag without end";
    const std::string inner = xml.substr(tag + 1, end - tag - 1);
    at = end + 1;
    if (inner.front() == '?') continue;
    if (inner.front() == '/') {
      ASSERT_FALSE(open.empty());
      ASSERT_EQ(inner.substr(1), elements_[static_cast<std::size_t>(open.back())].name);
      open.pop_back();
      continue;
    }
    SvgElement element = readTag(inner);
    element.parent = open.empty() ? -1 : open.back();
    if (inner.back() != '/') open.push_back(static_cast<int>(elements_.size()));
    elements_.push_back(std::move(element));
  }
  EXPECT_TRUE(open.empty());
}

std::string SvgPicture::inherited(int element, const std::string& key) const {
  for (int i = element; i >= 0; i = elements_[static_cast<std::size_t>(i)].parent) {
    const auto& attributes = elements_[static_cast<std::size_t>(i)].attributes;
    if (const auto found = attributes.find(key); found != attributes.end()) return found->second;
  }
  return "";
}

bool SvgPicture::isWithin(int element, const std::string& key, const std::string& value) const {
  for (int i = element; i >= 0; i = elements_[static_cast<std::size_t>(i)].parent) {
    const auto& attributes = elements_[static_cast<std::size_t>(i)].attributes;
    if (const auto found = attributes.find(key); found != attributes.end() && found->second == value) return true;
  }
  return false;
}

std::vector<int> SvgPicture::ofClass(const std::string& name, const std::string& view) const {
  std::vector<int> out;
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i)
    if (const std::string& kind = elements_[static_cast<std::size_t>(i)].name;
        kind != "g" && kind != "title" && isWithin(i, "class", name) && (view.empty() || isWithin(i, "id", "view-" + view)))
      out.push_back(i);
  return out;
}

std::vector<SvgBox> SvgPicture::textBoxes() const {
  std::vector<SvgBox> boxes;
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) {
    const SvgElement& element = elements_[static_cast<std::size_t>(i)];
    if (element.name != "text") continue;
    const double size = std::stod(inherited(i, "font-size"));
    double width = 0;
    for (const char c : element.text) width += size * letterWidth(c);
    if (!inherited(i, "font-weight").empty()) width *= 1.06;
    const std::string anchor = inherited(i, "text-anchor");
    const double x = element.number("x"), y = element.number("y");
    const double left = anchor == "end" ? width : anchor == "middle" ? 0.5 * width : 0;
    SvgBox box{x - left, y - 0.74 * size, width, 0.94 * size, element.text};
    if (element.attributes.contains("transform"))  // by a quarter turn about (x, y)
      box = {x - 0.74 * size, y - left, 0.94 * size, width, element.text};
    boxes.push_back(box);
  }
  return boxes;
}

std::set<std::string> SvgPicture::drawnClasses() const {
  std::set<std::string> out;
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i)
    if (isWithin(i, "id", "view-side") || isWithin(i, "id", "view-top")) {
      const SvgElement& element = elements_[static_cast<std::size_t>(i)];
      const bool is_group = element.name == "g";
      for (int k = i; k >= 0 && !is_group; k = elements_[static_cast<std::size_t>(k)].parent)
        if (const auto& own = elements_[static_cast<std::size_t>(k)].attributes; own.contains("class")) {
          out.insert(own.at("class"));
          break;
        }
    }
  for (const char* not_a_mark : {"axes", "labels", "leader", "rim"}) out.erase(not_a_mark);
  return out;
}

std::set<std::string> SvgPicture::explainedClasses() const {
  std::set<std::string> out;
  for (const SvgElement& element : elements_)
    if (const auto found = element.attributes.find("data-mark"); found != element.attributes.end())
      out.insert(found->second);
  return out;
}

SvgBox SvgPicture::panel(const std::string& view) const {
  for (int i = 0; i < static_cast<int>(elements_.size()); ++i) {
    const SvgElement& e = elements_[static_cast<std::size_t>(i)];
    if (e.name == "rect" && isWithin(i, "id", "clip-" + view))
      return {e.number("x"), e.number("y"), e.number("width"), e.number("height"), view};
  }
  ADD_FAILURE() << "no panel " << view;
  return {};
}

std::string SvgPicture::words() const {
  std::string out;
  for (const SvgElement& element : elements_)
    if (element.name == "text") out += element.text + "\n";
  return out;
}

Vec2 SvgPicture::pixel(const std::string& view, double across, double up) const {
  std::vector<std::pair<double, double>> ticks[2];  // world, pixel
  for (const int i : ofClass("axes", view)) {
    const SvgElement& e = elements_[static_cast<std::size_t>(i)];
    if (e.name != "text" || e.attributes.contains("font-weight")) continue;
    const bool is_across = inherited(i, "text-anchor") == "middle";
    ticks[is_across ? 0 : 1].emplace_back(std::stod(e.text), is_across ? e.number("x") : e.number("y") - 4);
  }
  const auto at = [](const auto& list, double value) {
    const auto [a, x] = list.front();
    const auto [b, y] = list.back();
    return x + (value - a) / (b - a) * (y - x);
  };
  return {at(ticks[0], across), at(ticks[1], up)};
}

std::vector<std::vector<Vec2>> pathPoints(const std::string& data, int pieces) {
  std::vector<std::vector<Vec2>> out;
  std::size_t at = 0;
  char command = 0;
  const auto number = [&] {
    while (at < data.size() && (data[at] == ' ' || data[at] == ',')) ++at;
    std::size_t used = 0;
    const double value = at < data.size() ? std::stod(data.substr(at, 24), &used) : NAN;
    EXPECT_TRUE(std::isfinite(value)) << data.substr(at, 40);
    at += std::max<std::size_t>(used, 1);
    return value;
  };
  const auto point = [&] {
    const double x = number(), y = number();
    return Vec2(x, y);
  };
  while (at < data.size()) {
    if (data[at] == ' ') {
      ++at;
      continue;
    }
    if (std::isalpha(static_cast<unsigned char>(data[at]))) command = data[at++];
    if (command == 'M') {
      out.push_back({point()});
    } else if (command == 'm') {
      out.push_back({out.back().back() + point()});
    } else if (command == 'l') {
      out.back().push_back(out.back().back() + point());
    } else if (command == 'h') {
      out.back().push_back(out.back().back() + Vec2(number(), 0));
    } else if (command == 'q') {
      const Vec2 a = out.back().back(), b = a + point(), c = a + point();
      for (int k = 1; k <= pieces; ++k) {
        const double s = static_cast<double>(k) / pieces;
        out.back().push_back((1 - s) * (1 - s) * a + 2 * s * (1 - s) * b + s * s * c);
      }
    } else if (command != 'Z') {
      ADD_FAILURE() << "unknown command '" << command << "' in " << data.substr(0, 60);
      return out;
    }
  }
  return out;
}

std::string drawnSvg(const Document& document, const Motion& motion, const Motion* before) {
  const std::string path = temporaryPath("m.svg");
  exportMotion(path, document, motion, {.before = before});
  return contentOf(path);
}

void expectGoodPicture(const std::string& svg) {
  EXPECT_LE(svg.size(), kMostSvgBytes);
  const SvgPicture picture(svg);
  EXPECT_EQ(picture.drawnClasses(), picture.explainedClasses());
  const SvgElement& root = picture.elements().front();
  const SvgBox frame{0, 0, root.number("width"), root.number("height"), ""};
  const std::vector<SvgBox> texts = picture.textBoxes();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_TRUE(frame.holds({texts[i].x, texts[i].y}) &&
                frame.holds({texts[i].x + texts[i].width, texts[i].y + texts[i].height}))
        << "'" << texts[i].words << "' leaves the frame";
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(texts[i].overlaps(texts[j])) << "'" << texts[i].words << "' on '" << texts[j].words << "'";
  }
  for (const char* view : {"side", "top"}) {
    const SvgBox panel = picture.panel(view);
    for (const char* kind : {"start", "end", "nail", "nail-elsewhere"})
      for (const int i : picture.ofClass(kind, view)) {
        const SvgElement& e = picture.elements()[static_cast<std::size_t>(i)];
        EXPECT_TRUE(panel.holds({e.number("cx"), e.number("cy")})) << kind;
      }
    for (const char* kind : {"path", "crowd-path", "crowd-shade", "impact", "impact-cell"})
      for (const int i : picture.ofClass(kind, view))
        for (const auto& line : pathPoints(picture.elements()[static_cast<std::size_t>(i)].attributes.at("d"), 4))
          for (const Vec2& p : line) EXPECT_TRUE(panel.holds(p, 12)) << kind << " " << p.transpose();
  }
}

}  // namespace carom::export_tests
