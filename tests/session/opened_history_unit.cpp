// SPDX-License-Identifier: MIT
// Undo and redo after a document or a journal was opened: each step gives back the rays that were there, to the bit.
#include "compute/engine/engine.hpp"
#include "session/work/opened_history.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "document/journal.hpp"
#include "record/database.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"
#include "session/work/opened_work.hpp"
#include "tests/support/run_command.hpp"
#include "toolbox/tool_options.hpp"
#include "workpiece/saved_changes.hpp"

namespace burin::session {
namespace {

constexpr std::size_t kUndo_bytes = std::size_t{64} << 20;
constexpr int kStrokes = 5;

// Work that is carved, and what its solid was after each stroke.
class OpenedHistory : public testing::Test {
protected:
    void SetUp() override {
        auto workpiece = sculpt::load_workpiece({.source = "ball:0.1", .resolution = 60, .room = 0.1}, pool);
        ASSERT_TRUE(workpiece);
        begin(std::move(workpiece->solid));
        carving->keep_history(kUndo_bytes);
    }
    void begin(compute::Solid solid) {
        carving = std::make_unique<sculpt::Sculpture>(compute::make_cpu_engine(std::move(solid), pool), pool);
    }
    // A part of a stroke; each number is at another place.
    void carve(int number) {
        const auto material = carving->add_material({"colour " + std::to_string(number), {200, 10, 10}});
        ASSERT_TRUE(material);
        toolbox::Tool tool{compute::BallTool{0.02}};
        tool.material = *material;
        const double turn = 0.7 * number;
        const Vec3 from(0.1 * std::cos(turn), 0.1 * std::sin(turn), 0.0);
        const std::array sweeps{tool.sweep(Pose{from}, Pose{from + Vec3(0.0, 0.0, 0.04)})};
        ASSERT_TRUE(carving->update(sweeps));
    }
    void stroke(int number) {
        carve(number);
        carving->end_stroke();
    }
    void strokes() {
        for (int number = 1; number <= kStrokes; ++number) {
            solids.push_back(solid());
            stroke(number);
        }
        solids.push_back(solid());
    }
    [[nodiscard]] const compute::Solid& solid() const { return carving->engine().solid(); }
    [[nodiscard]] document::Content content(bool whole = true) {
        document::Content content{.facts = {{"source", "ball:0.1"}}};
        EXPECT_TRUE(carving->save(content.parts.emplace_back(scene::Pages{.whole = whole})));
        return content;
    }
    void save() {
        const auto saved = document::write_document(path, content(), document::Place::replaced);
        ASSERT_TRUE(saved) << saved.error().line();
        version = saved->version;
    }
    void save_changes() {
        const auto saved = document::update_document(path, content(false), version);
        ASSERT_TRUE(saved) << saved.error().line();
        version = saved->version;
    }
    // Goes on with what a file holds, as another session does; returns what is told to be lost.
    std::string open(const std::string& file, std::size_t undo_bytes = kUndo_bytes) {
        Result<OpenedWork> opened = open_workpiece_of(file, undo_bytes);
        EXPECT_TRUE(opened) << opened.error().line();
        if (!opened) return "not opened";
        begin(std::move(opened->workpiece->solid));
        carving->keep_history(std::move(opened->history.value()));
        if (opened->lost.empty() && opened->journal.empty()) carving->is_saved();
        return opened->lost;
    }
    void expect_solid(std::size_t after) { EXPECT_TRUE(solid().same_content(solids.at(after))) << after; }
    // Takes back this many strokes one by one, down from the solid after `after`.
    void expect_undone(std::size_t after, std::size_t count) {
        expect_solid(after);
        for (std::size_t i = 1; i <= count; ++i) {
            ASSERT_EQ(carving->undo(1).value(), 1u) << after - i;
            expect_solid(after - i);
        }
    }
    void expect_redone(std::size_t after, std::size_t count) {
        for (std::size_t i = 1; i <= count; ++i) {
            ASSERT_EQ(carving->redo(1).value(), 1u) << after + i;
            expect_solid(after + i);
        }
    }
    void change(const std::string& sql) {
        auto database = record::Database::open(path, record::Database::Use::write);
        ASSERT_TRUE(database);
        const auto done = database->run(sql);
        ASSERT_TRUE(done) << done.error().line();
    }
    std::size_t undoable() { return carving->history()->undoable(); }

