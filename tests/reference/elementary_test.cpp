// SPDX-License-Identifier: MIT
#include "adjoint/numeric/elementary.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "adjoint/numeric/elementary/constants.hpp"

// The elementary functions beside MPFR with 200 bits (3000 where constants are computed again).
namespace carom {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kLeast = std::numeric_limits<double>::denorm_min();
constexpr double kMost = std::numeric_limits<double>::max();

class Exact {
 public:
  explicit Exact(int bits = 200) { mpfr_init2(x_, bits); }
  ~Exact() { mpfr_clear(x_); }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  mpfr_ptr get() { return x_; }

 private:
  mpfr_t x_;
};

using OfOne = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using OfTwo = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);

// |ours - exact| in units of the last place of exact; 0 where both are infinite or too small for a half.
double ulps(double ours, mpfr_ptr exact) {
  const double nearest = mpfr_get_d(exact, MPFR_RNDN);
  if (ours == nearest && (std::isinf(ours) || mpfr_zero_p(exact))) return 0;
  if (!std::isfinite(ours) || !std::isfinite(nearest)) return kInf;
  const double toward_zero = mpfr_get_d(exact, MPFR_RNDZ);
  int exponent = 0;
  std::frexp(toward_zero, &exponent);
  Exact error;
  mpfr_sub_d(error.get(), exact, ours, MPFR_RNDN);
  mpfr_mul_2si(error.get(), error.get(), -std::max(exponent - 53, -1074), MPFR_RNDN);
  return std::abs(mpfr_get_d(error.get(), MPFR_RNDN));
}

// Arguments: even in a range, or of every magnitude between two.
struct Range {
  double from, to;
  bool by_magnitude = false;
};

double draw(const Range& range, std::mt19937_64& chance) {
  const double part = std::uniform_real_distribution<double>(0, 1)(chance);
  if (!range.by_magnitude) return range.from + part * (range.to - range.from);
  const double size = std::ldexp(1 + part, std::uniform_int_distribution<int>(std::ilogb(range.from),
                                                                             std::ilogb(range.to))(chance));
  return range.from < 0 && (chance() & 1) ? -size : size;
}

struct Row {
  const char* name;
  double (*ours)(double);
  OfOne exact;
  std::vector<Range> ranges;
  double most;  // units in the last place
};

double sineOfBoth(double x) { return elementary::sincos(x).sine; }
double cosineOfBoth(double x) { return elementary::sincos(x).cosine; }

const std::vector<Row>& rows() {
  const std::vector<Range> angles = {{-0.9, 0.9}, {-10, 10}, {-3e6, 3e6}, {-kLeast, kMost, true}};
  const std::vector<Range> growing = {{-0.01, 0.01}, {-1, 1}, {-30, 30}, {-750, 750}, {-1e-20, 1, true}};
  const std::vector<Range> positive = {{0.5, 2}, {0.98, 1.02}, {0, 1000}, {kLeast, kMost, true}};
  const std::vector<Range> all = {{-1, 1}, {-9, 9}, {-kLeast, kMost, true}};
  static const std::vector<Row> kRows = {
      {"sin", elementary::sin, mpfr_sin, angles, 0.55},       {"cos", elementary::cos, mpfr_cos, angles, 0.55},
      {"sincos.sine", sineOfBoth, mpfr_sin, angles, 0.55},    {"sincos.cosine", cosineOfBoth, mpfr_cos, angles, 0.55},
      {"tan", elementary::tan, mpfr_tan, angles, 2.6},
      {"exp", elementary::exp, mpfr_exp, growing, 0.53},      {"sinh", elementary::sinh, mpfr_sinh, growing, 0.56},
      {"cosh", elementary::cosh, mpfr_cosh, growing, 0.56},   {"log", elementary::log, mpfr_log, positive, 0.53},
      {"log10", elementary::log10, mpfr_log10, positive, 0.51},
      {"cbrt", elementary::cbrt, mpfr_cbrt, all, 0.51},
  };
  return kRows;
}

class ElementaryOfOne : public testing::TestWithParam<Row> {};

