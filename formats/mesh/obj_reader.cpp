// SPDX-License-Identifier: MIT
#include "formats/mesh/obj_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <system_error>

#include "adjoint/base/errors.h"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/repair/triangulate.hpp"

namespace carom::formats_detail {
namespace {

constexpr std::size_t kMostCorners = 10'000;  // of one polygon
constexpr std::size_t kMostFans = 64;         // corners that are tried as the first of a fan
constexpr double kLargest = 1e9;              // m, as for every number of a scene

// Words that change nothing in the places of triangles.
constexpr std::string_view kIgnored[] = {"vt",     "vn",       "vp",       "g",          "o",        "s",      "l",
                                         "p",      "mg",       "lod",      "bevel",      "usemtl",   "mtllib", "usemap",
                                         "maplib", "c_interp", "d_interp", "shadow_obj", "trace_obj"};
constexpr std::string_view kCurved[] = {"cstype", "deg",  "bmat", "step", "curv", "curv2", "surf",
                                        "parm",   "trim", "hole", "scrv", "sp",   "con"};

bool lists(const auto& words, std::string_view word) {
  return std::find(std::begin(words), std::end(words), word) != std::end(words);
}

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

std::string shortenedToken(std::string_view token) {
  constexpr std::size_t kMost = 40;
  return quotedText(token.size() <= kMost ? std::string(token) : std::string(token.substr(0, kMost)) + "...");
}

struct Polygon {
  std::size_t first = 0, count = 0;  // corners
  int line = 0;
};

class ObjParser {
 public:
  explicit ObjParser(std::string_view text) : text_(text) {}

  TriangleSoup parse() {
    while (at_ < text_.size()) readStatement();
    for (const Polygon& polygon : polygons_) addTriangles(polygon);
    if (few_ > 0)
      soup_.repairs.push_back(std::to_string(few_) + (few_ == 1 ? " face" : " faces") +
                              " of fewer than three corners left out (the first at line " + std::to_string(first_few_) + ")");
    return std::move(soup_);
  }

  std::vector<Vec3> parsePoints() {
    while (at_ < text_.size()) readStatement();
    if (polygons_.empty()) return std::move(soup_.vertices);
    std::vector<char> used(soup_.vertices.size(), 0);
    for (const Polygon& polygon : polygons_) {
      checkCorners(polygon);
      for (std::size_t i = 0; i < polygon.count; ++i) used[static_cast<std::size_t>(corners_[polygon.first + i])] = 1;
    }
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v]) points.push_back(soup_.vertices[v]);
    return points;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected) const {
    throw InputError("line " + std::to_string(line_), "found " + found + ", expected " + expected);
  }

  // ---- text ----

  // Past blanks and line ends that a backslash takes away.
  void skipBlanks() {
    while (at_ < text_.size()) {
      if (isBlank(text_[at_])) {
        ++at_;
      } else if (const std::size_t next = continuation(); next > 0) {
        at_ = next;
        ++lines_inside_;
      } else {
        return;
      }
    }
  }

  // Where the line goes on when a backslash ends it here; 0 when none does.
  std::size_t continuation() const {
    if (text_[at_] != '\\') return 0;
    std::size_t next = at_ + 1;
    if (next < text_.size() && text_[next] == '\r') ++next;
    return next < text_.size() && text_[next] == '\n' ? next + 1 : 0;
  }

  bool atEnd() const { return at_ >= text_.size() || text_[at_] == '\n' || text_[at_] == '#'; }