    WorkerPool pool{1};
    std::unique_ptr<sculpt::Sculpture> carving;
    std::vector<compute::Solid> solids;
    document::Version version;
    Workplace at;
    const std::string path = at / "work.burin", journal = at / "work-1.burin";
};

}  // namespace

TEST_F(OpenedHistory, TakesBackStrokesThatWereSavedAndRepeatsThem) {
    strokes();
    ASSERT_EQ(carving->undo(2).value(), 2u);
    save();
    ASSERT_EQ(open(path), "");
    expect_redone(3, 2);
    expect_undone(5, 5);
    EXPECT_EQ(carving->undo(1).value(), 0u);
    save_changes();
    ASSERT_EQ(open(path), "");
    expect_redone(0, 5);
    EXPECT_EQ(carving->redo(1).value(), 0u);
    save_changes();
    ASSERT_EQ(open(path), "");
    expect_undone(5, 5);
}

// Whoever closes the window after an undo past the opening is asked, and is not after the redo.
TEST_F(OpenedHistory, TellsTheStateThatWasOpenedFromAllOthers) {
    strokes();
    ASSERT_EQ(carving->undo(2).value(), 2u);
    save();
    ASSERT_EQ(open(path), "");
    const compute::History& history = *carving->history();
    std::set<std::uint64_t> states{history.state()};
    EXPECT_EQ(history.state(), 0u);
    while (carving->undo(1).value() > 0) EXPECT_TRUE(states.insert(history.state()).second);
    ASSERT_EQ(carving->redo(3).value(), 3u);
    EXPECT_EQ(history.state(), 0u);
    while (carving->redo(1).value() > 0) EXPECT_TRUE(states.insert(history.state()).second);
    EXPECT_EQ(states.size(), std::size_t{kStrokes} + 1);
    ASSERT_EQ(carving->undo(2).value(), 2u);
    EXPECT_EQ(history.state(), 0u);
    stroke(9);
    EXPECT_TRUE(states.insert(history.state()).second);
    ASSERT_EQ(carving->undo(1).value(), 1u);
    EXPECT_EQ(history.state(), 0u);
}

TEST_F(OpenedHistory, IsSavedAloneWhereItIsNew) {
    strokes();
    save();
    ASSERT_EQ(open(path), "");
    scene::Pages nothing{.whole = false};
    ASSERT_TRUE(carving->save(nothing));
    EXPECT_EQ(nothing.pages.size(), 1u) << "the head alone";
    EXPECT_TRUE(nothing.steps->pages.empty());
    stroke(kStrokes + 1);
    const document::Content changed = content(false);
    ASSERT_EQ(changed.parts[0].steps->pages.size(), 1u);
    EXPECT_EQ(changed.parts[0].steps->pages.begin()->first.number, kStrokes + 1);
    ASSERT_TRUE(document::update_document(path, changed, version));
    ASSERT_EQ(open(path), "");
    ASSERT_EQ(carving->undo(1).value(), 1u);
    expect_undone(5, 5);
}

TEST_F(OpenedHistory, ForgetsWhatANewStrokeHasTakenThePlaceOf) {
    strokes();
    save();
    ASSERT_EQ(carving->undo(3).value(), 3u);
    stroke(9);
    save_changes();
    ASSERT_EQ(open(path), "");
    EXPECT_EQ(carving->redo(1).value(), 0u);
    ASSERT_EQ(carving->undo(1).value(), 1u);
    expect_undone(2, 2);
    EXPECT_EQ(carving->undo(1).value(), 0u);
}

TEST_F(OpenedHistory, LosesWhatLiesBeyondADamagedStepAndNeverTheSolid) {
    strokes();
    ASSERT_EQ(carving->undo(2).value(), 2u);
    save();
    const auto expect_left = [&](const char* sql, std::size_t undo, std::size_t redo) {
        const std::string whole = at.read("work.burin");
        change(sql);
        const std::string told = open(path);
        EXPECT_TRUE(told.contains("damaged")) << sql << ": " << told;
        EXPECT_EQ(carving->history()->redoable(), redo) << sql;
        EXPECT_EQ(undoable(), undo) << sql;
        expect_undone(3, undo);
        expect_redone(3 - undo, undo + redo);
        at.write("work.burin", whole);
    };
    expect_left("UPDATE step SET crc = crc + 1 WHERE number = 2", 1, 2);
    expect_left("DELETE FROM step WHERE number = 3", 0, 2);
    expect_left("UPDATE step SET data = zeroblob(40) WHERE number = 5", 3, 1);
    expect_left("UPDATE step SET number = 9 WHERE number = 4; UPDATE step SET number = 4 WHERE number = 5", 3, 0);
    expect_left("UPDATE history SET done = 5", 0, 0);
    // What is saved then goes back no farther, and is sound.
    change("UPDATE step SET crc = crc + 1 WHERE number = 2");
    open(path);
    save_changes();
    EXPECT_EQ(open(path), "");
    EXPECT_EQ(undoable(), 1u);
}

TEST_F(OpenedHistory, OfADamagedSolidIsLeftOut) {
    strokes();
    save();
    change("UPDATE page SET crc = crc + 1 WHERE kind = 'rays x' AND number = 1");
    EXPECT_TRUE(open(path).contains("undo goes back to this opening alone"));
    EXPECT_EQ(undoable(), 0u);
    stroke(9);
    EXPECT_EQ(carving->undo(1).value(), 1u);
}

TEST_F(OpenedHistory, OfADocumentOfAnOlderProgramIsEmptyAndBegins) {
    strokes();
    save();
    change("DROP TABLE step; DROP TABLE history");
    EXPECT_EQ(open(path), "");
    EXPECT_EQ(undoable(), 0u);
    expect_solid(5);
    stroke(6);
    save_changes();
    EXPECT_EQ(open(path), "");
    ASSERT_EQ(carving->undo(1).value(), 1u);
    expect_solid(5);
}

// It knows nothing of the steps, and leaves them as they were before its strokes.
TEST_F(OpenedHistory, ThatAnOlderProgramHasSavedPastIsVoid) {
    strokes();
    save();
    change("UPDATE meta SET value = value + 1 WHERE key = 'saves'");
    ++version.saves;
    EXPECT_EQ(open(path), "");
    EXPECT_EQ(undoable(), 0u);
    stroke(6);
    save_changes();
    EXPECT_EQ(open(path), "");
    EXPECT_EQ(undoable(), 1u);
}

TEST_F(OpenedHistory, HasTheNewestStrokesThatTheMemoryTakes) {
    strokes();
    const std::size_t bytes = carving->history()->bytes();
    save();
    EXPECT_EQ(open(path, bytes / 2), "");
    EXPECT_GT(undoable(), 0u);
    EXPECT_LT(undoable(), std::size_t{kStrokes});
    expect_undone(5, undoable());
    expect_redone(5 - carving->history()->redoable(), carving->history()->redoable());
    save_changes();
    EXPECT_EQ(open(path), "");
    EXPECT_LT(undoable(), std::size_t{kStrokes}) << "the document has them no longer";
    expect_undone(5, undoable());
}

// ---- Journals

namespace {

class KeptHistory : public OpenedHistory {
protected:
    void keep() {
        carving->note_changes();
        document::Content beginning{.facts = {{document::kJournalNameFact, "work.burin"}}};
        carving->copy(beginning.parts.emplace_back());
        auto begun = document::Journal::begin(journal, beginning);
        ASSERT_TRUE(begun) << begun.error().line();
        kept.emplace(std::move(*begun));
    }
    void tell() {
        for (scene::Pages change; carving->take_change(change);)
            ASSERT_TRUE(kept->add({{.part = 0, .pages = std::move(change)}}));
    }
    // A dead session's file is as one that was closed: what differs, tests/document/journal_unit.cpp has.
    void die() {
        kept->end();
        kept.reset();
    }
    std::optional<document::Journal> kept;
};

}  // namespace

TEST_F(KeptHistory, TakesBackWhatADeadSessionHasDone) {
    stroke(7);
    save();
    ASSERT_EQ(open(path), "");
    solids = {solid()};
    keep();
    // A stroke in two parts, one as a whole, one that is taken back twice and repeated, one that was never ended.
    carve(1);
    tell();
    carve(2);
    carving->end_stroke();
    tell();
    solids.push_back(solid());
    stroke(3);
    tell();
    solids.push_back(solid());
    stroke(4);
    ASSERT_EQ(carving->undo(2).value(), 2u);
    tell();
    ASSERT_EQ(carving->redo(1).value(), 1u);
    tell();
    carve(5);
    tell();
    solids.push_back(solid());
    die();
    ASSERT_EQ(open(journal), "");
    EXPECT_EQ(carving->history()->redoable(), 0u) << "the last stroke has taken its place";
    expect_undone(3, 3);
    ASSERT_EQ(carving->undo(1).value(), 1u) << "and goes on past the save";
    EXPECT_EQ(carving->undo(1).value(), 0u);
    ASSERT_EQ(carving->redo(1).value(), 1u);
    expect_redone(0, 3);
}

TEST_F(KeptHistory, RepeatsWhatADeadSessionHadTakenBack) {
    keep();
    strokes();
    ASSERT_EQ(carving->undo(3).value(), 3u);
    tell();
    die();
    ASSERT_EQ(open(journal), "");
    expect_solid(2);
    expect_redone(2, 3);
    expect_undone(5, 5);
}

TEST_F(KeptHistory, GoesOnAfterASaveThatTheJournalHasTakenOver) {
    keep();
    strokes();
    tell();
    document::Content saved = content();
    saved.facts.clear();
    ASSERT_TRUE(kept->take_over(std::move(saved)));
    ASSERT_EQ(carving->undo(2).value(), 2u);
    tell();
    die();
    ASSERT_EQ(open(journal), "");
    expect_undone(3, 3);
    expect_redone(0, 5);
}

// Each of its changes is a step then.
TEST_F(KeptHistory, OfAnOlderProgramTakesBackChangeByChange) {
    keep();
    strokes();
    for (scene::Pages change; carving->take_change(change);) {
        change.pages.erase({"step", 0});
        ASSERT_TRUE(kept->add({{.part = 0, .pages = std::move(change)}}));
    }
    die();
    ASSERT_EQ(open(journal), "");
    expect_undone(5, 5);
}

}  // namespace burin::session