TEST_P(ElementaryOfOne, IsWithinItsErrorEverywhere) {
  const Row& row = GetParam();
  std::mt19937_64 chance(2026);
  Exact argument(53), value;
  double worst = 0, at = 0;
  const auto check = [&](double x) {
    mpfr_set_d(argument.get(), x, MPFR_RNDN);
    row.exact(value.get(), argument.get(), MPFR_RNDN);
    const double error = ulps(row.ours(x), value.get());
    if (!(error <= worst)) worst = error, at = x;
  };
  for (const Range& range : row.ranges)
    for (int i = 0; i < 20000; ++i) check(draw(range, chance));
  // where tables and branches meet, from both sides
  for (double border : {0.125, 0.25, 22.0, 708.0, 709.782712893384, 745.133219101941, std::numbers::pi / 4, 0x1p20, 1.0,
                        std::numbers::sqrt2, 0x1p-1022, 0x1p-1021, kLeast}) {
    for (int j = 1; j <= 64; ++j) {
      for (double x : {border, border * j / 64, border + j * 0x1p-53, j * std::numbers::pi / 2,
                       j * std::numbers::ln2 / 64}) {
        if (row.ranges[0].from < 0) check(-x);
        check(x), check(std::nextafter(x, 0)), check(std::nextafter(x, kMost));
      }
    }
  }
  testing::Test::RecordProperty("ulps", std::to_string(worst));
  EXPECT_TRUE(worst <= row.most) << row.name << " is off by " << worst << " units of the last place at " << at;
}

INSTANTIATE_TEST_SUITE_P(Table, ElementaryOfOne, testing::ValuesIn(rows()), [](const auto& row) {
  std::string name = row.param.name;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
});

// The double that lies nearest to a multiple of pi/2, among all, is 6381956970095103 * 2^797; and the nearest ones to
// some multiples of every size.
TEST(Elementary, AnglesNearMultiplesOfAQuarterTurn) {
  std::mt19937_64 chance(7);
  Exact quarter(2000), product(2000), argument(53), value;
  mpfr_const_pi(quarter.get(), MPFR_RNDN);
  mpfr_div_2ui(quarter.get(), quarter.get(), 1, MPFR_RNDN);
  double worst = 0, at = 0;
  const auto check = [&](double x) {
    mpfr_set_d(argument.get(), x, MPFR_RNDN);
    for (const bool sine : {true, false}) {
      (sine ? mpfr_sin : mpfr_cos)(value.get(), argument.get(), MPFR_RNDN);
      const double error = ulps(sine ? elementary::sin(x) : elementary::cos(x), value.get());
      if (!(error <= worst)) worst = error, at = x;
    }
  };
  check(std::ldexp(6381956970095103.0, 797));
  check(-std::ldexp(6381956970095103.0, 797));
  for (int size = 0; size < 1020; ++size) {
    for (int i = 0; i < 40; ++i) {
      const double multiple = std::ldexp(static_cast<double>(chance() >> 11), size - 53);
      mpfr_mul_d(product.get(), quarter.get(), size < 53 ? std::floor(multiple) : multiple, MPFR_RNDN);
      const double x = mpfr_get_d(product.get(), MPFR_RNDN);
      check(x), check(std::nextafter(x, kInf)), check(-std::nextafter(x, 0));
    }
  }
  EXPECT_TRUE(worst <= 0.55) << worst << " at " << at;
}

void checkOfTwo(const char* name, double (*ours)(double, double), OfTwo exact, double most,
                const std::function<std::pair<double, double>(std::mt19937_64&)>& arguments, double least = 0) {
  std::mt19937_64 chance(11);
  Exact a(53), b(53), value;
  double worst = 0, at_x = 0, at_y = 0;
  for (int i = 0; i < 80000; ++i) {
    const auto [x, y] = arguments(chance);
    mpfr_set_d(a.get(), x, MPFR_RNDN), mpfr_set_d(b.get(), y, MPFR_RNDN);
    exact(value.get(), a.get(), b.get(), MPFR_RNDN);
    if (mpfr_cmpabs_ui(value.get(), 0) != 0 && std::abs(mpfr_get_d(value.get(), MPFR_RNDN)) < least) continue;
    const double error = ulps(ours(x, y), value.get());
    if (!(error <= worst)) worst = error, at_x = x, at_y = y;
  }
  testing::Test::RecordProperty("ulps of " + std::string(name), std::to_string(worst));
  EXPECT_TRUE(worst <= most) << name << " is off by " << worst << " at " << at_x << ", " << at_y;
}

