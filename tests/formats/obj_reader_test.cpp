// SPDX-License-Identifier: MIT
#include "formats/mesh/obj_reader.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <random>

#include "adjoint/base/errors.h"
#include "adjoint/scene/surface.h"
#include "formats/json/json_writer.hpp"
#include "formats/mesh/obj_text.hpp"
#include "tests/formats/mesh_texts.h"

namespace carom {

using namespace formats_detail;

namespace {

using Triangles = std::vector<std::array<int, 3>>;

const char* const kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ObjReader, cube) {
  const TriangleSoup soup = parseObj(formats_test::cubeObj());
  EXPECT_EQ(soup.vertices.size(), 8u);
  EXPECT_EQ(soup.triangles.size(), 12u);
  const auto surface = meshSurface(soup.vertices, soup.triangles);
  EXPECT_TRUE(surface->closed);
  EXPECT_NEAR(surface->volume, 1, 1e-15);
}

TEST(ObjReader, everyFormOfCorner) {
  const std::string extra = "vt 0 0\nvt 1 0\nvn 0 0 1\n";
  for (const char* face :
       {"f 1 2 3", "f 1/1 2/2 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/1/1", "f -4 -3 -2", "f -4/1/1 2//1 3",
        "fo 1 2 3", "f\t1  2\t 3 ", "f 1/ 2/ 3/", "f 1// 2// 3//", "f 1/2/ 2/1/ 3/1/"}) {
    SCOPED_TRACE(face);
    const TriangleSoup soup = parseObj(kSquare + extra + face);
    EXPECT_EQ(soup.triangles, (Triangles{{0, 1, 2}}));
    EXPECT_EQ(soup.lines, std::vector<int>{8});
  }
}

TEST(ObjReader, negativeCornersCountFromTheirLine) {
  const TriangleSoup soup = parseObj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 0 0 1\nf -1 -2 -3\n");
  EXPECT_EQ(soup.triangles, (Triangles{{0, 1, 2}, {3, 2, 1}}));
}

TEST(ObjReader, facesBeforeTheirVertices) {
  EXPECT_EQ(parseObj(std::string("f 1 2 3\n") + kSquare).triangles, (Triangles{{0, 1, 2}}));
}

TEST(ObjReader, polygonsBecomeFans) {
  EXPECT_EQ(parseObj(std::string(kSquare) + "f 1 2 3 4\n").triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  // An L: the fan starts at its inner corner.
  const TriangleSoup bent = parseObj("v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5 6\n");
  EXPECT_EQ(bent.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
  // Corners on one line: the fan starts where no triangle is flat.
  const TriangleSoup soup = parseObj("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3 4\n");
  EXPECT_EQ(soup.triangles, (Triangles{{1, 2, 3}, {1, 3, 0}}));
}

TEST(ObjReader, whatIsIgnored) {
  const std::string text =
      "# a square\r\nmtllib a.mtl\r\no thing\r\ng a b\r\ns off\r\nusemtl red\r\nvt 0.1 0.2\r\nvn nothing\r\n"
      "v 0 0 0 1 0.5 0.25\r\nv 1 0 0 1.0\r\nv 1 1 0 # corner\r\nv 0 1 0\r\nl 1 2\r\np 1\r\nf 1 2 3 # a face\r\n\r\n";
  const TriangleSoup soup = parseObj(text);
  EXPECT_EQ(soup.vertices.size(), 4u);
  EXPECT_EQ(soup.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(soup.lines, std::vector<int>{15});
}

TEST(ObjReader, linesGoOnAfterABackslash) {
  const TriangleSoup soup = parseObj("v 0 \\\n 0 \\\r\n0\nv 1 0 0\nv 0 1 0\n# end \\\nf 1 2\\\n3\n");
  EXPECT_EQ(soup.vertices.size(), 3u);
  EXPECT_EQ(soup.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_EQ(soup.lines, std::vector<int>{7});
}

TEST(ObjReader, emptyTexts) {
  for (const char* text : {"", "\n", "# nothing", "\\", "\\\n"}) {
    const TriangleSoup soup = std::string(text) == "\\" ? TriangleSoup{} : parseObj(text);
    EXPECT_TRUE(soup.vertices.empty() && soup.triangles.empty()) << text;
  }
}

TEST(ObjReader, coordinatesAreTheNearestDoubles) {
  const unsigned seed = 20260;
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> exponent(-300, 8.9), unit(-1, 1);
  std::string text;
  std::vector<double> numbers;
  for (int i = 0; i < 3000; ++i) {
    numbers.push_back(unit(random) * std::pow(10, exponent(random)));
    text += (i % 3 == 0 ? "\nv " : " ") + numberText(numbers.back());
  }
  const TriangleSoup soup = parseObj(text);
  ASSERT_EQ(soup.vertices.size(), 1000u);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double read = soup.vertices[i / 3][static_cast<int>(i % 3)];
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(numbers[i])) << numbers[i];
  }
  EXPECT_EQ(parseObj("v +1 -0 1.5E+2").vertices[0], Vec3(1, 0, 150));
}

struct BrokenObj {
  std::string text, where;
  std::vector<std::string> fragments;
};

TEST(ObjReader, brokenTexts) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  std::string many = "f";
  for (int i = 0; i < 10001; ++i) many += " 1";
  const BrokenObj all[] = {
      {three + "f 1 2 4\n", "line 4", {"found vertex 4", "one of 1 to 3"}},
      {three + "f 1 2 -4\n", "line 4", {"found \"-4\"", "3 stand before this line"}},
      {three + "f 1 2 0\n", "line 4", {"found \"0\"", "counted from 1"}},
      {three + "f 1 2 3x\n", "line 4", {"found \"3x\"", "a corner such as 3, 3/1, 3//2 or 3/1/2"}},
      {three + "f 1 2 3/x\n", "line 4", {"found \"3/x\""}},
      {three + "f 1 2 3/1/1/1\n", "line 4", {"found \"3/1/1/1\""}},
      {three + "f 1 2 /3\n", "line 4", {"found \"/3\""}},
      {three + "f 1 2 1.5\n", "line 4", {"found \"1.5\""}},
      {three + "f 1 2 99999999999999999999\n", "line 4", {"found \"99999999999999999999\""}},
      {three + "f 1 2 9999999999\n", "line 4", {"found vertex 9999999999", "one of 1 to 3"}},
      {three + "f 1 2 -9223372036854775808\n", "line 4", {"-9223372036854775808"}},
      {"f 1 2 3\n", "line 1", {"no vertices"}},
      {"v 0 0\n", "line 1", {"the end of the vertex", "three numbers"}},
      {"v 0 0 x\n", "line 1", {"found \"x\"", "a number"}},
      {"v 0 0 1,5\n", "line 1", {"found \"1,5\"", "a number"}},
      {"v 0 0 nan\n", "line 1", {"found \"nan\"", "finite"}},
      {"v 0 inf 0\n", "line 1", {"found \"inf\"", "finite"}},
      {"v 0 1e400 0\n", "line 1", {"found \"1e400\"", "a double can hold"}},
      {"v 0 2e9 0\n", "line 1", {"found \"2e9\"", "magnitude at most 1e9"}},
      {"v 0 0 0x10\n", "line 1", {"found \"0x10\""}},
      {"v 0 0 +-1\n", "line 1", {"found \"+-1\""}},
      {"\n\ncurv 0 1 1 2\n", "line 3", {"found \"curv\"", "no curved surfaces"}},
      {"call other.obj\n", "line 1", {"found \"call\"", "a word of the OBJ format"}},
      {"{\"asset\": {}}", "line 1", {"a word of the OBJ format"}},
      {std::string("\0\0\0\0", 4), "line 1", {"a word of the OBJ format"}},
      {std::string(1000000, 'x'), "line 1", {"xxx...\""}},
      {three + "v 1 \\\n 1 \\\n zero\n", "line 4", {"found \"zero\""}},
      {three + "\\\n\\\nf 1 2 9\n", "line 4", {"found vertex 9"}},
      {three + many + "\n", "line 4", {"at most 10000"}},
  };
  for (const BrokenObj& broken : all) {
    SCOPED_TRACE(broken.text.substr(0, 80));
    try {
      parseObj(broken.text);
      ADD_FAILURE() << "was read";
    } catch (const InputError& error) {
      const std::string what = error.what();
      EXPECT_EQ(error.where(), broken.where) << what;
      EXPECT_LT(what.size(), 300u);
      for (const std::string& fragment : broken.fragments)
        EXPECT_NE(what.find(fragment), std::string::npos) << what << "\nwithout: " << fragment;
    }
  }
}

TEST(ObjReader, UTF16AndByteOrderMarks) {
  const std::string text = "# \xC3\xA9\nv 0 0 0\n";
  EXPECT_EQ(plainText("\xEF\xBB\xBF" + text), text);
  EXPECT_EQ(plainText(text), text);
  EXPECT_EQ(plainText(std::string("\xFE\xFF\0v\0 \xE9\xE9", 8)), "v ?");
  EXPECT_EQ(plainText(std::string("\xFF\xFEv\0 \0", 6)), "v ");
}

TEST(ObjReader, aPolygonOfThousandsOfCornersIsAFan) {
  std::string text, convex = "f", bent = "f";
  for (int k = 0; k < 3000; ++k) {
    const double angle = k * 2 * 3.14159265358979 / 3000, r = k % 2 == 0 ? 1 : 0.7;
    text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) + " 0\n";
    text += "v " + std::to_string(r * std::cos(angle)) + " " + std::to_string(r * std::sin(angle)) + " 0\n";
    convex += " " + std::to_string(2 * k + 1), bent += " " + std::to_string(2 * k + 2);
  }
  EXPECT_GE(parseObj(text + convex + "\n").triangles.size(), 2000u);
  EXPECT_THROW(parseObj(text + bent + "\n"), InputError);
}

TEST(ObjReader, moreThanItsLimits) {
  std::string text;
  for (std::size_t i = 0; i <= kMostVertices; ++i) text += "v 0 0 0\n";
  EXPECT_THROW(parseObj(text), InputError);
  text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (std::size_t i = 0; i <= kMostTriangles; ++i) text += "f 1 2 3\n";
  EXPECT_THROW(parseObj(text), InputError);
}

}  // namespace
}  // namespace carom
