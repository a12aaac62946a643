// SPDX-License-Identifier: MIT
// What comments and headers state about a unit: as a length of any number of units, cut off by a limit, and followed or
// preceded by words that make something else of it.
#include <gtest/gtest.h>

#include <cstring>

#include "geometry/files/unit_statement.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

using enum LengthUnit;

void expect_unit(std::string_view comment, std::optional<LengthUnit> unit) {
    EXPECT_EQ(unit_in_comment(comment), unit) << comment;
}

const std::string kStatedTriangle = "v 0 0 0\nv 50 0 0\nv 0 40 0\nf 1 2 3\n";

}  // namespace

TEST(UnitStatement, DividesALengthByAnyNumberOfUnits) {
    for (const char* metre_of_millimetres :
         {"1,000 units = 1 m", "1000 drawing units = 1 m", "1e3 units = 1 m", "1'000 units = 1 m", "1_000 units = 1 m",
          "(1000 units = 1 m)", "scale:1000 units = 1 m", "scale: 1000 file units = 1 metre", "1000 units are 1 m",
          "1000.0 units: 1 m", "1000 units = m", "10 file units = 1 cm", "1 unit = 1,000 mm = 1 m, 2 units = 2 mm"})
        expect_unit(metre_of_millimetres, std::string_view(metre_of_millimetres).starts_with("1 unit") ? m : mm);
    expect_unit("25.4 units = 1 inch", mm);
    expect_unit("2.54 units = 1 in", cm);
    expect_unit("39.37 units = 1 m", inch);
    expect_unit("3.28084 units = 1 m", ft);
    expect_unit("12 units = 1 ft", inch);
    expect_unit("304.8 units = 1 ft", mm);
    expect_unit("100 units = 1 m", cm);
    expect_unit("one unit = 1 mm", mm);
    expect_unit("5 units = 5 mm", mm);
}

TEST(UnitStatement, TakesALengthThatStandsBeforeTheUnits) {
    expect_unit("1 mm = 1 unit", mm);
    expect_unit("1 m = 1,000 units", mm);
    expect_unit("scale: 1 inch = 25.4 drawing units", mm);
    expect_unit("0.001 m = 1 unit", mm);
    expect_unit("1 mm = 2 units", std::nullopt);
    expect_unit("1/2 mm = 1 unit", std::nullopt);
    expect_unit("1 mm = two units", std::nullopt);
    expect_unit("price in = 1 unit", std::nullopt);
}

TEST(UnitStatement, StatesNoneWhereItsNumberIsNotUnderstoodOrMakesNoUnit) {
    for (const char* odd : {"2 units = 1 mm",     "7 units = 1 m",    "1/16 units = 1 in",      "25,4 units = 1 inch",
                            "1 000 units = 1 m",  "two units = 1 m",  "a thousand units = 1 m", "10k units = 1 m",
                            "2^3 units = 1 m",    "0 units = 1 m",    "-1000 units = 1 m",      "v2 units = 1 mm",
                            "1:1000 units = 1 m", "1,00 units = 1 m", "0,001 units = 1 m",      "1 unit = 1/1000 m",
                            "1 unit = 0,001 m",   "1 unit = 10^-3 m", "1000 units per m",       "7 units = ft",
                            "7 units mm",         "1 unit = one m",   "1 unit = -1 mm"})
        expect_unit(odd, std::nullopt);
}

TEST(UnitStatement, ANumberOfSomethingElseIsNoNumberOfUnits) {
    expect_unit("SCALE=2 UNITS=in", inch);
    expect_unit("part 12, units: mm", mm);
    expect_unit("version 7 units: mm", mm);
    expect_unit("STL v2 units=mm", mm);
    expect_unit("8 parts; file units = cm", cm);
}