double sized(std::mt19937_64& chance, double from, double to) { return draw({from, to, true}, chance); }

TEST(Elementary, ArcTangents) {
  const auto any = [](std::mt19937_64& c) { return std::pair(sized(c, -kLeast, kMost), sized(c, -kLeast, kMost)); };
  const auto alike = [](std::mt19937_64& c) { return std::pair(draw({-1, 1}, c), draw({-1, 1}, c)); };
  const auto extreme = [](std::mt19937_64& c) {
    const double scale = c() & 1 ? 0x1p1023 : 0x1p-1060;
    return std::pair(draw({-1, 1}, c) * scale, draw({-1, 1}, c) * scale);
  };
  checkOfTwo("atan2 of any size", elementary::atan2, mpfr_atan2, 0.6, any, 0x1p-1022);
  checkOfTwo("atan2 of any size, denormalised", elementary::atan2, mpfr_atan2, 1, any);
  checkOfTwo("atan2 of like sizes", elementary::atan2, mpfr_atan2, 0.6, alike);
  checkOfTwo("atan2 of extreme sizes", elementary::atan2, mpfr_atan2, 0.6, extreme);
}

TEST(Elementary, Hypotenuses) {
  checkOfTwo("hypot of any size", elementary::hypot, mpfr_hypot, 0.51, [](std::mt19937_64& c) {
    const double x = sized(c, -kLeast, kMost / 4);
    return std::pair(x, x * draw({-4, 4}, c));
  }, 0x1p-1022);
  checkOfTwo("hypot, denormalised", elementary::hypot, mpfr_hypot, 1, [](std::mt19937_64& c) {
    return std::pair(sized(c, -kLeast, 0x1p-1020), sized(c, -kLeast, 0x1p-1020));
  });
  checkOfTwo("hypot of like sizes", elementary::hypot, mpfr_hypot, 0.51,
             [](std::mt19937_64& c) { return std::pair(draw({-1, 1}, c), draw({-1, 1}, c)); });
  EXPECT_EQ(elementary::hypot(0x3p800, 0x4p800), 0x5p800);
  EXPECT_EQ(elementary::hypot(kMost, kMost), kInf);
}

TEST(Elementary, Powers) {
  checkOfTwo("pow of any size", elementary::pow, mpfr_pow, 0.56, [](std::mt19937_64& c) {
    const double x = sized(c, kLeast, kMost);
    return std::pair(x, draw({-760, 760}, c) / std::log(x));
  });
  checkOfTwo("pow near one", elementary::pow, mpfr_pow, 0.56, [](std::mt19937_64& c) {
    const double x = 1 + draw({-1, 1}, c) * std::ldexp(1, -static_cast<int>(c() % 50));
    return std::pair(x, draw({-760, 760}, c) / std::log(x));
  });
  checkOfTwo("pow of small numbers", elementary::pow, mpfr_pow, 0.56,
             [](std::mt19937_64& c) { return std::pair(draw({0, 10}, c), draw({-10, 10}, c)); });
  checkOfTwo("pow, whole exponents", elementary::pow, mpfr_pow, 0.56, [](std::mt19937_64& c) {
    return std::pair(draw({-10, 10}, c), static_cast<double>(c() % 600) - 300);
  });
}

TEST(Elementary, ExactResults) {
  for (int n = -1074; n <= 1023; ++n) {
    EXPECT_EQ(elementary::pow(2, n), std::ldexp(1, n)) << n;
  }
  for (int n = -357; n <= 341; ++n) EXPECT_EQ(elementary::cbrt(std::ldexp(1, 3 * n)), std::ldexp(1, n)) << n;
  double tens = 1;
  for (int n = 0; n <= 22; ++n, tens *= 10) {
    EXPECT_EQ(elementary::log10(tens), n);
    EXPECT_EQ(elementary::pow(10, n), tens);
  }
  std::mt19937_64 chance(3);
  for (int i = 0; i < 1000; ++i) {
    const double a = static_cast<double>(chance() >> 47), b = static_cast<double>(chance() >> 38);
    EXPECT_EQ(elementary::cbrt(-a * a * a), -a) << a;
    EXPECT_EQ(elementary::pow(b, 2), b * b) << b;
    EXPECT_EQ(elementary::pow(a * a, 0.5), a) << a;
    EXPECT_EQ(elementary::hypot(5 * b, -12 * b), 13 * b) << b;
    EXPECT_EQ(elementary::sin(-b), -elementary::sin(b));
    EXPECT_EQ(elementary::cos(-b), elementary::cos(b));
  }
}