  // The next word of the statement; empty at its end.
  std::string_view word() {
    skipBlanks();
    const std::size_t begin = at_;
    while (!atEnd() && !isBlank(text_[at_]) && continuation() == 0) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  void skipStatement() {
    bool comment = false;
    while (at_ < text_.size() && text_[at_] != '\n') {
      if (text_[at_] == '#') comment = true;
      if (const std::size_t next = comment ? 0 : continuation(); next > 0) {
        at_ = next;
        ++lines_inside_;
      } else {
        ++at_;
      }
    }
    if (at_ < text_.size()) ++at_;
    line_ += 1 + lines_inside_;
    lines_inside_ = 0;
  }

  // ---- statements ----

  void readStatement() {
    const std::string_view keyword = word();
    if (keyword == "v") {
      readVertex();
    } else if (keyword == "f" || keyword == "fo") {
      readFace();
    } else if (lists(kCurved, keyword)) {
      fail(shortenedToken(keyword), "no curved surfaces (export it as a mesh of polygons)");
    } else if (!keyword.empty() && !lists(kIgnored, keyword)) {
      fail(shortenedToken(keyword), "a word of the OBJ format");
    }
    skipStatement();
  }

  double readNumber(std::string_view token) const {
    std::string_view digits = token;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool whole = end == digits.data() + digits.size();
    if (error == std::errc::result_out_of_range && whole) fail(shortenedToken(token), "a number that a double can hold");
    if (error != std::errc() || !whole) fail(shortenedToken(token), "a number");
    if (!(std::abs(value) <= kLargest)) fail(shortenedToken(token), "a finite number of magnitude at most 1e9");
    return value;
  }

  void readVertex() {
    if (soup_.vertices.size() >= kMostVertices)
      fail("one more vertex", "at most " + std::to_string(kMostVertices) + " vertices");
    Vec3 vertex;
    for (double& coordinate : vertex) {
      const std::string_view token = word();
      if (token.empty()) fail("the end of the vertex", "three numbers");
      coordinate = readNumber(token);
    }
    soup_.vertices.push_back(vertex);
  }

  // A whole number with its sign, taken from the front of a token.
  bool takeInteger(std::string_view& token, long long& value) const {
    const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error != std::errc()) return false;
    token.remove_prefix(static_cast<std::size_t>(end - token.data()));
    return true;
  }

  // v, v/vt, v//vn or v/vt/vn: the vertex, counted from 0. One that comes later in the file is checked at the end.
  // Programs that have no vt or vn may leave their places empty: v/ or v//.
  long long readCorner(std::string_view token) const {
    std::string_view rest = token;
    long long vertex = 0, ignored = 0;
    bool good = takeInteger(rest, vertex);
    for (int part = 0; part < 2 && good && !rest.empty(); ++part) {
      good = rest[0] == '/';
      rest.remove_prefix(1);
      if (rest.empty() || (part == 0 && rest[0] == '/')) continue;
      good = good && takeInteger(rest, ignored);
    }
    if (!good || !rest.empty()) fail(shortenedToken(token), "a corner such as 3, 3/1, 3//2 or 3/1/2");
    const auto count = static_cast<long long>(soup_.vertices.size());
    if (vertex == 0) fail(shortenedToken(token), "a vertex counted from 1, or from -1 backwards");
    if (vertex < -count)
      fail(shortenedToken(token), "a vertex that is there (" + std::to_string(count) + " stand before this line)");
    return vertex > 0 ? vertex - 1 : count + vertex;
  }

  void readFace() {
    Polygon polygon{corners_.size(), 0, line_};
    for (std::string_view token = word(); !token.empty(); token = word()) {
      if (++polygon.count > kMostCorners) fail("a polygon of more corners", "at most " + std::to_string(kMostCorners));
      corners_.push_back(readCorner(token));
    }
    if (polygon.count < 3) {
      if (few_++ == 0) first_few_ = line_;
      corners_.resize(polygon.first);
      return;
    }
    if (corners_.size() - 2 * (polygons_.size() + 1) > kMostTriangles)
      fail("one more triangle", "at most " + std::to_string(kMostTriangles) + " triangles");
    polygons_.push_back(polygon);
  }

  // ---- triangles ----

  const Vec3& place(const Polygon& p, std::size_t i) const {
    return soup_.vertices[static_cast<std::size_t>(corners_[p.first + i % p.count])];
  }

  // A fan about corner `base` covers a convex polygon when every triangle of it turns the way that the whole does.
  bool fanCovers(const Polygon& p, std::size_t base, const Vec3& area) const {
    for (std::size_t i = 1; i + 1 < p.count; ++i) {
      const Vec3& centre = place(p, base);
      if (!((place(p, base + i) - centre).cross(place(p, base + i + 1) - centre).dot(area) > 0)) return false;
    }
    return true;
  }

