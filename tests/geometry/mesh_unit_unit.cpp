// SPDX-License-Identifier: MIT
// The unit of a mesh file's numbers: given, stated or guessed, and stated by what is exported.
#include <gtest/gtest.h>

#include "geometry/files/mesh_export.hpp"
#include "geometry/files/unit_statement.hpp"
#include "tests/geometry/mesh_samples.hpp"

namespace burin::geometry::test {
namespace {

// An axis-parallel cube from the origin on, as OFF; comment: of its first line.
std::string cube_off(const std::string& side, const std::string& comment = "") {
    std::string text = "OFF" + (comment.empty() ? "" : " # " + comment) + "\n8 6 0\n";
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) text += ((corner >> axis & 1) != 0 ? side : "0") + " ";
        text += "\n";
    }
    return text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
}

ImportReport read_cube(const std::string& side, const std::string& comment = "",
                       std::optional<LengthUnit> given = std::nullopt) {
    const auto read = import_mesh(bytes_of(cube_off(side, comment)), MeshFormat::off, "cube.off", {}, given);
    EXPECT_TRUE(read) << read.error().line();
    return read ? read->report : ImportReport{};
}

}  // namespace

TEST(MeshUnit, APartInMillimetresIsNotReadAsMetres) {
    const ImportReport part = read_cube("50");
    EXPECT_EQ(part.unit.unit, LengthUnit::mm);
    EXPECT_EQ(part.unit.source, UnitSource::guessed);
    EXPECT_EQ(part.size_m, Vec3(0.05));
    EXPECT_EQ(describe_size("cube.off", part.size_m, part.unit),
              "cube.off: 50 x 50 x 50 mm (no unit that Burin knows is given in the file; read as millimetres, since "
              "its longest side is "
              "above 5; --units m reads it as metres)");
}

TEST(MeshUnit, AModelOfUpToFiveStaysInMetresAndSaysSo) {
    for (const std::string side : {"0.2", "1", "2", "5"}) {
        const ImportReport model = read_cube(side);
        EXPECT_EQ(model.unit.unit, LengthUnit::m) << side;
        EXPECT_EQ(model.size_m, Vec3(std::stod(side))) << side;
    }
    const ImportReport model = read_cube("2");
    EXPECT_EQ(describe_size("cube.off", model.size_m, model.unit),
              "cube.off: 2000 x 2000 x 2000 mm (no unit that Burin knows is given in the file; read as metres, since "
              "its longest side "
              "is at most 5; --units mm reads it as millimetres)");
}

TEST(MeshUnit, AStatedLengthOfAUnitCountsAndOneThatIsNoUnitIsNotTakenForOne) {
    EXPECT_EQ(read_cube("50", "scale: 1 unit = 0.001 m").size_m, Vec3(0.05));
    EXPECT_EQ(read_cube("50", "unit = 10 mm").size_m, Vec3(0.5));
    EXPECT_EQ(read_cube("2", "unit=25.4 mm").unit.unit, LengthUnit::inch);
    EXPECT_EQ(read_cube("2", "1 unit = .01 m").unit.unit, LengthUnit::cm);
    for (const char* odd : {"1 unit = 0.1 mm", "1 unit = 2 cm", "units 1/16 in", "units: microns", "units: km"}) {
        const ImportReport report = read_cube("50", odd);
        EXPECT_EQ(report.unit.source, UnitSource::guessed) << odd;
        EXPECT_NE(describe_size("a", report.size_m, report.unit).find("no unit that Burin knows"), std::string::npos);
    }
}

TEST(MeshUnit, WhatTheFileStatesBeatsAGuessAndWhatTheUserGivesBeatsBoth) {
    EXPECT_EQ(read_cube("3", "units mm").size_m, Vec3(3.0 / 1000.0));
    EXPECT_EQ(read_cube("50", "units m").size_m, Vec3(50.0));
    const ImportReport given = read_cube("50", "units m", LengthUnit::cm);
    EXPECT_EQ(given.size_m, Vec3(0.5));
    EXPECT_EQ(describe_size("cube.off", given.size_m, given.unit),
              "cube.off: 500 x 500 x 500 mm (read as centimetres, as --units or the recording says; the file itself "
              "says metres in line 1)");
    const ImportReport stated = read_cube("2", "units in");
    EXPECT_EQ(stated.size_m, Vec3(0.0508));
    EXPECT_EQ(describe_size("cube.off", stated.size_m, stated.unit),
              "cube.off: 50.8 x 50.8 x 50.8 mm (its numbers are inches, as the file says in line 1)");
}