// What C's Annex F says of zeros, infinities and NaN, sign and all.
TEST(Elementary, SpecialValues) {
  const std::vector<double> special = {0.0,     -0.0,   1.0,     -1.0,   0.5,  -0.5,  2.0,         -2.0,  3.0,    -3.0,
                                       kLeast,  -kLeast, kMost,  -kMost, kInf, -kInf, kNotANumber, 1e300, 0x1p53, 2.5,
                                       -0x1p53, 1e-310};
  const auto same = [](double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) ||
           (a != 0 && std::abs(a - b) <= 4e-16 * std::abs(b));
  };
  struct One {
    const char* name;
    double (*ours)(double);
    double (*theirs)(double);
  };
  for (const One& f : {One{"sin", elementary::sin, std::sin}, One{"cos", elementary::cos, std::cos},
                       One{"tan", elementary::tan, std::tan},
                       One{"exp", elementary::exp, std::exp}, One{"log", elementary::log, std::log},
                       One{"log10", elementary::log10, std::log10}, One{"sinh", elementary::sinh, std::sinh},
                       One{"cosh", elementary::cosh, std::cosh}, One{"cbrt", elementary::cbrt, std::cbrt}})
    for (double x : special) EXPECT_TRUE(same(f.ours(x), f.theirs(x))) << f.name << "(" << x << ") = " << f.ours(x);
  struct Two {
    const char* name;
    double (*ours)(double, double);
    double (*theirs)(double, double);
  };
  for (const Two& f : {Two{"atan2", elementary::atan2, std::atan2}, Two{"pow", elementary::pow, std::pow},
                       Two{"hypot", elementary::hypot, std::hypot}})
    for (double x : special)
      for (double y : special)
        EXPECT_TRUE(same(f.ours(x, y), f.theirs(x, y))) << f.name << "(" << x << ", " << y << ") = " << f.ours(x, y);
}

// The constants again, from their meaning.
class Constant {
 public:
  Constant() : exact_(3000), rest_(3000) {}
  mpfr_ptr get() { return exact_.get(); }
  // whether the parts add up to it, but for 2^-bits of it
  ::testing::AssertionResult is(std::vector<double> parts, int bits) {
    mpfr_set(rest_.get(), exact_.get(), MPFR_RNDN);
    for (double part : parts) mpfr_sub_d(rest_.get(), rest_.get(), part, MPFR_RNDN);
    if (mpfr_zero_p(rest_.get())) return ::testing::AssertionSuccess();
    if (!mpfr_zero_p(exact_.get()) && mpfr_get_exp(exact_.get()) - mpfr_get_exp(rest_.get()) >= bits)
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "off by " << mpfr_get_d(rest_.get(), MPFR_RNDN);
  }

 private:
  Exact exact_, rest_;
};

