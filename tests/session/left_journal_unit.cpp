// SPDX-License-Identifier: MIT
// The only copy of somebody's work: the journal of a session that died goes once the next session's has all of it, and
// in every other case it stays as it is, to the byte.
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <memory>

#include "compute/engine/engine.hpp"
#include "document/journal.hpp"
#include "record/database.hpp"
#include "scene/saved_objects.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"
#include "session/live/document_side.hpp"
#include "session/work/journal_folder.hpp"
#include "session/work/saved_world.hpp"
#include "tests/support/run_command.hpp"
#include "toolbox/tool_options.hpp"

namespace burin::session {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kUndoOfLeft_bytes = std::size_t{16} << 20;
constexpr int kLeftStrokes = 4;

// A journal of a dead session in a folder of its own, the document that it goes on from, and the next session.
class LeftBehind : public testing::Test {
protected:
    // Damages the journal, has a session go on with it, save and end; returns whether the old journal is as it was.
    // by_name: it is opened by its own name, not by the document's.
    bool stays_after(const std::function<void()>& damage, bool by_name) {
        fs::remove_all(place / "j");
        fs::create_directory(place / "j");
        place.write("j/left-1.burin", file);
        place.write("work.burin", document_file);
        if (!log.empty()) place.write("j/left-1.burin-wal", log);
        damage();
        const std::string before = place.read("j/left-1.burin"), log_before = place.read("j/left-1.burin-wal");
        opened = open_document_and_journal(by_name ? journal : document, folder, kUndoOfLeft_bytes);
        if (opened) go_on();
        return place.read("j/left-1.burin") == before && place.read("j/left-1.burin-wal") == log_before &&
               fs::exists(journal);
    }
    void sql(const std::string& text) const {
        auto database = record::Database::open(journal, record::Database::Use::write);
        ASSERT_TRUE(database);
        const auto done = database->run(text);
        ASSERT_TRUE(done) << text << ": " << done.error().line();
        EXPECT_EQ(database->integer("SELECT changes()").value_or(0) > 0, true) << text << " has changed nothing";
        ASSERT_TRUE(database->close());
    }
    // What a session does with what it has opened: it keeps a journal of it, works, saves and ends.
    void go_on() {
        DocumentSide side;
        if (opened->version) side.opened(opened->document, *opened->version);
        document::Content now;
        now.parts.push_back({.part = "a thing", .pages = {{{"head", 0}, {std::byte{1}}}}});
        ASSERT_TRUE(side.keep_journal(folder, SessionSetup{}, *opened, now));
        side.writer().note({.part = 0, .pages = {.part = "a thing", .whole = false, .pages = {{{"rays", 0}, {}}}}});
        side.writer().save({.path = (place / "other.burin").string(), .name = "other.burin", .content = now});
        side.finish();
        EXPECT_EQ(side.end_journal(false), "") << "all is saved";
        fs::remove(place / "other.burin");
    }
    void keep(document::Journal& kept) {
        log.clear();
        if (leaves_log) {
            file = place.read("made-1.burin");
            log = place.read("made-1.burin-wal");
        }
        kept.end();
        if (!leaves_log) file = place.read("made-1.burin");
        fs::remove(place / "made-1.burin");
    }
    document::Content beginning(const document::Version& version) const {
        return {.facts = {{document::kJournalNameFact, "work.burin"},
                          {document::kJournalOfFact, document},
                          {document::kBaseIdFact, version.id},
                          {document::kBaseSavesFact, std::to_string(version.saves)}}};
    }

    Workplace place;
    const std::string document = place / "work.burin", folder = place / "j", journal = place / "j/left-1.burin",
                      made = place / "made-1.burin";
    bool leaves_log = false;  // as one that was killed does
    std::string document_file, file, log;
    Result<OpenedWork> opened = fail("nothing", "was opened");
};

class LeftSolid : public LeftBehind {
protected:
    // last: one more change, of whatever kind.
    void leave(const std::function<void(document::Journal&)>& last = {}) {
        auto workpiece = sculpt::load_workpiece({.source = "ball:0.05", .resolution = 20, .room = 0.1}, pool);
        ASSERT_TRUE(workpiece);
        sculpt::Sculpture carving(compute::make_cpu_engine(std::move(workpiece->solid), pool), pool);
        carving.keep_history(kUndoOfLeft_bytes);
        carve(carving, 0);
        fs::remove(document);
        document::Content content;
        ASSERT_TRUE(carving.save(content.parts.emplace_back()));
        const auto saved = document::write_document(document, content, document::Place::nothing);
        ASSERT_TRUE(saved) << saved.error().line();
        document_file = place.read("work.burin");
        carving.note_changes();
        document::Content start = beginning(saved->version);
        carving.copy(start.parts.emplace_back());
        auto kept = document::Journal::begin(made, start);
        ASSERT_TRUE(kept) << kept.error().line();
        for (int number = 1; number <= kLeftStrokes; ++number) {
            carve(carving, number);
            for (scene::Pages change; carving.take_change(change);)
                ASSERT_TRUE(kept->add({{.part = 0, .pages = std::move(change)}}));
        }
        if (last) last(*kept);
        whole = std::make_unique<compute::Solid>(carving.engine().solid());
        keep(*kept);
    }
    void carve(sculpt::Sculpture& carving, int number) {
        const toolbox::Tool tool{compute::BallTool{0.01}};
        const double turn = 0.9 * number;
        const Vec3 from(0.05 * std::cos(turn), 0.05 * std::sin(turn), 0.0);
        const std::array sweeps{tool.sweep(Pose{from}, Pose{from + Vec3(0.0, 0.0, 0.02)})};
        ASSERT_TRUE(carving.update(sweeps));
        carving.end_stroke();
    }
    [[nodiscard]] bool is_whole() const {
        return opened && opened->workpiece && opened->workpiece->solid.same_content(*whole);
    }
    WorkerPool pool{1};
    std::unique_ptr<compute::Solid> whole;
};

}  // namespace

