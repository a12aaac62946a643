// SPDX-License-Identifier: MIT
#include "compute/engine/history.hpp"

#include <gtest/gtest.h>

#include "bench/measure/scenes.hpp"
#include "compute/mesher/surface.hpp"
#include "tests/compute/effort.hpp"

namespace burin::compute::test {
namespace {

Solid painted_cube(int resolution) {
    Solid solid = *make_block(Vec3(1), resolution, {"cube", {}});
    solid.materials.push_back({"paint", {200, 0, 0}});
    return solid;
}

BallSweep random_sweep(Random& random) {
    const auto anywhere = [&] {
        return Vec3(random.between(-0.1, 1.1), random.between(-0.1, 1.1), random.between(-0.1, 1.1));
    };
    BallSweep s;
    s.start_object_m = s.end_object_m = anywhere();
    if (random.chance(0.5)) s.end_object_m = anywhere();
    s.radius_m = random.between(0.01, 0.2);
    s.material = random.chance(0.5) ? 1 : 0;
    s.operation =
        std::array{Operation::cut, Operation::fill, Operation::paint}[static_cast<std::size_t>(random.small(0, 2))];
    return s;
}

// One update of a stroke, with the surface and the history brought up to date.
struct Session {
    explicit Session(Solid solid, std::size_t budget = History::kDefaultBudget_bytes)
        : surface(solid.lattice), history(budget), engine(make_cpu_engine(std::move(solid), pool)) {
        surface.mesh_all(engine->solid(), pool);
    }
    void carve(const BallSweep& sweep) {
        ASSERT_TRUE(engine->carve(std::span(&sweep, 1)).has_value());
        const Changes changes = engine->take_changes();
        surface.update(engine->solid(), changes, pool);
        history.record(changes);
    }
    bool undo() { return follow(history.undo(*engine)); }
    bool redo() { return follow(history.redo(*engine)); }
    bool follow(const Result<bool>& done) {
        EXPECT_TRUE(done.has_value());
        surface.update(engine->solid(), engine->take_changes(), pool);
        return done.has_value() && *done;
    }

