// SPDX-License-Identifier: MIT
#include "sculpt/stroke_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/run_command.hpp"

namespace burin::sculpt {
namespace {

const std::string kHeader = "time_s,x_m,y_m,z_m,qx,qy,qz,qw,button\n";

std::string complaint(const std::string& text) {
    const auto stroke = parse_stroke(text, "s.csv");
    return stroke ? "" : stroke.error().line();
}

}  // namespace

TEST(StrokeFile, ReadsRowsCommentsBlanksAndCarriageReturns) {
    const auto stroke = parse_stroke(
        "# a comment\r\ntime_s, x_m, y_m, z_m, qx, qy, qz, qw, button\r\n\r\n"
        "0, 0.1, -0.2, 3e-1, 0, 0, 0, 2, 0\r\n# more\r\n0.5,1,2,3,0,0,0,1,1",
        "s.csv");
    ASSERT_TRUE(stroke) << stroke.error().line();
    ASSERT_EQ(stroke->size(), 2u);
    EXPECT_EQ((*stroke)[0].position_object_m, Vec3(0.1, -0.2, 0.3));
    EXPECT_DOUBLE_EQ(glm::length((*stroke)[0].orientation_object), 1.0);  // normalised
    EXPECT_FALSE((*stroke)[0].button);
    EXPECT_TRUE((*stroke)[1].button);
}

TEST(StrokeFile, IsReadWithQuotesAndWithSemicolonsOrTabsBetweenItsColumns) {
    const std::string commas = kHeader + "0,0,0.12,0,0,0,0,1,1\n1,0.05,0.09,0,0,0,0,1,1\n";
    std::string quoted = "\"", semicolons = commas, tabs = commas;
    for (const char c : commas) quoted += c == ',' ? "\",\"" : c == '\n' ? "\"\n\"" : std::string(1, c);
    quoted.pop_back();
    std::ranges::replace(semicolons, ',', ';');
    std::ranges::replace(tabs, ',', '\t');
    for (const std::string& text : {commas, quoted, semicolons, tabs, "sep=;\n" + semicolons, "sep=,\n" + commas}) {
        const auto stroke = parse_stroke(text, "s.csv");
        ASSERT_TRUE(stroke) << text << stroke.error().line();
        ASSERT_EQ(stroke->size(), 2u) << text;
        EXPECT_EQ((*stroke)[1].position_object_m, Vec3(0.05, 0.09, 0.0));
        EXPECT_TRUE((*stroke)[1].button);
    }
    std::string wrong = semicolons;
    wrong.replace(wrong.find("0.12"), 4, "0,12");
    EXPECT_NE(complaint(wrong).find("a decimal point and between them a semicolon"), std::string::npos)
        << complaint(wrong);
    EXPECT_NE(complaint(kHeader + "0,0,0.12,0,0,0,0,1,\"1\n").find("s.csv:2: does not hold nine"), std::string::npos);
}

TEST(StrokeFile, ReadsTurnsAsAxisAndAngle) {
    const std::string header = "time_s,x_m,y_m,z_m,axis_x,axis_y,axis_z,angle_rad,button\n";
    const auto stroke = parse_stroke(header + "0,1,2,3,0,0,5,1.5707963267948966,1\n1,1,2,3,0,0,0,0,0\n", "s.csv");
    ASSERT_TRUE(stroke) << stroke.error().line();
    const Vec3 turned = (*stroke)[0].orientation_object * Vec3(1.0, 0.0, 0.0);
    EXPECT_LT(glm::length(turned - Vec3(0.0, 1.0, 0.0)), 1e-15) << "a quarter turn about z takes x to y";
    EXPECT_TRUE((*stroke)[0].button);
    EXPECT_EQ((*stroke)[1].orientation_object, Quat(1.0, 0.0, 0.0, 0.0)) << "no angle needs no axis";
    EXPECT_NE(complaint(header + "0,0,0,0,0,0,0,1,0\n").find("s.csv:2: its axis has no length"), std::string::npos);
    EXPECT_NE(complaint(header + "0,0,0\n").find("angle_rad"), std::string::npos) << "its own columns are named";
}

TEST(StrokeFile, NamesTheLineOfEveryKindOfMistake) {
    EXPECT_NE(complaint("").find("s.csv"), std::string::npos);
    EXPECT_NE(complaint("x,y\n").find("s.csv:1"), std::string::npos);
    EXPECT_NE(complaint(kHeader).find("holds no stroke"), std::string::npos);
    const std::string good = "0,0,0,0,0,0,0,1,0\n";
    for (const std::string bad : {"1,0,0,0,0,0,0,1\n", "1,0,0,0,0,0,0,1,0,0\n", "1,0,0,zero,0,0,0,1,0\n",
                                  "1,,0,0,0,0,0,1,0\n", "1,0,0,0 0,0,0,0,1,0\n"}) {
        EXPECT_NE(complaint(kHeader + good + bad).find("s.csv:3: does not hold nine numbers"), std::string::npos)
            << bad;
    }
    for (const std::string bad :
         {"1,nan,0,0,0,0,0,1,0\n", "1,0,inf,0,0,0,0,1,0\n", "inf,0,0,0,0,0,0,1,0\n", "1,1e300,0,0,0,0,0,1,0\n"}) {
        EXPECT_NE(complaint(kHeader + good + bad).find("s.csv:3: holds a number"), std::string::npos) << bad;
    }
    EXPECT_NE(complaint(kHeader + good + good).find("s.csv:3: its time"), std::string::npos);
    EXPECT_NE(complaint(kHeader + good + "1e-10,0,0,0,0,0,0,1,0\n").find("s.csv:3: its time"), std::string::npos);
    EXPECT_NE(complaint(kHeader + "1,0,0,0,0,0,0,1,0\n0,0,0,0,0,0,0,1,0\n").find("s.csv:3: its time"),
              std::string::npos);
    // Times in milliseconds: a hand that feels its way would have gone on for weeks.
    EXPECT_NE(
        complaint(kHeader + "-5,0,0,0,0,0,0,1,0\n86396,0,0,0,0,0,0,1,0\n").find("s.csv:3: its time is more than a"),
        std::string::npos);
    EXPECT_EQ(complaint(kHeader + "-5,0,0,0,0,0,0,1,0\n86395,0,0,0,0,0,0,1,0\n"), "");
    EXPECT_NE(complaint(kHeader + "0,0,0,0,0,0,0,0,0\n").find("quaternion"), std::string::npos);
    EXPECT_NE(complaint(kHeader + "0,0,0,0,0,0,0,1,0.5\n").find("button"), std::string::npos);
}

TEST(StrokeFile, IsReadAfterAByteOrderMarkAndWithAnyLineEnds) {
    const Workplace place;
    for (const std::string mark : {"", "\xEF\xBB\xBF"}) {
        for (const std::string end : {"\n", "\r\n", "\r"}) {
            const std::string header = kHeader.substr(0, kHeader.size() - 1);
            place.write("s.csv", mark + header + end + "0,0,0,0,0,0,0,1,0" + end + "1,7,0,0,0,0,0,1,1" + end);
            const auto stroke = read_stroke(place / "s.csv");
            ASSERT_TRUE(stroke) << stroke.error().line();
            ASSERT_EQ(stroke->size(), 2u);
            EXPECT_EQ((*stroke)[1].position_object_m.x, 7.0);
            place.write("s.csv", mark + header + end + "0,0,0,0,0,0,0,1,0" + end + "1,7" + end);
            EXPECT_NE(read_stroke(place / "s.csv").error().line().find("s.csv:3: "), std::string::npos);
        }
    }
    place.write("s.csv", std::string("\xFF\xFEt\0i\0", 6));
    EXPECT_NE(read_stroke(place / "s.csv").error().line().find("is UTF-16 text; save it as UTF-8"), std::string::npos);
}

TEST(StrokeFile, MissingFileIsNamed) {
    const auto stroke = read_stroke("no/such/stroke.csv");
    ASSERT_FALSE(stroke);
    EXPECT_NE(stroke.error().line().find("no/such/stroke.csv"), std::string::npos);
}

}  // namespace burin::sculpt