TEST(UnitStatement, TakesNoneFromAWordThatTheEndOfAFullHeaderCutsOff) {
    const auto header = [](std::string text, std::size_t size) {
        std::string full = std::string(size - text.size(), 'x') + text;
        full.back() = text.back();
        return full;
    };
    for (const std::string cut : {" units m", " UNITS=mm", " unit: in", " 1 mm = 1 unit"})
        EXPECT_EQ(unit_in_header(header(cut, 80)), std::nullopt) << cut;
    EXPECT_EQ(unit_in_header(header(" units m ", 80)), m);
    EXPECT_EQ(unit_in_header(header(" UNITS=mm A", 80)), mm);
    EXPECT_EQ(unit_in_header("UNITS=in" + std::string(72, ' ')), inch);
    EXPECT_EQ(unit_in_header("UNITS=in" + std::string(72, '\0')), inch);
    std::vector<std::byte> stl = binary_stl(std::vector<float>{0, 0, 0, 50, 0, 0, 0, 40, 0}, 1);
    const std::string title = header(" units m", 80);
    std::memcpy(stl.data(), title.data(), title.size());
    const auto read = import_mesh(stl, MeshFormat::stl, "cut.stl");
    ASSERT_TRUE(read) << read.error().line();
    EXPECT_EQ(read->report.size_m, Vec3(0.05, 0.04, 0.0)) << "the next letter might have been another m";
}

TEST(UnitStatement, TakesNoneFromALineThatTheLimitOfCommentsCutsOff) {
    const std::string statement = "# units mm\n";
    for (std::size_t inside = 0; inside <= statement.size() + 1; ++inside) {
        const std::string text = "#" + std::string(8190 - inside, '-') + "\n" + statement + kStatedTriangle;
        const auto unit = unit_in_comments(text);
        // The statement begins `inside` bytes before the limit; a line is whole with its end.
        EXPECT_EQ(unit.has_value(), inside >= statement.size() - 1) << inside;
        EXPECT_EQ(unit.value_or(StatedUnit{mm, ""}).unit, mm) << inside;
    }
    EXPECT_EQ(unit_in_comments("# units mm")->unit, mm) << "a text's own end cuts nothing off";
}

TEST(UnitStatement, MetresFeetAndInchesAreTheLastWordOfTheirClause) {
    for (const char* other : {"Unit: M 12 bracket", "air handling unit: FT 200", "unit: m per s", "unit: in stock",
                              "3 units in, 2 out", "Unit: M (12)", "Unit: M. Schmidt", "unit = ft lbs",
                              "units: in the box", "unit: m Pa", "unit: m^2", "unit: m squared"})
        expect_unit(other, std::nullopt);
    expect_unit("unit: m, bracket 12", m);
    expect_unit("unit: ft; bracket", ft);
    expect_unit("UNITS=m SCALE=2", m);
    expect_unit("units: m (metres)", m);
    expect_unit("units m\nmade by hand", m);
}

TEST(UnitStatement, AnotherQuantitysUnitIsNotThatOfTheCoordinates) {
    for (const char* quantity : {"time", "Pressure", "flow", "intensity", "angle", "mass", "FORCE", "temperature",
                                 "speed", "control", "air handling", "volume"}) {
        for (const char* statement : {" unit: m", " units = mm", "_unit: in", "-units mm", " unit: in, W"})
            expect_unit(std::string(quantity) + statement, std::nullopt);
    }
    expect_unit("Pressure unit: m Pa", std::nullopt);
    expect_unit("unit of time: m", std::nullopt);
    expect_unit("time unit: s, length unit: mm", mm);
}

TEST(UnitStatement, TwoUnitsOrAWordThatMakesAnotherOneStateNone) {
    for (const char* two : {"unit: mm or in", "units: mm, inches", "unit: mm and cm", "unit: mm per s", "unit: mm Hg",
                            "unit: inches per second", "unit: mm/in", "units mm or m"})
        expect_unit(two, std::nullopt);
    expect_unit("units: mm, in file 5", mm);
    expect_unit("units: mm (mm)", mm);
}

TEST(UnitStatement, TakesWhatIsMeantInOtherWords) {
    expect_unit("unit mm (millimetres)", mm);
    expect_unit("unit==mm", mm);
    expect_unit("units := cm", cm);
    expect_unit("units in: mm", mm);
    expect_unit("units are in mm", mm);
    expect_unit("unit of length: mm", mm);
    expect_unit("units of measurement = inches", inch);
    expect_unit("Length unit: mm [millimeter]", mm);
    expect_unit("units: mm exported by hand", mm);
}

}  // namespace burin::geometry::test