TEST_F(LeftSolid, GoesWhereTheNextSessionHasAllOfIt) {
    for (const bool logged : {false, true}) {
        leaves_log = logged;
        leave();
        ASSERT_EQ(log.empty(), !logged);
        for (const bool by_name : {false, true}) {
            EXPECT_FALSE(stays_after([] {}, by_name)) << logged << by_name;
            EXPECT_TRUE(is_whole()) << logged << by_name;
            EXPECT_FALSE(fs::exists(journal) || fs::exists(journal + "-wal")) << logged << by_name;
        }
    }
}

TEST_F(LeftSolid, OfWhichSomethingIsDamagedStays) {
    leave();
    std::vector<std::string> damages{"UPDATE change SET kind = 'never heard of' WHERE number = 2 AND kind = 'rays'",
                                     "UPDATE change SET data = zeroblob(9) WHERE number = 2",
                                     "UPDATE change SET bytes = bytes + 4 WHERE number = 4",
                                     "UPDATE change SET part = 7 WHERE number = 3",
                                     "UPDATE change SET number = 9 WHERE number = 4",
                                     "UPDATE page SET crc = crc + 1 WHERE kind = 'rays x' AND number = 0",
                                     "UPDATE page SET crc = crc + 1 WHERE kind = 'rays z' AND number = 0",
                                     "DELETE FROM page WHERE kind = 'rays y'",
                                     "DELETE FROM page WHERE kind = 'head'",
                                     "DELETE FROM part",
                                     "UPDATE history SET done = done + 5",
                                     "UPDATE step SET crc = crc + 1",
                                     "INSERT INTO meta VALUES('view', '0,0,0,0,0,0,0,1')",
                                     "INSERT INTO meta VALUES('workpiece bounds m', 'x')"};
    for (int number = 1; number <= kLeftStrokes; ++number) {
        damages.push_back("UPDATE change SET crc = crc + 1 WHERE number = " + std::to_string(number));
        if (number < kLeftStrokes)  // without the last it is whole
            damages.push_back("DELETE FROM change WHERE number = " + std::to_string(number));
    }
    bool by_name = false;  // by turns: that it stays does not depend on how it was opened
    for (const std::string& damage : damages) {
        EXPECT_TRUE(stays_after([&] { sql(damage); }, by_name)) << damage << ", by its name: " << by_name;
        by_name = !by_name;
    }
}

TEST_F(LeftSolid, WithAChangeOfAnUnknownKindStays) {
    leave([](document::Journal& kept) {
        scene::Pages unknown{.part = "tri-dexel solid", .whole = false};
        unknown.pages[{"never heard of", 0}] = std::vector<std::byte>(40);
        ASSERT_TRUE(kept.add({{.part = 0, .pages = unknown}}));
    });
    for (const bool by_name : {false, true}) EXPECT_TRUE(stays_after([] {}, by_name)) << by_name;
}

TEST_F(LeftSolid, ThatGoesOnFromAnotherStateOfTheDocumentStays) {
    leave();
    for (const char* const damage : {"UPDATE meta SET value = 'another' WHERE key = 'journal base'",
                                     "UPDATE meta SET value = '2' WHERE key = 'journal base saves'"}) {
        EXPECT_TRUE(stays_after([&] { sql(damage); }, false)) << damage;
        ASSERT_TRUE(opened);
        EXPECT_EQ(opened->journal, "");
        ASSERT_EQ(opened->kept.size(), 1u) << damage;
        EXPECT_TRUE(opened->kept[0].contains("left-1.burin")) << opened->kept[0];
        EXPECT_FALSE(stays_after([&] { sql(damage); }, true)) << "by its own name it is whole";
        EXPECT_TRUE(is_whole());
    }
}

