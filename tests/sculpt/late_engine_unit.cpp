// SPDX-License-Identifier: MIT
// A session in real time whose engine is late, as a device is: what it has not done is left to later updates, as each
// notes, and done again from these notes with an engine that is never late everything is the same after every update.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "compute/engine/engine.hpp"
#include "haptics/channels.hpp"
#include "sculpt/carved_scene.hpp"
#include "sculpt/sculpture.hpp"

namespace burin::sculpt {
namespace {

// Says of each update so many times that it is not done.
class LateEngine final : public compute::CarvingEngine {
public:
    LateEngine(std::unique_ptr<compute::CarvingEngine> engine, int times_late)
        : engine_(std::move(engine)), times_late_(times_late), left_(times_late) {}

    [[nodiscard]] const char* name() const override { return "late"; }
    [[nodiscard]] Result<compute::Ticket> begin(std::span<const compute::ToolSweep> sweeps) override {
        return engine_->begin(sweeps);
    }
    [[nodiscard]] Result<compute::Ticket> begin(compute::RayBatch rays) override {
        return engine_->begin(std::move(rays));
    }
    [[nodiscard]] Result<std::optional<compute::Delta>> take(compute::Wait wait) override {
        if (wait != compute::Wait::yes && left_-- > 0) return std::nullopt;
        left_ = times_late_;
        return engine_->take(compute::Wait::yes);
    }
    [[nodiscard]] std::size_t under_way() const override { return engine_->under_way(); }
    [[nodiscard]] const compute::Solid& solid() const override { return engine_->solid(); }
    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) override {
        return engine_->add_material(material);
    }

private:
    std::unique_ptr<compute::CarvingEngine> engine_;
    int times_late_, left_;
};

// Carves a ball by hand-made samples, and keeps what there is after each update.
struct LateBench {
    WorkerPool pool{1};
    Sculpture carving;
    haptics::HapticChannels channels;
    CarvedScene desk;
    std::uint64_t ticks = 0;
    std::vector<scene::SceneUpdate> seen;
    std::vector<geometry::TriangleMesh> surfaces;
    std::vector<std::uint64_t> states;  // of the history

    explicit LateBench(int times_late)
        : carving(engine(pool, times_late), pool),
          desk(carving, channels, {compute::BallTool{0.02}}, 0.0, 0.02, 1 << 24) {}
    static std::unique_ptr<compute::CarvingEngine> engine(WorkerPool& pool, int times_late) {
        auto processor = compute::make_cpu_engine(*compute::make_ball(0.1, 32, {"skin"}), pool);
        if (times_late == 0) return processor;
        return std::make_unique<LateEngine>(std::move(processor), times_late);
    }

    // Update `number` of two strokes, an undo, a redo and a third stroke; as it was recorded, where it was.
    void update(int number, const scene::SceneUpdate* recorded) {
        for (int i = 0; i < 10; ++i) {
            haptics::TickRecord s;
            s.tick = ++ticks;
            s.time_ns = static_cast<Nanoseconds>(ticks) * 1'000'000;
            const Vec3 place(0.008 * number - 0.08 + 0.0008 * i, 0.002 * (number % 5), 0.1);
            s.contact.points[0].hip_object_m = s.contact.cut_object_m = s.contact.points[0].proxy_object_m = place;
            s.sample.buttons = number % 8 != 7 && number != 12 ? 1u : 0u;
            ASSERT_TRUE(channels.ticks.push(s));
        }
        if (number == 16) desk.order(workpiece::UndoStroke{});
        if (number == 17) desk.order(workpiece::RedoStroke{});
        ASSERT_TRUE(recorded != nullptr ? desk.service().repeat(*recorded)
                                        : desk.service().update(number * Nanoseconds{10'000'000}));
        seen.push_back(desk.service().seen());
        surfaces.push_back(carving.surface().welded());
        states.push_back(carving.history()->state());
    }
};

constexpr int kUpdates = 22;

std::size_t most_behind(const LateBench& bench) {
    std::size_t most = 0;
    for (const scene::SceneUpdate& update : bench.seen) most = std::max(most, update.parts.at(0).behind);
    return most;
}

}  // namespace

TEST(LateEngine, LeavesToLaterUpdatesWhatAnEngineThatIsNotLateRepeats) {
    for (const int times_late : {1, 2, 5}) {
        LateBench live(times_late), again(0), late_again(3);
        live.desk.service().let_lag();
        for (int number = 0; number < kUpdates; ++number) {
            live.update(number, nullptr);
            again.update(number, &live.seen.back());
            late_again.update(number, &live.seen.back());
        }
        EXPECT_GT(most_behind(live), 0u) << "nothing was late";
        for (std::size_t i = 0; i < live.surfaces.size(); ++i)
            for (const LateBench* other : {&again, &late_again}) {
                EXPECT_EQ(live.surfaces[i].triangles, other->surfaces[i].triangles) << times_late << ", update " << i;
                EXPECT_TRUE(live.surfaces[i].positions_m == other->surfaces[i].positions_m) << "update " << i;
                EXPECT_EQ(live.states[i], other->states[i]) << "update " << i;
                EXPECT_EQ(live.seen[i].parts, other->seen[i].parts) << "update " << i;
            }
        EXPECT_TRUE(live.carving.engine().solid().same_content(again.carving.engine().solid()));
    }
}

TEST(LateEngine, IsWaitedForWhereTimeIsSimulated) {
    LateBench late(4), prompt(0);
    for (int number = 0; number < kUpdates; ++number) {
        late.update(number, nullptr);
        prompt.update(number, nullptr);
        EXPECT_TRUE(late.surfaces.back().positions_m == prompt.surfaces.back().positions_m) << "update " << number;
    }
    EXPECT_EQ(most_behind(late), 0u);
}

// The end of a stroke, a save and an export wait: what was begun by then belongs to them.
TEST(LateEngine, HasDoneAllThatAStrokeBeganWhenTheStrokeEnds) {
    LateBench late(1000), prompt(0);
    late.desk.service().let_lag();
    for (int number = 0; number < 7; ++number) {
        late.update(number, nullptr);
        prompt.update(number, nullptr);
    }
    EXPECT_GT(late.seen.back().parts.at(0).behind, 0u);
    EXPECT_FALSE(late.surfaces.back().positions_m == prompt.surfaces.back().positions_m);
    scene::Pages pages, expected;
    ASSERT_TRUE(late.carving.save(pages));
    ASSERT_TRUE(prompt.carving.save(expected));
    EXPECT_EQ(late.carving.under_way(), 0u);
    EXPECT_TRUE(late.carving.surface().welded().positions_m == prompt.surfaces.back().positions_m);
    EXPECT_EQ(late.carving.history()->undoable(), prompt.carving.history()->undoable());
}

}  // namespace burin::sculpt
