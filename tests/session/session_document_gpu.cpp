// SPDX-License-Identifier: MIT
// Documents of scripted sessions: what is saved is opened, goes on as if nothing had been between, and is converted.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "document/document_reader.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/mesh_health.hpp"
#include "geometry/mesh/mesh_placing.hpp"
#include "gpu/device.hpp"
#include "record/database.hpp"
#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"
#include "workpiece/saved_solid.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

const std::string kStroke = "0 mouse 160 90\n0.1 button press left\n0.6 mouse 175 100\n0.8 button release left\n";

class DocumentOfASession : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
    }
    Workplace::Outcome play(const std::string& workpiece, const std::string& outputs, const std::string& lines) {
        place.write("script.txt", "burin-input 1 test\n" + lines);
        return place.run(std::string(kBurinCommand) + " sculpt " + workpiece + " --offscreen --outputs " + outputs +
                         " --mouse surface --width 320 --height 180 --input script.txt");
    }
    scene::Pages pages(const std::string& name) {
        Result<document::DocumentReader> reader = document::DocumentReader::open((place / name).string());
        EXPECT_TRUE(reader) << reader.error().line();
        return *reader->pages_of(workpiece::kSolidPart);
    }
    Workplace place;
};

const std::string kBall = "ball:0.1 --resolution 64 --tool ball:0.012";

}  // namespace

TEST_F(DocumentOfASession, IsOpenedSavedAgainAndConvertedAsItWas) {
    const auto saved = play(kBall, "a",
                            kStroke +
                                "1.5 command mirror x\n1.6 command save work.burin\n1.7 command export part.ply\n"
                                "2.5 command quit\n");
    ASSERT_EQ(saved.status, 0) << saved.output;
    EXPECT_TRUE(saved.output.contains("saved work.burin")) << saved.output;
    const auto opened = play("a/work.burin", "b", "0.1 command save again.burin\n0.2 command export part.ply\n");
    ASSERT_EQ(opened.status, 0) << opened.output;
    EXPECT_EQ(pages("a/work.burin").pages, pages("b/again.burin").pages);
    EXPECT_EQ(place.read("a/part.ply"), place.read("b/part.ply"));
    const auto reader = document::DocumentReader::open((place / "b/again.burin").string());
    ASSERT_TRUE(reader);
    EXPECT_EQ(reader->commands(), document::DocumentReader::open((place / "a/work.burin").string())->commands());
    EXPECT_TRUE(std::ranges::find(reader->commands(), "tool ball:0.012") != reader->commands().end());
    EXPECT_TRUE(std::ranges::find(reader->commands(), "mirror x") != reader->commands().end());
    EXPECT_EQ(reader->fact("source"), "ball:0.1") << "from where it came is kept";
    const auto converted = place.run(std::string(kBurinCommand) + " convert a/work.burin part.ply");
    ASSERT_EQ(converted.status, 0) << converted.output;
    EXPECT_EQ(place.read("part.ply"), place.read("a/part.ply"));
    const auto told = place.run(std::string(kBurinCommand) + " info a/work.burin");
    ASSERT_EQ(told.status, 0) << told.output;
    for (const char* const part : {"ball:0.1", "--resolution 64", "tri-dexel solid", "version"})
        EXPECT_TRUE(told.output.contains(part)) << part << " in " << told.output;
}