TEST(MeshUnit, IsTheSizesAndNotThePlaces) {
    const auto far = import_text("v 1000 0 0\nv 1001 0 0\nv 1000 1 0\nv 0 0 0\nf 1 2 3\n", MeshFormat::obj);
    ASSERT_TRUE(far);
    EXPECT_EQ(far->report.unit.unit, LengthUnit::m);  // the fourth vertex bears no triangle
}

TEST(MeshUnit, IsUnderstoodAsProgramsWriteIt) {
    using enum LengthUnit;
    const auto expect = [](std::string_view comment, std::optional<LengthUnit> unit) {
        EXPECT_EQ(unit_in_comment(comment), unit) << comment;
    };
    expect("units mm", mm);
    expect("UNITS=mm", mm);
    expect(" File units = inches", inch);
    expect("Unit: Metres", m);
    expect("units in mm", mm);
    expect("units: in", inch);
    expect("the units are centimeters", cm);
    expect("COLOR=\x01\x02\x03\xff UNITS=ft", ft);
    expect("binary STL by Burin, in metres", m);  // as older exports have it
    expect("1000 units = 1 m", mm);
    expect("units (mm)", mm);
    expect("units: 'cm', exported 2020", cm);
    expect("UNITS=in SCALE=2", inch);
    expect("unit = 1e-3 m", mm);
    expect("unit mm.", mm);
    expect("", std::nullopt);
    expect("units", std::nullopt);
    expect("units of the lattice", std::nullopt);
    expect("made for the unit in room 5", std::nullopt);
    expect("munits mm", std::nullopt);
    // Words that go on behind what would be a unit, and words of a sentence.
    expect("Unit M-12 bracket", std::nullopt);
    expect("control unit cm4", std::nullopt);
    expect("unit ft-lbs", std::nullopt);
    expect("unit: m3", std::nullopt);
    expect("UNITS=mm2", std::nullopt);
    expect("Unit M bracket", std::nullopt);
    expect("units in stock", std::nullopt);
    expect("unit: in stock", std::nullopt);
    expect("unit in a box", std::nullopt);
    expect("unit m/s", std::nullopt);
    expect("units_mm", std::nullopt);
    expect("in-unit 5", std::nullopt);
    expect("Made by make_soccer_ball.py; metres.", std::nullopt);
}

TEST(MeshUnit, AWordThatOnlyLooksLikeAUnitChangesNoSizeInAnyFormat) {
    const std::string ascii =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 50 0 0\nvertex 0 40 0\nendloop\nendfacet\nendsolid\n";
    const std::string ply =
        "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n0 0 0\n50 0 0\n0 40 0\n3 0 1 2\n";
    for (const std::string words : {"Unit M-12 bracket", "control unit cm4", "unit ft-lbs"}) {
        const auto expect_guessed = [&](const std::string& text, MeshFormat format) {
            const auto read = import_text(text, format);
            ASSERT_TRUE(read) << read.error().line();
            EXPECT_EQ(read->report.unit.source, UnitSource::guessed) << words;
            EXPECT_EQ(read->report.size_m, Vec3(0.05, 0.04, 0.0)) << words;
        };
        expect_guessed("solid " + words + "\n" + ascii, MeshFormat::stl);
        expect_guessed("# " + words + "\nv 0 0 0\nv 50 0 0\nv 0 40 0\nf 1 2 3\n", MeshFormat::obj);
        expect_guessed("OFF # " + words + "\n3 1 0\n0 0 0\n50 0 0\n0 40 0\n3 0 1 2\n", MeshFormat::off);
        expect_guessed("ply\nformat ascii 1.0\ncomment " + words + "\n" + ply, MeshFormat::ply);
    }
}

