// Value forms on the command line: fractions, colours, sizes.
#include "paim/cli/parse.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "paim/cli/help.h"
#include "paim/cli/progress.h"

namespace paim::cli {
namespace {

TEST(ParseFraction, TakesFractionsAndPercent) {
    EXPECT_DOUBLE_EQ(parse_fraction("0.05", "--max-error"), 0.05);
    EXPECT_DOUBLE_EQ(parse_fraction("5%", "--max-error"), 0.05);
    for (const char* bad : {"", "%", "x", "-1", "nan", "inf", "1e999", "0.1x"}) {
        EXPECT_THROW(parse_fraction(bad, "--max-error"), Error) << bad;
    }
}

TEST(ParseBytes, TakesPlainBytesAndPowersOfAThousand) {
    EXPECT_EQ(parse_bytes("1", "--memory"), 1u);
    EXPECT_EQ(parse_bytes("64000000", "--memory"), 64'000'000u);
    EXPECT_EQ(parse_bytes("2K", "--memory"), 2'000u);
    EXPECT_EQ(parse_bytes("512M", "--memory"), 512'000'000u);
    EXPECT_EQ(parse_bytes("512m", "--memory"), 512'000'000u);
    EXPECT_EQ(parse_bytes("1.5G", "--memory"), 1'500'000'000u);
    EXPECT_EQ(parse_bytes("3T", "--memory"), 3'000'000'000'000u);
    for (const char* bad : {"", "M", "0", "0G", "-1G", "1e30", "9223373T", "nan", "inf", "1 G",
                            "1GB", "2X", "0x10", " 1M"}) {
        EXPECT_THROW(parse_bytes(bad, "--memory"), Error) << bad;
    }
}

TEST(ParseColor, TakesThreeOrOne) {
    EXPECT_EQ(parse_color("0.5", "--albedo"), Vec3f(0.5f, 0.5f, 0.5f));
    EXPECT_EQ(parse_color("1,0,0.25", "--albedo"), Vec3f(1.0f, 0.0f, 0.25f));
    for (const char* bad : {"", "1,2,3", "1,1", "1,1,1,1", "a,b,c", "1,,1"}) {
        EXPECT_THROW(parse_color(bad, "--albedo"), Error) << bad;
    }
}

TEST(ParseSize, TakesWholePixels) {
    EXPECT_EQ(parse_size("640x480", "--size"), std::make_pair(640, 480));
    for (const char* bad : {"", "640", "640x", "x480", "0x1", "1.5x2", "99999x1", "-1x5"}) {
        EXPECT_THROW(parse_size(bad, "--size"), Error) << bad;
    }
}

TEST(InRange, TakesWholeNumbersOrFiniteOnes) {
    const CLI::Validator whole = in_range(-2, 5);
    for (const char* good : {"-2", "0", "5"}) EXPECT_EQ(whole(good), "") << good;
    for (const char* bad : {"", "-3", "6", "1.5", "x", "5x", " 5", "99999999999"}) {
        EXPECT_EQ(whole(bad), fmt::format("expected -2 to 5, got '{}'", bad));
    }
    const CLI::Validator real = in_range(0.5, 2.0);
    for (const char* good : {"0.5", "1e0", "2"}) EXPECT_EQ(real(good), "") << good;
    for (const char* bad : {"", "0.49", "2.1", "nan", "inf", "-nan", "1,5"}) {
        EXPECT_EQ(real(bad), fmt::format("expected 0.5 to 2, got '{}'", bad));
    }
}

TEST(ParseShare, TakesWhatIsBetweenNothingAndAll) {
    EXPECT_DOUBLE_EQ(parse_share("5%", "--max-error"), 0.05);
    EXPECT_DOUBLE_EQ(parse_share("0.999", "--max-error"), 0.999);
    for (const char* bad : {"", "0", "0%", "1", "100%", "-1", "nan"}) {
        EXPECT_THROW(parse_share(bad, "--max-error"), Error) << bad;
    }
}

enum class Fruit : uint32_t { apple, pear };

TEST(AddChoice, TakesNamesAloneAndShowsThem) {
    const auto choose = [](const std::vector<const char*>& arguments, Fruit& fruit,
                           std::string& colour) {
        CLI::App app;
        add_choice<Fruit>(app, "--fruit", fruit, {{"apple", Fruit::apple}, {"pear", Fruit::pear}},
                          "What to eat");
        add_choice(app, "--colour", colour, {"red", "green"}, "Its colour");
        std::vector<const char*> line{"tool"};
        line.insert(line.end(), arguments.begin(), arguments.end());
        app.parse(static_cast<int>(line.size()), line.data());
        return app.help();
    };
    Fruit fruit = Fruit::pear;
    std::string colour = "green";
    const std::string help = choose({}, fruit, colour);
    EXPECT_EQ(fruit, Fruit::pear);
    EXPECT_NE(help.find("--fruit {apple,pear}=pear"), std::string::npos) << help;
    EXPECT_NE(help.find("--colour {red,green}=green"), std::string::npos) << help;
    choose({"--fruit", "apple", "--colour", "red"}, fruit, colour);
    EXPECT_EQ(fruit, Fruit::apple);
    EXPECT_EQ(colour, "red");
    // Neither other names nor the numbers of the values.
    for (const char* bad : {"plum", "0", "1", "", "Apple"}) {
        try {
            choose({"--fruit", bad}, fruit, colour);
            ADD_FAILURE() << "taken: " << bad;
        } catch (const CLI::ValidationError& error) {
            EXPECT_EQ(error.what(),
                      fmt::format("--fruit: expected one of apple, pear, got '{}'", bad));
        }
        EXPECT_EQ(fruit, Fruit::apple);
    }
}

TEST(Wrap, BreaksBetweenWordsAndKeepsThemAll) {
    EXPECT_EQ(wrap("", 10), "");
    EXPECT_EQ(wrap("one two", 7), "one two");
    EXPECT_EQ(wrap("one two", 6), "one\ntwo");
    EXPECT_EQ(wrap("a bb ccc dddd", 4), "a bb\nccc\ndddd");
    EXPECT_EQ(wrap("a longerthanthat b", 4), "a\nlongerthanthat\nb");
    EXPECT_EQ(wrap("a\nbb cc", 5), "a\nbb cc");  // breaks of its own start a line
}

TEST(FormatDuration, ReadsWell) {
    EXPECT_EQ(format_duration(1.23), "1.2 s");
    EXPECT_EQ(format_duration(185.0), "3 min 05 s");
    EXPECT_EQ(format_duration(7800.0), "2 h 10 min");
}

}  // namespace
}  // namespace paim::cli