// The bounds of its lattice, which are up to a cell larger, were told instead.
TEST_F(DocumentOfASession, IsAsLargeAsItsSolidWhenItIsOpenedAgain) {
    place.write("plate.obj",
                "# units mm\nv 0 0 0\nv 120 0 0\nv 0 80 0\nv 120 80 0\nv 0 0 9.1\nv 120 0 9.1\nv 0 80 9.1\n"
                "v 120 80 9.1\nf 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
    for (const std::string& made :
         {std::string("plate.obj --resolution 111"), std::string("ball:0.03 --resolution 96")}) {
        const std::string right = made.starts_with("ball") ? "60 x 60 x 60 mm" : "120 x 80 x 9.1 mm";
        const auto saved = play(made, "a", "0.1 command save part.burin\n");
        ASSERT_EQ(saved.status, 0) << saved.output;
        const auto opened = play("a/part.burin", "b", "0.1 command quit discard\n");
        EXPECT_TRUE(opened.output.contains("part.burin: " + right)) << opened.output;
        const auto told = place.run(std::string(kBurinCommand) + " info a/part.burin");
        EXPECT_TRUE(told.output.contains(right)) << told.output;
    }
}

// The mesh was lost.
TEST_F(DocumentOfASession, IsNotConvertedOverTheMeshOfWhichItWasMade) {
    ASSERT_EQ(
        place.run(std::string(kBurinCommand) + " sculpt --workpiece ball:0.1 --resolution 32 --export ball.stl").status,
        0);
    const std::string mesh = place.read("ball.stl");
    const auto saved = play("ball.stl --resolution 64 --tool ball:0.012", "a",
                            kStroke + "1.6 command save work.burin\n2.5 command quit\n");
    ASSERT_EQ(saved.status, 0) << saved.output;
    const auto refused = place.run(std::string(kBurinCommand) + " convert a/work.burin ball.stl");
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(refused.output.contains("ball.stl: is the mesh of which a/work.burin was made")) << refused.output;
    EXPECT_EQ(place.read("ball.stl"), mesh);
    EXPECT_EQ(place.run(std::string(kBurinCommand) + " convert a/work.burin other.stl").status, 0);
}

TEST_F(DocumentOfASession, IsConvertedToThePlaceAndTheSizeThatAreAskedFor) {
    const auto saved = play(kBall, "a", kStroke + "1.6 command save work.burin\n2.5 command quit\n");
    ASSERT_EQ(saved.status, 0) << saved.output;
    const auto converted = [&](const std::string& options) {
        const auto outcome = place.run(std::string(kBurinCommand) + " convert a/work.burin part.ply" +
                                       (options.empty() ? "" : " ") + options);
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        auto read = geometry::import_mesh(place / "part.ply", LengthUnit::m);
        return read ? std::move(read->mesh) : geometry::TriangleMesh{};
    };
    const geometry::TriangleMesh plain = converted(""), placed = converted("--place 1,-2,3 --scale 3"),
                                 mirrored = converted("--center --scale -1"), larger = converted("--scale -2");
    const Vec3 middle = geometry::bounds_of(plain).center();
    const double volume_m3 = geometry::examine(plain).signed_volume_m3;
    ASSERT_EQ(plain.positions_m.size(), placed.positions_m.size());
    ASSERT_EQ(plain.positions_m.size(), mirrored.positions_m.size());
    EXPECT_EQ(plain.colours, placed.colours);
    EXPECT_EQ(plain.colours, mirrored.colours);
    constexpr double kFloats = 1e-6;  // a few steps at 3 m
    for (std::size_t v = 0; v < plain.positions_m.size(); ++v) {
        const Vec3 from_middle = plain.positions_m[v] - middle;
        ASSERT_LT(glm::distance(placed.positions_m[v], 3.0 * from_middle + Vec3(1.0, -2.0, 3.0)), kFloats) << v;
        ASSERT_LT(glm::distance(mirrored.positions_m[v], Vec3(0.0) - from_middle), kFloats) << v;
        ASSERT_LT(glm::distance(larger.positions_m[v], -2.0 * plain.positions_m[v]), kFloats) << v;
    }
    EXPECT_NEAR(geometry::examine(placed).signed_volume_m3, 27.0 * volume_m3, 1e-4 * volume_m3);
    EXPECT_NEAR(geometry::examine(mirrored).signed_volume_m3, volume_m3, 1e-4 * volume_m3);
    EXPECT_NEAR(geometry::examine(larger).signed_volume_m3, 8.0 * volume_m3, 1e-4 * volume_m3);
}

TEST_F(DocumentOfASession, GoesOnAsIfNothingHadBeenBetween) {
    const std::string more = "1 mouse 150 80\n1.05 button press left\n1.4 mouse 165 70\n1.5 button release left\n";
    const auto through =
        play(kBall, "a", kStroke + "0.9 command save first.burin\n" + more + "2.5 command save first.burin\n");
    ASSERT_EQ(through.status, 0) << through.output;
    const auto first = play(kBall, "b", kStroke + "0.9 command save first.burin\n2.5 command quit\n");
    ASSERT_EQ(first.status, 0) << first.output;
    EXPECT_NE(pages("a/first.burin").pages, pages("b/first.burin").pages) << "the second save changed it";
    const auto saves = [&](const char* name) {
        return document::DocumentReader::open((place / name).string())->version().saves;
    };
    EXPECT_EQ(saves("a/first.burin"), 2);
    EXPECT_EQ(saves("b/first.burin"), 1);
}

TEST_F(DocumentOfASession, TakesBackAndRepeatsStrokesOfTheSessionBefore) {
    const std::string more = "1 mouse 150 80\n1.05 button press left\n1.4 mouse 165 70\n1.5 button release left\n";
    const auto first = play(kBall + " --journal j", "a",
                            "0 command export whole.ply\n" + kStroke + "0.9 command export one.ply\n" + more +
                                "2.5 command save work.burin\n2.6 command export two.ply\n3 command quit\n");
    ASSERT_EQ(first.status, 0) << first.output;
    const auto second = play("a/work.burin --journal j", "b",
                             "0.1 command undo\n0.2 command export one.ply\n1 command undo\n1.1 command export "
                             "whole.ply\n2 command redo\n2.1 command save work.burin\n2.2 command redo\n2.3 command "
                             "export two.ply\n3 command quit\n");
    ASSERT_EQ(second.status, 0) << second.output;
    for (const char* const part : {"whole.ply", "one.ply", "two.ply"})
        EXPECT_EQ(place.read(std::string("a/") + part), place.read(std::string("b/") + part)) << part;
    EXPECT_NE(place.read("b/one.ply"), place.read("b/two.ply"));
    // The redo was not saved; the next session has it from the journal, and takes it back.
    const auto third = play("b/work.burin --journal j", "c",
                            "0.1 command export two.ply\n1 command undo\n1.1 command export one.ply\n1.5 command "
                            "undo\n1.6 command export whole.ply\n2 command quit\n");
    ASSERT_EQ(third.status, 0) << third.output;
    EXPECT_TRUE(third.output.contains("has come back")) << third.output;
    for (const char* const part : {"whole.ply", "one.ply", "two.ply"})
        EXPECT_EQ(place.read(std::string("a/") + part), place.read(std::string("c/") + part)) << part;
    const auto told = place.run(std::string(kBurinCommand) + " info b/work.burin");
    EXPECT_TRUE(told.output.contains("undo: 1 stroke back, 1 forward")) << told.output;
}

TEST_F(DocumentOfASession, ThatAScriptOpensStaysAsItIs) {
    ASSERT_EQ(play(kBall, "a", "0.1 command save work.burin\n").status, 0);
    const std::string before = place.read("a/work.burin");
    const auto refused = play("a/work.burin", "a", kStroke + "1 command save work.burin\n");
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(refused.output.contains("would be overwritten")) << refused.output;
    EXPECT_EQ(place.read("a/work.burin"), before);
    EXPECT_FALSE(fs::exists(place / "a/work.burin-wal"));
}

TEST_F(DocumentOfASession, WithoutSomeOfItsRowsOrItsLogIsToldByInfo) {
    ASSERT_EQ(play(kBall, "a", "0.1 command save work.burin\n").status, 0);
    const std::string path = (place / "a/work.burin").string(), whole = place.read("a/work.burin");
    const auto told_after = [&](const std::string& sql) {
        place.write("a/work.burin", whole);
        Result<record::Database> database = record::Database::open(path, record::Database::Use::write);
        EXPECT_TRUE(database && database->run(sql)) << sql;
        if (database) {
            EXPECT_TRUE(database->close());
        }
        return place.run(std::string(kBurinCommand) + " info a/work.burin");
    };
    EXPECT_EQ(told_after("VACUUM").status, 0);
    for (const auto& [sql, words] :
         {std::pair{"DELETE FROM page WHERE kind = 'rays x' AND number = 0", "1 page is damaged"},
          std::pair{"DELETE FROM page WHERE kind = 'head'", "what it says of the whole solid"},
          std::pair{"DELETE FROM part", "holds no tri-dexel solid"},
          std::pair{"DELETE FROM page WHERE kind LIKE 'rays%'", "none of its pages"},
          std::pair{"PRAGMA journal_mode = WAL", "-wal is not beside it"}}) {
        const auto told = told_after(sql);
        EXPECT_EQ(told.status, 1) << sql << told.output;
        EXPECT_TRUE(told.output.contains("a/work.burin: ")) << told.output;
        EXPECT_TRUE(told.output.contains(words)) << sql << ": " << told.output;
    }
}

TEST_F(DocumentOfASession, KeepsTheColourOfItsTool) {
    for (const char* const colour : {"0.8,0.4,0.2", "1,0,0", "1,1,1", "0,0,0", "0.004,0.5,0.996"}) {
        fs::remove_all(place / "a");
        fs::remove_all(place / "b");
        const auto saved =
            play(kBall, "a", "0.1 command colour " + std::string(colour) + "\n0.2 command save work.burin\n");
        ASSERT_EQ(saved.status, 0) << saved.output;
        const auto again = play("a/work.burin", "b", "0.1 command save again.burin\n");
        ASSERT_EQ(again.status, 0) << colour << again.output;
        const auto commands = [&](const char* name) {
            return document::DocumentReader::open((place / name).string())->commands();
        };
        EXPECT_EQ(commands("a/work.burin"), commands("b/again.burin")) << colour;
    }
}

TEST_F(DocumentOfASession, ComesBackWithWhatWasNotSaved) {
    const std::string more = "1 mouse 150 80\n1.05 button press left\n1.4 mouse 165 70\n1.5 button release left\n";
    const std::string save = "0.9 command save work.burin\n", later = "2.5 command export part.ply\n3 command quit";
    const auto first = play(kBall + " --journal j", "a", kStroke + save + more + later + "\n");
    ASSERT_EQ(first.status, 0) << first.output;
    EXPECT_TRUE(first.output.contains("what was not saved is kept: burin sculpt j/ball-")) << first.output;
    const auto second = play("a/work.burin --journal j", "b", "0.1 command export part.ply\n0.2 command quit\n");
    ASSERT_EQ(second.status, 0) << second.output;
    EXPECT_TRUE(second.output.contains("has come back")) << second.output;
    EXPECT_EQ(place.read("b/part.ply"), place.read("a/part.ply"));
    const auto third = play("a/work.burin --journal j", "c", "0.1 command save work.burin\n0.2 command quit\n");
    EXPECT_TRUE(third.output.contains("has come back")) << "nobody has saved it: " << third.output;
    const auto fourth = play("a/work.burin --journal j", "d", "0.1 command quit discard\n");
    EXPECT_FALSE(fourth.output.contains("has come back")) << fourth.output;
    EXPECT_TRUE(fs::is_empty(place / "j"));
}

TEST_F(DocumentOfASession, WithoutANameIsToldOfAndOpensByItsJournal) {
    const auto first = play(kBall + " --journal j", "a", kStroke + "2 command export part.ply\n3 command quit\n");
    ASSERT_EQ(first.status, 0) << first.output;
    const std::string journal = fs::directory_iterator(place / "j")->path().filename().string();
    const auto other = play(kBall + " --journal j", "b", "0.1 command quit\n");
    EXPECT_TRUE(other.output.contains("is kept: burin sculpt j/" + journal)) << other.output;
    const auto again = play("j/" + journal + " --journal j", "c", "0.1 command export part.ply\n0.2 command quit\n");
    ASSERT_EQ(again.status, 0) << again.output;
    EXPECT_EQ(place.read("c/part.ply"), place.read("a/part.ply"));
    const auto thrown = play(kBall + " --journal k", "d", kStroke + "3 command quit discard\n");
    EXPECT_TRUE(fs::is_empty(place / "k")) << thrown.output;
}

TEST_F(DocumentOfASession, ComesBackWithItsNewestWorkAndNamesTheRest) {
    ASSERT_EQ(play(kBall, "a", "0.1 command save work.burin\n").status, 0);
    ASSERT_EQ(play("a/work.burin --journal j", "b", kStroke + "2 command quit\n").status, 0);
    const fs::path first = fs::directory_iterator(place / "j")->path(), aside = place / "aside.burin";
    fs::rename(first, aside);
    ASSERT_EQ(play("a/work.burin --journal j", "b", kStroke + "2 command export part.ply\n3 command quit\n").status, 0);
    // The older one is the first by its name.
    const fs::path older = place / "j/a.burin";
    fs::rename(aside, older);
    const std::string script = "0.1 command export part.ply\n0.2 command quit\n", kept = "burin sculpt j/a.burin";
    const auto opened = play("a/work.burin --journal j", "c", script);
    EXPECT_TRUE(opened.output.contains("has come back")) << opened.output;
    EXPECT_FALSE(opened.output.contains("come back from j/a.burin")) << opened.output;
    EXPECT_TRUE(opened.output.contains(kept)) << opened.output;
    EXPECT_EQ(place.read("b/part.ply"), place.read("c/part.ply"));
    // A document that was renamed meanwhile has its work as well; of one that is gone other sessions tell.
    fs::rename(place / "a/work.burin", place / "a/moved.burin");
    const auto moved = play("a/moved.burin --journal j", "d", script);
    EXPECT_TRUE(moved.output.contains("has come back") && moved.output.contains(kept)) << moved.output;
    fs::remove(place / "a/moved.burin");
    const auto other = play(kBall + " --journal j", "e", script);
    EXPECT_TRUE(other.output.contains(kept)) << other.output;
}

// The facts of a document have no check sum: a number there that no session could have saved is told, not used.
TEST_F(DocumentOfASession, WithImpossibleBoundsOrViewIsOpenedWithTheUsualOnesAndTold) {
    ASSERT_EQ(play(kBall, "a", "0.1 command save work.burin\n0.2 command export part.ply\n").status, 0);
    const auto expect_told = [&](const std::string& fact, const std::string& value, const std::string& told) {
        fs::copy_file(place / "a/work.burin", place / "bad.burin", fs::copy_options::overwrite_existing);
        {
            auto database = record::Database::open(place / "bad.burin", record::Database::Use::write);
            ASSERT_TRUE(database);
            ASSERT_TRUE(database->run("UPDATE meta SET value = '" + value + "' WHERE key = '" + fact + "'"));
        }
        const auto opened = play("bad.burin", "b", "0.1 command export part.ply\n0.2 command quit\n");
        EXPECT_EQ(opened.status, 0) << value << ": " << opened.output;
        EXPECT_TRUE(opened.output.contains(told)) << value << ": " << opened.output;
        EXPECT_EQ(place.read("a/part.ply"), place.read("b/part.ply")) << value;
    };
    for (const char* const bounds : {"0,0,0,0,0,0", "1,1,1,-1,-1,-1", "-1e300,-1,-1,1e300,1,1", "nan,0,0,1,1,1", "x"})
        expect_told("workpiece bounds m", bounds, "bounds are damaged");
    for (const char* const view : {"0,0,0,1e200,1e200,0,0,1", "0,0,0,0,0,0,0,1", "1e300,0,0,1,0,0,0,1",
                                   "0,0,0,1,0,0,0,0", "0,0,0,1,0,0,0,1e200", "0,0,0,1,0,0,0,-1", "x"})
        expect_told("view", view, "view is damaged");
}

TEST_F(DocumentOfASession, WhoseToolIsAMeshThatIsGoneOpensWithTheUsualToolAndTells) {
    place.write("t.obj", "v 0 0 0\nv 0.01 0 0\nv 0 0.01 0\nv 0 0 0.01\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
    const std::string save = "0.1 command save work.burin\n", leave = "0.2 command quit\n";
    const auto saved = play("ball:0.1 --units m --resolution 64 --tool mesh:t.obj", "a", save + leave);
    ASSERT_EQ(saved.status, 0) << saved.output;
    const auto there = play("a/work.burin", "b", leave);
    EXPECT_EQ(there.status, 0) << there.output;
    EXPECT_FALSE(there.output.contains("the usual one")) << there.output;
    fs::remove(place / "t.obj");
    const auto gone = play("a/work.burin", "c", leave);
    EXPECT_EQ(gone.status, 0) << gone.output;
    EXPECT_TRUE(gone.output.contains("its tool mesh:t.obj cannot be taken up, the usual one is")) << gone.output;
}

TEST_F(DocumentOfASession, ThatIsNoneIsRefusedInOneLine) {
    place.write("bad.burin", std::string(3000, 'x'));
    const auto refused = play("bad.burin", "a", "0.1 command quit\n");
    EXPECT_EQ(refused.status, 1);
    EXPECT_TRUE(refused.output.contains("bad.burin: is not an SQLite file; name a document")) << refused.output;
}

}  // namespace burin::session
