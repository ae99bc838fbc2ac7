// Messages show values as {fmt} does; errors and checks carry them.
#include "paim/base/message.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim {
namespace {

// Each kind of number: what its own type shows, not what a wider one would.
TEST(Message, ShowsEveryKindOfValueAsFmtDoes) {
    const std::string text = "text";
    EXPECT_EQ(message("{} {} {}", text, std::string_view("view"), "literal"), "text view literal");
    EXPECT_EQ(message("{} {} {}", true, 'x', text.c_str()), "true x text");
    EXPECT_EQ(message("{} {}", int8_t{-65}, uint8_t{65}), "-65 65");
    EXPECT_EQ(message("{}", std::numeric_limits<int64_t>::min()), "-9223372036854775808");
    EXPECT_EQ(message("{}", std::numeric_limits<uint64_t>::max()), "18446744073709551615");
    EXPECT_EQ(message("{} {}", 0.1f, 0.1), "0.1 0.1");
    EXPECT_EQ(message("{}", double{0.1f}), fmt::format("{}", double{0.1f}));
    EXPECT_EQ(message("{} {}", std::numeric_limits<float>::infinity(), 1e300), "inf 1e+300");
}

TEST(Message, FormatsNumbersWithAPoint) {
    EXPECT_EQ(message("{:.3g} {:.0f} {:g} {:.2e}", 1234.5, 2.6f, 0.5, 1e-9),
              "1.23e+03 3 0.5 1.00e-09");
}

TEST(Message, DoubleBracesAreBraces) {
    EXPECT_EQ(message("{{{}}} {{}}", 1), "{1} {}");
    EXPECT_EQ(message("100 %"), "100 %");
}

template <typename Throw>
void expect_error(ExitCode code, const std::string& text, const Throw& fail) {
    try {
        fail();
        FAIL() << "expected an Error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), code);
        EXPECT_EQ(error.what(), text);
    }
}

TEST(Errors, CarryCodeAndMessage) {
    expect_error(ExitCode::usage, "--rays: 0", [] { throw_usage("--rays: {}", 0); });
    expect_error(ExitCode::bad_input, "x: 3 bytes, expected 4.5",
                 [] { throw_bad_input("{}: {} bytes, expected {}", "x", 3u, 4.5); });
    expect_error(ExitCode::unsupported, "version 2", [] { throw_unsupported("version {}", 2); });
    expect_error(ExitCode::output_failed, "full", [] { throw_output_failed("full"); });
}

TEST(ChecksDeathTest, PrintConditionPlaceAndValues) {
    PAIM_CHECK(true);
    PAIM_CHECK_LE(2, 2);
    EXPECT_DEATH(PAIM_CHECK(1 > 2), "message_test.cpp:[0-9]+: check failed: 1 > 2\n");
    EXPECT_DEATH(PAIM_CHECK_EQ(1u + 1u, 3u),
                 "message_test.cpp:[0-9]+: check failed: 1u \\+ 1u == 3u \\(got 2 and 3\\)\n");
}

}  // namespace
}  // namespace paim