TEST(MeshUnit, IsToldWithItsPlace) {
    TriangleMesh mesh = tetrahedron();
    const auto told = [&](MeshFormat format) {
        const auto read = import_mesh(encode_mesh(mesh, format, "export", LengthUnit::cm)->mesh, format, "export");
        return describe_size("export", read->report.size_m, read->report.unit);
    };
    const std::string size = "export: 1000 x 1000 x 1000 mm (its numbers are centimetres, as the file says ";
    EXPECT_EQ(told(MeshFormat::stl), size + "in its header)");
    EXPECT_EQ(told(MeshFormat::ply), size + "in line 4)");
    EXPECT_EQ(told(MeshFormat::obj), size + "in line 2)");
}

TEST(MeshUnit, IsReadWhereEachFormatHasRoomForIt) {
    const std::string ascii =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    const auto unit_in = [](std::string_view text, MeshFormat format) {
        const auto read = import_text(text, format);
        EXPECT_TRUE(read) << text;
        return read ? read->report.unit.stated : std::nullopt;
    };
    EXPECT_EQ(unit_in("solid part UNITS=cm\n" + ascii + "endsolid\n", MeshFormat::stl), LengthUnit::cm);
    EXPECT_EQ(unit_in("solid part\n" + ascii + "endsolid\n", MeshFormat::stl), std::nullopt);
    EXPECT_EQ(unit_in("mtllib none\n# File units = millimeters\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", MeshFormat::obj),
              LengthUnit::mm);
    const std::string ply =
        "ply\nformat ascii 1.0\n%element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    for (const std::string line : {"comment units mm\n", "obj_info units mm\n"}) {
        std::string text = ply;
        EXPECT_EQ(unit_in(text.replace(text.find('%'), 1, line), MeshFormat::ply), LengthUnit::mm) << line;
    }
}

// Round trip of each format and unit: an export states its unit, and read back it has the same size without an option.
TEST(MeshUnit, AnExportReadBackHasTheSameSize) {
    for (const LengthUnitDescriptor& unit : length_units()) {
        for (const double side_m : {0.05, 3.0}) {
            TriangleMesh mesh = tetrahedron();
            for (Vec3& p : mesh.positions_m) p *= side_m;
            for (const MeshFormat format : {MeshFormat::stl, MeshFormat::ply, MeshFormat::obj}) {
                const auto bytes = encode_mesh(mesh, format, "export", unit.unit);
                ASSERT_TRUE(bytes) << bytes.error().line();
                const auto back = import_mesh(bytes->mesh, format, "export");
                ASSERT_TRUE(back) << back.error().line();
                EXPECT_EQ(back->report.unit.source, UnitSource::stated) << unit.name;
                EXPECT_EQ(back->report.unit.unit, unit.unit);
                EXPECT_TRUE(back->report.remarks.empty());
                for (int k = 0; k < 3; ++k)  // STL and PLY hold floats
                    EXPECT_NEAR(back->report.size_m[k], side_m, side_m * (format == MeshFormat::obj ? 1e-15 : 1e-7))
                        << unit.name;
            }
        }
    }
}

// A file of decimals in a unit, read and written in the same one, has the same digits.
TEST(MeshUnit, ThroughObjInTheSameUnitDecimalsStayAsTheyAre) {
    for (const LengthUnitDescriptor& unit : length_units()) {
        std::string text = "# by Burin\n# units " + std::string(unit.name) + "\n";
        for (int i = 0; i < 600; ++i)
            text += "v " + std::to_string(i / 10) + "." + std::to_string(i % 9 + 1) + " 0 -0.1\n";
        text += "f 1 2 3\n";
        const auto read = import_text(text, MeshFormat::obj);
        ASSERT_TRUE(read) << read.error().line();
        const auto bytes = encode_mesh(read->mesh, MeshFormat::obj, "again", unit.unit);
        ASSERT_TRUE(bytes);
        EXPECT_TRUE(bytes->mesh == bytes_of(text)) << unit.name;
    }
}

}  // namespace burin::geometry::test