TEST(Elementary, TablesAreWhatTheySay) {
  using namespace elementary;
  Constant c;
  Exact x(3000);
  for (int j = 0; j < 64; ++j) {
    mpfr_set_d(x.get(), j / 64.0, MPFR_RNDN);
    mpfr_exp2(c.get(), x.get(), MPFR_RNDN);
    EXPECT_TRUE(c.is({kPowersOfTwo[j][0], kPowersOfTwo[j][1]}, 105)) << j;
  }
  for (int j = 0; j < 52; ++j) {
    mpfr_set_d(x.get(), j / 64.0, MPFR_RNDN);
    mpfr_sin(c.get(), x.get(), MPFR_RNDN);
    EXPECT_TRUE(c.is({kSinesCosines[j][0], kSinesCosines[j][1]}, 105)) << j;
    mpfr_cos(c.get(), x.get(), MPFR_RNDN);
    EXPECT_TRUE(c.is({kSinesCosines[j][2], kSinesCosines[j][3]}, 105)) << j;
  }
  for (int j = 0; j < 65; ++j) {
    mpfr_set_d(x.get(), j / 64.0, MPFR_RNDN);
    mpfr_atan(c.get(), x.get(), MPFR_RNDN);
    EXPECT_TRUE(c.is({kArcTangents[j][0], kArcTangents[j][1]}, 105)) << j;
  }
  for (int i = 0; i < 128; ++i) {
    const double halved = i < 53 ? 1 : 0.5, from = (1 + i / 128.0) * halved, to = (1 + (i + 1) / 128.0) * halved;
    const double near = kLogs[i][0];
    EXPECT_EQ(near * 512, std::round(near * 512)) << i;
    EXPECT_TRUE(std::abs(near * from - 1) <= 0x1p-7 && std::abs(near * to - 1) <= 0x1p-7) << i;
    EXPECT_EQ(kLogs[i][1] * 0x1p42, std::round(kLogs[i][1] * 0x1p42)) << i;
    mpfr_set_d(x.get(), near, MPFR_RNDN);
    mpfr_log(c.get(), x.get(), MPFR_RNDN);
    mpfr_neg(c.get(), c.get(), MPFR_RNDN);
    EXPECT_TRUE(c.is({kLogs[i][1], kLogs[i][2]}, 85)) << i;
  }
  for (int s = 0; s < 3; ++s) {
    mpfr_set_d(c.get(), std::ldexp(1, s), MPFR_RNDN);
    mpfr_cbrt(c.get(), c.get(), MPFR_RNDN);
    EXPECT_TRUE(c.is({kCubeRoots[s]}, 53));
  }
}

TEST(Elementary, ConstantsAreWhatTheySay) {
  using namespace elementary;
  Constant c;
  mpfr_const_log2(c.get(), MPFR_RNDN);
  EXPECT_TRUE(c.is({kLogOfTwo[0], kLogOfTwo[1]}, 93));
  EXPECT_EQ(kLogOfTwo[0] * 0x1p42, std::round(kLogOfTwo[0] * 0x1p42));
  mpfr_div_ui(c.get(), c.get(), 64, MPFR_RNDN);
  EXPECT_TRUE(c.is({kStepOfExp[0], kStepOfExp[1]}, 87));
  EXPECT_EQ(kStepOfExp[0] * 0x1p41, std::round(kStepOfExp[0] * 0x1p41));
  mpfr_ui_div(c.get(), 1, c.get(), MPFR_RNDN);
  EXPECT_TRUE(c.is({kStepsOfExpInOne}, 53));
  mpfr_set_ui(c.get(), 10, MPFR_RNDN);
  mpfr_log(c.get(), c.get(), MPFR_RNDN);
  mpfr_ui_div(c.get(), 1, c.get(), MPFR_RNDN);
  EXPECT_TRUE(c.is({kOverLogOfTen[0], kOverLogOfTen[1]}, 105));
  mpfr_const_pi(c.get(), MPFR_RNDN);
  mpfr_div_ui(c.get(), c.get(), 2, MPFR_RNDN);
  EXPECT_TRUE(c.is({kHalfPi[0], kHalfPi[1]}, 105));
  EXPECT_TRUE(c.is({kQuarterTurn[0], kQuarterTurn[1], kQuarterTurn[2]}, 118));
  for (int part : {0, 1}) EXPECT_EQ(kQuarterTurn[part] * 0x1p66, std::round(kQuarterTurn[part] * 0x1p66));
  mpfr_ui_div(c.get(), 1, c.get(), MPFR_RNDN);
  EXPECT_TRUE(c.is({kTwoOverPi}, 53));
  for (const std::uint32_t word : kTwoOverPiBits) {
    mpfr_mul_2ui(c.get(), c.get(), 32, MPFR_RNDN);
    const double whole = static_cast<double>(word);
    mpfr_sub_d(c.get(), c.get(), whole, MPFR_RNDN);
    ASSERT_TRUE(mpfr_cmp_ui(c.get(), 0) >= 0 && mpfr_cmp_ui(c.get(), 1) < 0);
  }
}

}  // namespace
}  // namespace carom
