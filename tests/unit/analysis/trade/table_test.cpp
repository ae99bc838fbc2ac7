// Tables of points: every number has its column, and times come last.
#include "analysis/trade/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "analysis/csv_field.h"
#include "analysis/trade/trade.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "tests/unit/analysis/trade/trade_points.h"

namespace paim {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
    return fields;
}

TradePoint example_point() {
    TradePoint point = made_up_point({4, "plain", Preference::speed, "2.5%"}, 0.0249, 123456, 42);
    const TransferEncoderType& last = transfer_encoders().back();
    for (const char* const name : last.words.numbers) point.numbers.push_back({name, 77});
    point.position_multiply_adds = 15;
    point.cpu_multiply_adds = 98765;
    point.encode_s = 1.5;
    point.shared_s = 2.5;
    point.frame_ms = 0.25;
    return point;
}

TEST(TradeTable, EveryLineHasAFieldForEachColumn) {
    const std::vector<std::string> lines = lines_of(trade_csv({example_point(), example_point()}));
    ASSERT_EQ(lines.size(), 3u);
    const std::vector<std::string> header = fields_of(lines[0]);
    EXPECT_EQ(fields_of(lines[1]).size(), header.size());
    EXPECT_EQ(lines[1], lines[2]);
    const nlohmann::ordered_json json = trade_point_json(example_point());
    ASSERT_EQ(json.size(), header.size());
    size_t column = 0;
    for (const auto& [name, value] : json.items()) {
        EXPECT_EQ(header[column].substr(0, header[column].find(" [")), name);
        ++column;
    }
}

TEST(TradeTable, NumbersAreUnderTheirNames) {
    const std::vector<std::string> lines = lines_of(trade_csv({example_point()}));
    const std::vector<std::string> header = fields_of(lines[0]), line = fields_of(lines[1]);
    const auto field = [&](const std::string& name) -> std::string {
        const auto found = std::find(header.begin(), header.end(), name);
        return found == header.end() ? "no " + name
                                     : line[static_cast<size_t>(found - header.begin())];
    };
    EXPECT_EQ(field("bands"), "4");
    EXPECT_EQ(field("codec"), "plain");
    EXPECT_EQ(field("preference"), "speed");
    EXPECT_EQ(field("max_error [fraction]"), "0.025");
    EXPECT_EQ(field("precision"), "integers");
    EXPECT_EQ(field("refined"), "no");
    EXPECT_EQ(field("size [bytes]"), "123456");
    EXPECT_EQ(field("multiply_adds [per vertex and frame]"), "42");
    EXPECT_EQ(field("position_multiply_adds [per vertex and frame]"), "15");
    EXPECT_EQ(field("cpu_multiply_adds [per frame]"), "98765");
    EXPECT_EQ(field("transfer_total_error [fraction]"), "0.0249");
    EXPECT_EQ(field("visual_error [fraction]"), "nan");
    for (const TransferEncoderType& type : transfer_encoders()) {
        for (const char* const name : type.words.numbers) EXPECT_EQ(field(name), "77");
    }
    EXPECT_EQ((std::vector<std::string>(header.end() - 4, header.end())),
              (std::vector<std::string>{"encode [s]", "shared [s]", "frame [ms]", "bake [s]"}));
    EXPECT_EQ((std::vector<std::string>(line.end() - 4, line.end())),
              (std::vector<std::string>{"1.5", "2.5", "0.25", "nan"}));
}

TEST(TradeTable, FloatsHaveNeitherPreferenceNorTarget) {
    TradePoint point = example_point();
    EXPECT_EQ(trade_point_json(point)["precision"], "integers");
    point.settings.precision = Precision::f16;
    EXPECT_EQ(trade_point_json(point)["precision"], "f16");
    EXPECT_EQ(trade_point_json(point)["preference"], "none");
    EXPECT_EQ(trade_point_json(point)["max_error"], 0.025);
    EXPECT_TRUE(std::isnan(trade_point_json(point)["geometry_error"].get<double>()));
    point.settings.max_error.clear();
    EXPECT_TRUE(std::isnan(trade_point_json(point)["max_error"].get<double>()));
}

TEST(TradeTable, WhatWasNotMeasuredIsNullInJson) {
    EXPECT_TRUE(trade_point_json(example_point())["visual_error"].is_number_float());
    EXPECT_NE(trade_point_json(example_point()).dump().find(R"("visual_error":null)"),
              std::string::npos);
}

TEST(CsvField, QuotesWhatSeparates) {
    EXPECT_EQ(csv_field("plain words"), "plain words");
    EXPECT_EQ(csv_field("a,b"), "\"a,b\"");
    EXPECT_EQ(csv_field("say \"a\""), "\"say \"\"a\"\"\"");
    EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

TEST(TradeText, RecommendsTheBestAndTheCheapest) {
    Trade trade;
    trade.points = {example_point(), example_point()};
    trade.points[1].multiply_adds = 7;
    trade.points[1].settings.preference = Preference::size;
    trade.limit = TradeLimit{TradeLimit::Of::error, 0.03};
    EXPECT_EQ(recommendation_text("x.bake", trade), "") << "nothing was found";
    trade.best = trade.cheapest = 0;
    const std::string one = recommendation_text("x.bake", trade);
    EXPECT_NE(one.find("the smallest file with a transfer error of at most 3 %:\n  paim-compress "
                       "encode x.bake -o x.paim --max-error 2.5% --codec plain --prefer speed "
                       "--bands 4\n  123456 bytes"),
              std::string::npos)
        << one;
    EXPECT_EQ(one.find("cheapest"), std::string::npos);
    EXPECT_EQ(one.find("visual"), std::string::npos);
    trade.cheapest = 1;
    const std::string two = recommendation_text("x.bake", trade);
    EXPECT_TRUE(two.starts_with(one));
    EXPECT_NE(two.find("the cheapest to play with a transfer error of at most 3 %:\n  "
                       "paim-compress encode x.bake -o x.paim --max-error 2.5% --codec plain "
                       "--prefer size --bands 4\n"),
              std::string::npos)
        << two;
    trade.limit = TradeLimit{TradeLimit::Of::bytes, 2e5};
    trade.kind = TradeError::visual;
    trade.points[0].visual_error = 0.0123;
    const std::string bytes = recommendation_text("x.bake", trade);
    EXPECT_NE(bytes.find("the smallest visual error with at most 200000 bytes:"),
              std::string::npos);
    EXPECT_NE(bytes.find("visual error 1.23 %, transfer error 2.49 %"), std::string::npos);
}

}  // namespace
}  // namespace paim