// Whatever becomes of its bytes: it goes only where the session that has opened it has all of it.
TEST_F(LeftSolid, WithWrongBytesStaysOrHasBeenReadWhole) {
    constexpr int kPlaces = 24;
    int stayed = 0;
    for (const bool logged : {false, true}) {
        leaves_log = logged;
        leave();
        const std::string name = logged ? "j/left-1.burin-wal" : "j/left-1.burin";
        const std::string sound = logged ? log : file;
        for (int part = 0; part < kPlaces; ++part) {
            const auto flip = [&] {
                std::string bytes = sound;
                bytes[bytes.size() * static_cast<std::size_t>(part) / kPlaces + 17] ^= 32;
                place.write(name, bytes);
            };
            const bool stays = stays_after(flip, part % 2 == 0);
            stayed += stays ? 1 : 0;
            EXPECT_TRUE(stays || is_whole()) << name << " at " << part << " of " << kPlaces;
        }
    }
    EXPECT_GT(stayed, kPlaces / 2) << "else hardly anything was damaged";
}

TEST_F(LeftSolid, WhoseEndWasCutOffStays) {
    leave();
    for (const std::size_t cut : {std::size_t{4096}, file.size() / 3, file.size() / 2, file.size() - 600})
        for (const bool by_name : {false, true})
            EXPECT_TRUE(stays_after([&] { place.write("j/left-1.burin", file.substr(0, file.size() - cut)); }, by_name))
                << cut;
}

TEST_F(LeftSolid, WithoutItsLogStays) {
    leaves_log = true;
    leave();
    for (const bool by_name : {false, true})
        EXPECT_TRUE(stays_after([&] { fs::remove(journal + "-wal"); }, by_name)) << by_name;
}

// ---- Worlds

namespace {

class LeftWorld : public LeftBehind {
protected:
    void leave() {
        auto mesh = std::make_shared<geometry::TriangleMesh>();
        mesh->positions_m = {{0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {0.0, 0.1, 0.0}, {0.0, 0.0, 0.1}};
        mesh->triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        WorldObjects now;
        for (scene::ObjectId id = 1; id <= 2; ++id) {
            scene::SceneObject object;
            object.id = id;
            object.name = "thing " + std::to_string(id);
            object.mesh = mesh;
            now.objects.push_back(std::make_shared<const scene::SceneObject>(object));
        }
        SavedWorld world;
        world.begin(now, {}, false);
        document::Content content;
        content.parts.push_back(world.all(now, {}));
        const auto saved = document::write_document(document, content, document::Place::replaced);
        ASSERT_TRUE(saved) << saved.error().line();
        document_file = place.read("work.burin");
        document::Content start = beginning(saved->version);
        start.parts.push_back(world.all(now, {}));
        auto kept = document::Journal::begin(made, start);
        ASSERT_TRUE(kept) << kept.error().line();
        for (int number = 1; number <= kLeftStrokes; ++number) {
            auto edited = std::make_shared<scene::SceneObject>(*now.objects[1]);
            edited->scale = 1.0 + 0.1 * number;
            now.objects[1] = edited;
            auto change = world.take_change(now, {});
            ASSERT_TRUE(change);
            ASSERT_TRUE(kept->add({{.part = 0, .pages = std::move(*change)}}));
        }
        keep(*kept);
    }
    [[nodiscard]] double scale() const { return opened && opened->world ? opened->world->objects.at(1).scale : 0.0; }
};

}  // namespace

TEST_F(LeftWorld, GoesWhereTheNextSessionHasAllOfItAndStaysWhereSomethingIsDamaged) {
    leave();
    std::vector<std::string> damages{"UPDATE change SET kind = 'changed object 7' WHERE number = 2",
                                     "DELETE FROM change WHERE number = 2",
                                     "UPDATE change SET part = 7 WHERE number = 3",
                                     "UPDATE page SET crc = crc + 1 WHERE kind = 'object' AND number = 1",
                                     "DELETE FROM page WHERE kind = 'object' AND number = 2"};
    for (int number = 1; number <= kLeftStrokes; ++number)
        damages.push_back("UPDATE change SET crc = crc + 1 WHERE number = " + std::to_string(number));
    for (const bool by_name : {false, true}) {
        EXPECT_FALSE(stays_after([] {}, by_name)) << by_name;
        EXPECT_DOUBLE_EQ(scale(), 1.0 + 0.1 * kLeftStrokes);
        for (const std::string& damage : damages)
            EXPECT_TRUE(stays_after([&] { sql(damage); }, by_name)) << damage << ", by its name: " << by_name;
    }
}

}  // namespace burin::session
