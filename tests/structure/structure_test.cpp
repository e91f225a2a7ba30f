// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "examples/support/project_file.h"
#include "tests/structure/public_headers.h"
#include "tests/structure/rooms.h"
#include "tests/structure/source_rules.h"

namespace carom::structure {
namespace {

TEST(Structure, SourcesKeepTheLayering) {
  const Sources sources = readSources(projectFile("."));
  ASSERT_TRUE(sources.contains("adjoint/scene/scene.h")) << "no sources under " << projectFile(".");
  for (const std::string& violation : violations(sources)) ADD_FAILURE() << violation;
}

TEST(Structure, EveryPublicTypeIsInAnExample) {
  for (const std::string& missing : typesWithoutExample(readSources(projectFile(".")))) ADD_FAILURE() << missing;
  const Sources planted = {{"adjoint/scene/a.h", "namespace carom {\nstruct Known {\n};\nstruct Lone {\n};\n"},
                           {"examples/a.cpp", "Known k;\nstd::string Loner;\n"}};
  EXPECT_EQ(typesWithoutExample(planted), (std::vector<std::string>{"carom::Lone of adjoint/scene/a.h is in no example"}));
}

// Planted circles are found, chains and pairs are not reported.
TEST(Structure, CirclesAreFound) {
  const auto including = [](const std::string& header) { return "#include \"" + header + "\"\n"; };
  Sources sources = {{"editing/a.h", including("editing/b.h")},
                     {"editing/b.h", ""},
                     {"editing/b.cpp", including("editing/b.h") + including("editing/c.h")},
                     {"editing/c.h", ""},
                     {"editing/c.cpp", including("editing/d.h")},
                     {"editing/d.h", ""},
                     {"tests/a.cpp", including("editing/a.h")}};
  EXPECT_TRUE(circles(sources).empty());
  sources["editing/b.h"] = including("editing/a.h");
  EXPECT_EQ(circles(sources), (std::vector<std::vector<std::string>>{{"editing/a", "editing/b"}}));
  EXPECT_TRUE(circleViolations(sources).empty());
  sources["editing/d.cpp"] = including("../editing/b.h");  // the header of one and the source of another count alike
  EXPECT_EQ(circles(sources),
            (std::vector<std::vector<std::string>>{{"editing/a", "editing/b", "editing/c", "editing/d"}}));
  ASSERT_EQ(circleViolations(sources).size(), 1u);
  EXPECT_EQ(circleViolations(sources)[0], "a circle of 4 rooms: editing/a editing/b editing/c editing/d");
}

TEST(Structure, TrajectoriesAreNotCast) {
  const auto found = [](const std::string& code) { return violations("adjoint/derivative/a.cpp", code).size(); };
  EXPECT_EQ(found("auto p = static_cast" "<const ConstrainedPath*>(arc.shared().get());\n"), 1u);
  EXPECT_EQ(found("auto& p = dynamic_cast" "<const adjoint_detail::ClosedPath&>(t);\n"), 1u);
  EXPECT_EQ(found("auto p = std::static_pointer_cast" "<ConstrainedPath>(t);\n"), 1u);
  EXPECT_EQ(found("auto n = static_cast<int>(path.size());\n"), 0u);
}

// The rules themselves: planted violations are found, what is allowed is not reported.
struct Planted {
  const char* path;
  const char* include;
  bool allowed;
};

class IncludeRule : public testing::TestWithParam<Planted> {};

TEST_P(IncludeRule, JudgesOneInclude) {
  const Planted& row = GetParam();
  const std::string text = std::string("#pragma once\n#include ") + row.include + "\nint x;\n";
  EXPECT_EQ(violations(row.path, text).empty(), row.allowed) << row.path << " with " << row.include;
}

INSTANTIATE_TEST_SUITE_P(
    Table, IncludeRule,
    testing::Values(
        Planted{"ode_bridge/world.cpp", "<ode/ode.h>", true}, Planted{"ode_bridge/world.h", "<ode/ode.h>", false},
        Planted{"adjoint/simulate/simulate.cpp", "<ode/collision.h>", false}, Planted{"cli/main.cpp", "<ode/ode.h>", false},
        Planted{"ode_bridge/hull.cpp", "<libqhull_r/qhull_ra.h>", true},
        Planted{"ode_bridge/hull.h", "<libqhull_r/qhull_ra.h>", false},
        Planted{"adjoint/scene/hull.cpp", "<libqhull_r/libqhull_r.h>", false},
        Planted{"editing/ipopt_adapter.cpp", "<IpTNLP.hpp>", true},
        Planted{"editing/ipopt_adapter.cpp", "<coin/IpTNLP.hpp>", true},
        Planted{"editing/edit.h", "<IpTNLP.hpp>", false}, Planted{"cli/main.cpp", "<coin/IpTNLP.hpp>", false},
        Planted{"formats/documents/read.cpp", "<nlohmann/json.hpp>", true},
        Planted{"formats/documents/read.h", "<nlohmann/json_fwd.hpp>", false},
        Planted{"formats/json/json.hpp", "<nlohmann/json.hpp>", true},
        Planted{"formats/documents/read.h", "\"formats/json/json.hpp\"", false},
        Planted{"formats/documents/read.cpp", "\"formats/json/json.hpp\"", true},
        Planted{"formats/json/json.hpp", "\"formats/documents/read.h\"", false},
        Planted{"formats/gltf/read/bodies.cpp", "\"formats/gltf/axes.hpp\"", true},
        Planted{"formats/gltf/axes.hpp", "\"formats/gltf/read/bodies.hpp\"", false},
        Planted{"adjoint/simulate/simulate.h", "\"adjoint/simulate/simulator.hpp\"", false},
        Planted{"adjoint/simulate/simulate.cpp", "\"adjoint/simulate/simulator.hpp\"", true},
        Planted{"adjoint/simulate/simulate.cpp", "\"adjoint/derivative/adjoint.h\"", false},
        Planted{"adjoint/derivative/adjoint.cpp", "\"adjoint/simulate/simulate.h\"", true},
        Planted{"cli/main.cpp", "<nlohmann/json.hpp>", false}, Planted{"studio/serve.cpp", "<nlohmann/json.hpp>", true},
        Planted{"formats/json/schema.cpp", "<valijson/validator.hpp>", true},
        Planted{"editing/edit.cpp", "<valijson/validator.hpp>", false},
        Planted{"formats/gltf/gltf.cpp", "<tiny_gltf.h>", true}, Planted{"cli/export.cpp", "\"tiny_gltf.h\"", false},
        Planted{"tests/reference/flight.cpp", "<boost/multiprecision/cpp_bin_float.hpp>", true},
        Planted{"adjoint/flight/flight.cpp", "<boost/multiprecision/cpp_bin_float.hpp>", false},
        Planted{"editing/edit.cpp", "<boost/beast.hpp>", false}, Planted{"studio/net.cpp", "<boost/beast.hpp>", true},
        Planted{"studio/net.h", "<boost/beast.hpp>", false}, Planted{"studio/worker.cpp", "<boost/asio.hpp>", false},
        Planted{"studio/worker.cpp", "\"editing/session.h\"", true},
        Planted{"studio/worker.cpp", "\"cli/options.h\"", false},
        Planted{"cli/studio.cpp", "\"studio/studio.h\"", true},
        Planted{"formats/documents/read.cpp", "\"studio/views.h\"", false},
        Planted{"adjoint/flight/arc.cpp", "\"adjoint/flight/arc.h\"", true},
        Planted{"adjoint/flight/arc.cpp", "\"ode_bridge/ode_contacts.h\"", false},
        Planted{"adjoint/flight/arc.cpp", "\"editing/edit.h\"", false},
        Planted{"adjoint/flight/arc.cpp", "\"formats/base/document.h\"", false},
        Planted{"adjoint/impact/laws.cpp", "\"../../formats/base/document.h\"", false},
        Planted{"editing/edit.cpp", "\"adjoint/motion/contact_source.h\"", true},
        Planted{"editing/edit.cpp", "\"editing/report/explain.hpp\"", true},
        Planted{"editing/session/session_solver.cpp", "\"editing/strategy/samples.hpp\"", true},
        Planted{"editing/report/explain.cpp", "\"editing/strategy/edit_solution.hpp\"", true},
        Planted{"editing/report/explain.cpp", "\"editing/edit.h\"", false},
        Planted{"editing/strategy/samples.cpp", "\"editing/report/explain.hpp\"", false},
        Planted{"editing/solve/projection.cpp", "\"editing/strategy/samples.hpp\"", false},
        Planted{"editing/solve/projection.cpp", "\"../strategy/samples.hpp\"", false},
        Planted{"editing/problem/hessian.cpp", "\"editing/solve/projection.hpp\"", false},
        Planted{"editing/edit_options.h", "\"editing/problem/jacobian.hpp\"", false},
        Planted{"editing/detail/messages.cpp", "\"editing/control.h\"", false},
        Planted{"editing/elsewhere/x.cpp", "\"editing/control.h\"", false},
        Planted{"editing/edit.h", "\"editing/detail/messages.hpp\"", false},
        Planted{"tests/a.cpp", "\"editing/detail/messages.hpp\"", true},
        Planted{"editing/edit.cpp", "\"ode_bridge/ode_contacts.h\"", false},
        Planted{"editing/edit.cpp", "\"formats/base/document.h\"", false},
        Planted{"ode_bridge/world.cpp", "\"editing/edit.h\"", false},
        Planted{"ode_bridge/world.cpp", "\"formats/base/document.h\"", false},
        Planted{"formats/base/document.h", "\"editing/control.h\"", true},
        Planted{"formats/documents/read.cpp", "\"cli/options.h\"", false},
        Planted{"python/src/edit.cpp", "<nanobind/nanobind.h>", true},
        Planted{"editing/edit.cpp", "<nanobind/nanobind.h>", false},
        Planted{"python/src/edit.cpp", "\"editing/edit.h\"", true},
        Planted{"python/src/edit.cpp", "\"editing/problem/edit_problem.hpp\"", false},
        Planted{"python/src/edit.cpp", "\"cli/loading.h\"", false},
        Planted{"cli/main.cpp", "\"ode_bridge/ode_contacts.h\"", true}));

TEST(Structure, IncludesAreReadAsTheCompilerReadsThem) {
  const std::string text =
      "#include <a.h>\n  #  include \"b/c.h\"\n// #include <commented.h>\nint x;  // see #include <prose.h>\n";
  EXPECT_EQ(includesOf(text), (std::vector<std::string>{"a.h", "b/c.h"}));
}

// Functions whose bits differ by machine.
struct PlantedCall {
  const char* path;
  const char* line;
  bool allowed;
};

class InexactRule : public testing::TestWithParam<PlantedCall> {};

TEST_P(InexactRule, JudgesOneLine) {
  const PlantedCall& row = GetParam();
  EXPECT_EQ(violations(row.path, std::string("#pragma once\n") + row.line + "\n").empty(), row.allowed)
      << row.path << " with " << row.line;
}

INSTANTIATE_TEST_SUITE_P(
    Table, InexactRule,
    testing::Values(
        PlantedCall{"adjoint/flight/arc.cpp", "y = std::sin(x);", false},
        PlantedCall{"adjoint/numeric/so3.hpp", "y = std::cos(x);", false},
        PlantedCall{"ode_bridge/gaps/rim.cpp", "y = std::cbrt(x);", false},
        PlantedCall{"ode_bridge/gaps.cpp", "return std::hypot(x, y);", false},
        PlantedCall{"editing/edit.cpp", "y = std::pow(x, 2);", false},
        PlantedCall{"editing/edit.cpp", "y = 1 + ::log1p(x);", false},
        PlantedCall{"editing/edit.cpp", "using std::exp;", false},
        PlantedCall{"editing/edit.cpp", "y = exp(x);", false},
        PlantedCall{"editing/edit.cpp", "return -sin(x);", false},
        PlantedCall{"editing/edit.cpp", "using elementary::sin; y = sin(x);", true},
        PlantedCall{"adjoint/flight/arc.cpp", "y = elementary::sin(x);", true},
        PlantedCall{"adjoint/flight/arc.cpp", "y = std::sqrt(x) + std::floor(x) + std::fma(x, x, x) + std::fmod(x, y);", true},
        PlantedCall{"adjoint/flight/arc.cpp", "double sine(double x);  // std::sin(x)", true},
        PlantedCall{"adjoint/flight/arc.cpp", "friend Dual sin(const Dual& a);", true},
        PlantedCall{"adjoint/flight/arc.cpp", "R = Eigen::AngleAxisd(a, axis);", false},
        PlantedCall{"adjoint/flight/arc.cpp", "q = p.slerp(t, r);", false},
        PlantedCall{"adjoint/flight/arc.cpp", "v = w.array().exp();", false},
        PlantedCall{"adjoint/numeric/elementary/circular.cpp", "y = std::sin(x);", true},
        PlantedCall{"formats/svg/svg.cpp", "y = std::sin(x);", true},
        PlantedCall{"tests/a.cpp", "y = std::sin(x);", true}));

TEST(Structure, LongFilesAreFound) {
  const auto lines = [](int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += "int x;\n";
    return text;
  };
  EXPECT_TRUE(violations("cli/main.cpp", lines(350)).empty());
  EXPECT_EQ(violations("cli/main.cpp", lines(351)).size(), 1u);
  EXPECT_TRUE(violations("tests/cli/main.cpp", lines(450)).empty());
  EXPECT_EQ(violations("tests/cli/main.cpp", lines(451)).size(), 1u);
}

TEST(Structure, LongFunctionsAreFound) {
  const auto function = [](const std::string& margin, const std::string& head, int lines) {
    std::string text = margin + head + " {\n";
    for (int i = 2; i < lines; ++i) text += margin + "  f();\n";
    return text + margin + "}\n";
  };
  EXPECT_TRUE(violations("cli/a.cpp", function("", "void f()", 60)).empty());
  EXPECT_EQ(violations("cli/a.cpp", function("", "void f()", 61)).size(), 1u);
  EXPECT_EQ(violations("cli/a.cpp", function("  ", "void f() const", 61)).size(), 1u);
  EXPECT_TRUE(violations("cli/a.cpp", function("", "namespace carom", 61)).empty());
  EXPECT_TRUE(violations("cli/a.cpp", function("", "const int kTable[] =", 61)).empty());
  EXPECT_TRUE(violations("tests/a.cpp", function("", "void f()", 61)).empty());
}

TEST(Structure, TypesDefinedTwiceAreFound) {
  const std::string one =
      "namespace carom {\nstruct Node;\nstruct Node {\n  struct Inner {\n  };\n};\n}  // namespace carom\n";
  EXPECT_EQ(definedTypes(one), (std::vector<std::string>{"carom::Node"}));
  EXPECT_EQ(definedTypes("namespace carom::gltf {\nclass A final : public B {\n};\nusing C = int;\n"),
            (std::vector<std::string>{"carom::gltf::A", "carom::gltf::C"}));
  EXPECT_EQ(typesDefinedTwice({{"formats/a.h", one}, {"ode_bridge/b.h", one}}).size(), 1u);
  const std::string declared = "namespace carom {\nstruct Node;\n}  // namespace carom\n";
  EXPECT_TRUE(typesDefinedTwice({{"formats/a.h", one}, {"ode_bridge/b.hpp", declared}}).empty());
}

TEST(Structure, PrivateNamesHaveANamespaceOfTheirOwn) {
  const auto in = [](const std::string& space) {
    return "namespace " + space + " {\nclass A {\n};\n}  // namespace " + space + "\n";
  };
  EXPECT_EQ(privateNamesInCarom("formats/a.hpp", in("carom")).size(), 1u);
  EXPECT_TRUE(privateNamesInCarom("formats/a.hpp", in("carom::formats_detail")).empty());
  EXPECT_TRUE(privateNamesInCarom("formats/a.h", in("carom")).empty());
}

TEST(Structure, IpoptMustBeInExactlyOneFile) {
  const std::string with = "#include <IpTNLP.hpp>\n";
  EXPECT_TRUE(violations(Sources{{"editing/a.cpp", with}, {"editing/b.cpp", ""}}).empty());
  EXPECT_EQ(violations(Sources{{"editing/a.cpp", with}, {"editing/b.cpp", with}}).size(), 1u);
  EXPECT_EQ(violations(Sources{{"editing/a.cpp", ""}}).size(), 1u);
}

}  // namespace
}  // namespace carom::structure
