// BRDFs in words.
#include "compressor/material/brdfs.h"

#include <gtest/gtest.h>

#include <string>

#include "paim/base/error.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

std::string error_of(const std::string& text) {
    try {
        parse_brdf(text);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        return error.what();
    }
    return "";
}

TEST(Brdfs, ShortestTextMakesTheSameBrdf) {
    add_lambertian();
    for (const char* text : {"phong:0.5,32", "phong:0.1,1", "cook-torrance:0.04,0.3",
                             "cook-torrance:1,0.02", "lambertian:0.25", "phong:0,10000"}) {
        EXPECT_EQ(parse_brdf(text)->text(), text);
    }
    EXPECT_EQ(parse_brdf("phong:0.50,3.2e1")->text(), "phong:0.5,32");
    EXPECT_EQ(parse_brdf("phong:-0,32")->text(), "phong:0,32");
}

TEST(Brdfs, ErrorsSayWhatIsWrong) {
    EXPECT_NE(error_of("blinn:1,2").find("phong, cook-torrance"), std::string::npos);
    EXPECT_NE(error_of("phong:0.5").find("phong:ks,n"), std::string::npos);
    EXPECT_NE(error_of("phong").find("phong:ks,n"), std::string::npos);
    EXPECT_NE(error_of("phong:0.5,32,1").find("phong:ks,n"), std::string::npos);
    EXPECT_NE(error_of("phong:0.5,").find("missing"), std::string::npos);
    EXPECT_NE(error_of("phong:0.5,3x").find("\"3x\""), std::string::npos);
    EXPECT_NE(error_of("phong:1.5,32").find("ks is 1.5, expected 0 to 1"), std::string::npos);
    EXPECT_NE(error_of("phong:nan,32").find("ks"), std::string::npos);
    EXPECT_NE(error_of("cook-torrance:0.5,0.01").find("roughness"), std::string::npos);
    EXPECT_NE(error_of("").find("phong"), std::string::npos);
    std::string many = "phong:";
    many.append(100'000, ',');
    EXPECT_NE(error_of(many).find("not a number"), std::string::npos);
}

}  // namespace
}  // namespace paim