    WorkerPool pool{2};
    Surface surface;
    History history;
    std::unique_ptr<CarvingEngine> engine;
};

bool same_mesh(const Surface& a, const Surface& b) {
    const geometry::TriangleMesh x = a.welded(), y = b.welded();
    return x.positions_m == y.positions_m && x.triangles == y.triangles && x.colours == y.colours;
}

}  // namespace

TEST(History, UndoOfAThousandStrokesGivesBackTheFirstSolidBitForBit) {
    const Solid start = painted_cube(kSanitized ? 32 : 64);
    Session session(start);
    const auto scene = bench::stroke_1000_scene();
    for (const BallSweep& sweep : scene.sweeps) {
        session.carve(sweep);
        session.history.end_stroke();
    }
    const Solid carved = session.engine->solid();
    EXPECT_FALSE(carved.same_content(start));
    // A stamp within what others have cut changes nothing, and makes no stroke.
    EXPECT_GT(session.history.undoable(), 900u);
    while (session.undo()) {
    }
    EXPECT_TRUE(session.engine->solid().same_content(start));
    EXPECT_EQ(session.history.undoable(), 0u);
    Surface fresh(start.lattice);
    fresh.mesh_all(start, session.pool);
    EXPECT_TRUE(same_mesh(session.surface, fresh));
    while (session.redo()) {
    }
    EXPECT_TRUE(session.engine->solid().same_content(carved));
}

TEST(History, EveryStateOnTheWayComesBackInBothDirections) {
    Random random(1);
    Session session(painted_cube(32));
    std::vector<Solid> states{session.engine->solid()};
    for (int stroke = 0; stroke < 12; ++stroke) {
        const int updates = random.small(1, 6);
        for (int i = 0; i < updates; ++i) session.carve(random_sweep(random));
        session.history.end_stroke();
        if (!session.engine->solid().same_content(states.back())) states.push_back(session.engine->solid());
    }
    std::size_t at = states.size() - 1;
    ASSERT_EQ(session.history.undoable(), at);
    for (int i = 0; i < 200; ++i) {
        const bool back = random.chance(0.5);
        const bool moved = back ? session.undo() : session.redo();
        ASSERT_EQ(moved, back ? at > 0 : at + 1 < states.size());
        if (moved) at = back ? at - 1 : at + 1;
        ASSERT_TRUE(session.engine->solid().same_content(states[at])) << i;
        ASSERT_EQ(session.history.undoable(), at);
        ASSERT_EQ(session.history.redoable(), states.size() - 1 - at);
    }
}

TEST(History, AnOpenStrokeIsClosedByUndo) {
    Random random(2);
    const Solid start = painted_cube(24);
    Session session(start);
    session.carve({Vec3(0.5), Vec3(0.6), 0.2, 0});
    session.carve({Vec3(0.6), Vec3(0.7), 0.2, 1});
    EXPECT_EQ(session.history.undoable(), 1u);
    EXPECT_TRUE(session.undo());
    EXPECT_TRUE(session.engine->solid().same_content(start));
    EXPECT_FALSE(session.undo());
}

TEST(History, ANewStrokeForgetsWhatCouldBeRedone) {
    Session session(painted_cube(24));
    session.carve({Vec3(0.5), Vec3(0.5), 0.2, 0});
    ASSERT_TRUE(session.undo());
    ASSERT_EQ(session.history.redoable(), 1u);
    session.carve({Vec3(0.2), Vec3(0.2), 0.1, 0});
    EXPECT_EQ(session.history.redoable(), 0u);
    EXPECT_FALSE(session.redo());
}

// Else strokes would be dropped although there is room, sooner the more somebody goes to and fro.
TEST(History, CountsNoMemoryThatItHasGivenBack) {
    Session session(painted_cube(24)), fresh(painted_cube(24));
    const BallSweep first{Vec3(0.5), Vec3(0.6), 0.2, 0}, second{Vec3(0.2), Vec3(0.2), 0.3, 1},
        third{Vec3(0.9), Vec3(0.9), 0.1, 0};
    for (const BallSweep& sweep : {first, second}) {
        session.carve(sweep);
        session.history.end_stroke();
    }
    const std::size_t both = session.history.bytes();
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(session.undo() && session.undo());
        ASSERT_TRUE(session.redo() && session.redo());
        ASSERT_EQ(session.history.bytes(), both) << "undone and redone " << i + 1 << " times";
    }
    ASSERT_TRUE(session.undo());
    session.carve(third);  // what could be redone is forgotten
    fresh.carve(first);
    fresh.history.end_stroke();
    fresh.carve(third);
    EXPECT_EQ(session.history.bytes(), fresh.history.bytes());
}

TEST(History, KeepsWithinItsBudgetDropsTheOldestFirstAndSaysSo) {
    Random random(3);
    constexpr std::size_t kBudget = 300'000;
    Session session(painted_cube(48), kBudget);
    std::vector<Solid> states{session.engine->solid()};
    std::size_t strokes = 0;
    while (session.history.dropped_strokes() < 5 && strokes < 500) {
        session.carve(random_sweep(random));
        session.history.end_stroke();
        ++strokes;
        if (!session.engine->solid().same_content(states.back())) states.push_back(session.engine->solid());
    }
    ASSERT_GE(session.history.dropped_strokes(), 5u);
    EXPECT_LE(session.history.bytes(), kBudget + 200'000);  // the newest stroke is kept however large
    const auto notices = session.history.take_notices();
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_NE(notices.front().find("--undo-memory"), std::string::npos) << notices.front();
    EXPECT_TRUE(session.history.take_notices().empty());
    const std::size_t kept = session.history.undoable();
    EXPECT_EQ(kept + session.history.dropped_strokes(), states.size() - 1);
    while (session.undo()) {
    }
    EXPECT_TRUE(session.engine->solid().same_content(states[states.size() - 1 - kept]));
}

}  // namespace burin::compute::test