  void checkCorners(const Polygon& p) {
    line_ = p.line;
    const auto count = static_cast<long long>(soup_.vertices.size());
    for (std::size_t i = 0; i < p.count; ++i)
      if (corners_[p.first + i] >= count)
        fail("vertex " + std::to_string(corners_[p.first + i] + 1),
             count == 0 ? "no faces, as there are no vertices" : "one of 1 to " + std::to_string(count));
  }

  void addTriangles(const Polygon& p) {
    checkCorners(p);
    const std::vector<int> corners = cornersOnce(p);
    const Polygon once{p.first, corners.size(), p.line};  // its corners stand first
    std::copy(corners.begin(), corners.end(), corners_.begin() + static_cast<std::ptrdiff_t>(p.first));
    if (const auto base = once.count < 3 ? std::nullopt : fanBase(once)) {
      for (std::size_t i = 1; i + 1 < once.count; ++i)
        addTriangle(corners[*base], corners[(*base + i) % once.count], corners[(*base + i + 1) % once.count], p.line);
      return;
    }
    std::vector<Vec3> places;
    for (const int v : corners) places.push_back(soup_.vertices[static_cast<std::size_t>(v)]);
    if (corners.size() > mesh_repair::kMostTriangulated)
      fail("a polygon of " + std::to_string(corners.size()) + " corners that is not convex",
           "at most " + std::to_string(mesh_repair::kMostTriangulated) + " corners of such (export it as triangles)");
    const auto triangles = mesh_repair::triangulate(places);
    for (const auto& t : triangles)
      addTriangle(corners[static_cast<std::size_t>(t[0])], corners[static_cast<std::size_t>(t[1])],
                  corners[static_cast<std::size_t>(t[2])], p.line);
    if (triangles.empty() && p.count >= 3)  // as it is: without an area, which is said where a surface is made of it
      addTriangle(static_cast<int>(corners_[p.first]), static_cast<int>(corners_[p.first + 1]),
                  static_cast<int>(corners_[p.first + 2]), p.line);
  }

  void addTriangle(int a, int b, int c, int line) {
    soup_.triangles.push_back({a, b, c});
    soup_.lines.push_back(line);
  }

  /// Once round, without corners that stand at the place of the one before.
  std::vector<int> cornersOnce(const Polygon& p) const {
    std::vector<int> corners;
    for (std::size_t i = 0; i < p.count; ++i)
      if (p.count == 3 || place(p, i) != place(p, i + 1)) corners.push_back(static_cast<int>(corners_[p.first + i]));
    for (std::size_t period = 3; 2 * period <= corners.size(); ++period)
      if (corners.size() % period == 0 && std::equal(corners.begin() + static_cast<std::ptrdiff_t>(period), corners.end(), corners.begin())) {
        corners.resize(period);
        break;
      }
    return corners;
  }

  std::optional<std::size_t> fanBase(const Polygon& p) const {
    if (p.count == 3) return 0;
    Vec3 area = Vec3::Zero();
    for (std::size_t i = 1; i + 1 < p.count; ++i)
      area += (place(p, i) - place(p, 0)).cross(place(p, i + 1) - place(p, 0));
    for (std::size_t base = 0; base < std::min(p.count, kMostFans); ++base)
      if (fanCovers(p, base, area)) return base;
    return std::nullopt;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, lines_inside_ = 0;  // of the statement; those that backslashes joined to it
  TriangleSoup soup_;
  std::vector<long long> corners_;  // vertices counted from 0
  std::vector<Polygon> polygons_;
  int few_ = 0, first_few_ = 0;  // faces of fewer than three corners, and the line of the first
};

}  // namespace

TriangleSoup parseObj(std::string_view text) { return ObjParser(text).parse(); }

std::vector<Vec3> parseObjPoints(std::string_view text) { return ObjParser(text).parsePoints(); }

}  // namespace carom::formats_detail
