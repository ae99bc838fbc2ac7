// Command lines that a shell reads as they were meant.
#include "analysis/trade/encode_command.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "analysis/trade/grid.h"
#include "paim/base/error.h"

namespace paim {
namespace {

// What a shell makes of a word.
std::string through_shell(const std::string& word) {
    const std::string command = "printf %s " + word;
    FILE* const pipe = ::popen(command.c_str(), "r");
    std::string text;
    std::array<char, 256> some{};
    while (const size_t count = std::fread(some.data(), 1, some.size(), pipe)) {
        text.append(some.data(), count);
    }
    EXPECT_EQ(::pclose(pipe), 0);
    return text;
}

TEST(EncodeCommand, PlainWordsStayAsTheyAre) {
    for (const std::string word : {"octopus.bake", "/a/b-c_d/x.paim", "3.5%", "a+b=c:d,e@f"}) {
        EXPECT_EQ(shell_word(word), word);
    }
}

TEST(EncodeCommand, ShellsGiveBackEveryWord) {
    for (const std::string word :
         {"two words", "it's", "''", "$HOME", "`ls`", "a\\b", "\"q\"", "~", "*", "a;b", "a&b", "#a",
          "line\nline", "ä", "{a,b}", "!x", "(x)", "<x>", "|"}) {
        EXPECT_NE(shell_word(word), word);
        EXPECT_EQ(through_shell(shell_word(word)), word);
    }
    EXPECT_EQ(shell_word(""), "''");
}

TEST(EncodeCommand, NamesEverySetting) {
    EXPECT_EQ(encode_command("d/octopus.bake", {5, "any", Preference::speed, "3.472%"}),
              "paim-compress encode d/octopus.bake -o octopus.paim --max-error 3.472% --codec any "
              "--prefer speed --bands 5");
    EXPECT_EQ(encode_command("my octopus.bake/", {3, "any", Preference::size, "5%"}),
              "paim-compress encode 'my octopus.bake/' -o 'my octopus.paim' --max-error 5% --codec "
              "any --prefer size --bands 3");
    // No option.
    EXPECT_EQ(encode_command("-x.bake", {3, "any", Preference::size, "5%"}),
              "paim-compress encode ./-x.bake -o ./-x.paim --max-error 5% --codec any --prefer "
              "size --bands 3");
}

TEST(EncodeCommand, NamesTheErrorOfTheGeometryWhereItIsNotTheDefault) {
    EXPECT_EQ(
        encode_command("x.bake", {5, "any", Preference::size, "5%", "0.025%"}),
        "paim-compress encode x.bake -o x.paim --max-error 5% --geometry-error 0.025% --codec "
        "any --prefer size --bands 5");
}

TEST(EncodeCommand, FloatsHaveNoTarget) {
    TradeSettings settings{4, "any", Preference::size, ""};
    settings.precision = Precision::f32;
    EXPECT_EQ(encode_command("x.bake", settings),
              "paim-compress encode x.bake -o x.paim --precision f32 --geometry-components all "
              "--transfer-components all --measure --bands 4");
    settings.precision = Precision::f16;
    settings.max_error = "2%";
    EXPECT_EQ(encode_command("x.bake", settings),
              "paim-compress encode x.bake -o x.paim --precision f16 --auto-transfer-error 2% "
              "--measure --bands 4");
}

TEST(EncodeCommand, AnotherBakeComesFirst) {
    EXPECT_EQ(encode_command("d/octopus.bake", {5, "any", Preference::size, "5%", "", 64}),
              "paim-compress bake POSES -o octopus-64.bake --rays 64 && paim-compress encode "
              "octopus-64.bake -o octopus.paim --max-error 5% --codec any --prefer size --bands 5");
}

TEST(EncodeCommand, FilesAreNamedAsTheirBakes) {
    EXPECT_EQ(file_stem("a/b.bake"), "b");
    EXPECT_EQ(file_stem("a/b.bake/"), "b");
    EXPECT_EQ(file_stem("a/b.c.bake"), "b.c");
    EXPECT_EQ(file_stem("a/b.bake/."), "b");
    EXPECT_EQ(file_stem("b"), "b");
}

TEST(TradeGrid, ErrorsAreReadAsTheyAreWritten) {
    EXPECT_EQ(max_error_text(0.034716), "3.472%");
    EXPECT_EQ(max_error_text(0.05), "5%");
    EXPECT_EQ(max_error_of("5%"), 0.05);
    EXPECT_EQ(max_error_of("0.05"), 0.05);
    EXPECT_THROW(max_error_of("0%"), Error);
    double before = 1.0;
    for (const std::string& error : usual_errors()) {
        EXPECT_LT(max_error_of(error), before);
        before = max_error_of(error);
    }
}

TEST(TradeGrid, UsualBandsEndAtThree) {
    EXPECT_EQ(usual_bands(5), (std::vector<uint32_t>{5, 4, 3}));
    EXPECT_EQ(usual_bands(3), (std::vector<uint32_t>{3}));
    EXPECT_EQ(usual_bands(2), (std::vector<uint32_t>{2}));
}

}  // namespace
}  // namespace paim
