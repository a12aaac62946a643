// SPDX-License-Identifier: MIT
// The solid under long random use: every operation with the nastiest tools, undone and redone now and then, with
// everything that must hold looked at after each of them.
//
// A short run with a seed of its own each time belongs to scripts/test; the seed is printed, and BURIN_TEST_SEED
// replays it. BURIN_SOAK_OPERATIONS says how many operations: 1000000 for the long run, scripts/test --soak.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <set>

#include "base/try.hpp"
#include "compute/engine/history.hpp"
#include "compute/mesher/surface.hpp"
#include "compute/tools/apply.hpp"
#include "compute/vulkan/vulkan_engine.hpp"
#include "tests/compute/effort.hpp"
#include "tests/compute/engine_pair.hpp"
#include "tests/compute/mesh_topology.hpp"
#include "tests/compute/same_tiles.hpp"
#include "tests/compute/tool_reference.hpp"
#include "tests/compute/updates.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::compute::test {
namespace {

using shared::DexelEnd;

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

bool well_formed_ray(std::span<const DexelEnd> ends, int last_depth, std::size_t materials) {
    int previous = -1;
    for (const DexelEnd& end : ends) {
        if (depth_of(end) <= previous || depth_of(end) > last_depth || material_of(end) >= materials) return false;
        previous = depth_of(end);
    }
    return ends.size() % 2 == 0;
}

// Every depth of a is one of b.
bool within(std::span<const DexelEnd> a, std::span<const DexelEnd> b) {
    std::size_t j = 0;
    for (std::size_t i = 0; i < a.size(); i += 2) {
        while (j < b.size() && depth_of(b[j + 1]) < depth_of(a[i + 1])) j += 2;
        if (j >= b.size() || depth_of(b[j]) > depth_of(a[i])) return false;
    }
    return true;
}

bool same_depths(std::span<const DexelEnd> a, std::span<const DexelEnd> b) {
    return std::ranges::equal(a, b, [](const DexelEnd& x, const DexelEnd& y) { return depth_of(x) == depth_of(y); });
}

// A device's engine that does whatever the processor's does, with a history of its own.
struct Beside {
    Beside(std::unique_ptr<CarvingEngine> made, WorkerPool& workers)
        : engine(std::move(made)), surface(engine->solid().lattice), pool(workers) {
        engine->make_cells();
        surface.mesh_all(engine->solid(), pool);
    }
    [[nodiscard]] Result<CarveStats> carve(const ToolSweep& sweep) {
        BURIN_TRY_DO(engine->begin(std::span(&sweep, 1)));
        BURIN_TRY(delta, engine->take(Wait::yes));
        surface.update(engine->solid(), delta->changes, pool, delta->made ? &*delta->made : nullptr);
        made += delta->made ? 1 : 0;
        changes = std::move(delta->changes);
        return delta->stats;
    }
    // Follows what came outside of any update.
    void follow() {
        changes = engine->take_changes();
        surface.update(engine->solid(), changes, pool);
    }
    std::unique_ptr<CarvingEngine> engine;
    History history;
    Surface surface;         // of the cells that the device has made
    Changes changes;         // of the last work
    std::uint64_t made = 0;  // updates whose cells the device has made
    WorkerPool& pool;
};

// A solid in use: the engine, its surface and its history, and a copy that only learns of what the engine says it
// changed. Where there is a device, its engine has to report and hold the same.
class Session {
public:
    Session(Random& random, WorkerPool& pool, const gpu::Device* device)
        : random_(random), pool_(pool), shadow_(start(random)), surface_(shadow_.lattice) {
        engine_ = make_cpu_engine(shadow_, pool_);
        if (device != nullptr) {
            // Little room, so that all that grows does.
            auto made = VulkanEngine::create(Solid(shadow_), *device, pool_, {.spare_ends = 64, .export_per_ray = 1});
            EXPECT_TRUE(made) << made.error().line();
            if (made) beside_.emplace(std::move(*made), pool_);
        }
        surface_.mesh_all(shadow_, pool_);
        kept_.push_back(shadow_);
    }

    void step() {
        const double dice = random_.unit();
        if (dice < 0.04) {
            undo_or_redo();
        } else if (dice < 0.10 && last_) {
            repeat_last();
        } else if (dice < 0.13 && last_) {
            ToolSweep refill = *last_;
            refill.operation = refill.operation == Operation::cut ? Operation::fill : Operation::cut;
            perform(refill);
        } else {
            perform(any_sweep());
        }
        if (++steps_ % 64 == 0) look_at_everything();
    }

    void look_at_everything() {
        ASSERT_TRUE(engine_->solid().same_content(shadow_)) << "a ray changed without being reported";
        ASSERT_TRUE(well_formed(engine_->solid()));
        if (beside_) {
            ASSERT_EQ(first_difference(beside_->engine->solid(), shadow_), "") << "the engines differ";
            ASSERT_EQ(first_difference(beside_->surface, surface_), "") << "the surfaces differ";
        }
        Surface fresh(shadow_.lattice);
        fresh.mesh_all(shadow_, pool_);
        ASSERT_EQ(surface_.triangles(), fresh.triangles());
        const geometry::TriangleMesh mesh = surface_.welded(), anew = fresh.welded();
        ASSERT_TRUE(mesh.positions_m == anew.positions_m && mesh.triangles == anew.triangles &&
                    mesh.colours == anew.colours)
            << "the surface kept up to date is not the surface meshed anew";
        ASSERT_EQ(topology_of(mesh), MeshTopology{});
    }

    // Back to the beginning, bit for bit.
    void undo_everything() {
        for (;;) {
            const auto undone = history_.undo(*engine_);
            ASSERT_TRUE(undone.has_value());
            if (beside_) {
                ASSERT_TRUE(beside_->history.undo(*beside_->engine));
                beside_->follow();
            }
            follow(std::nullopt);
            if (!*undone) break;
        }
        ASSERT_TRUE(engine_->solid().same_content(kept_.front()));
        if (beside_) {
            ASSERT_GT(beside_->made, steps_ / 4) << "the device makes cells";
        }
    }

private:
    static Solid start(Random& random) {
        const Vec3 size(1.0, random.between(0.3, 1.0), random.between(0.3, 1.0));
        Solid solid = random.chance(0.3) ? *make_ball(0.5, random.small(16, 26), {"ball", {200, 200, 200}})
                                         : *make_block(size, random.small(16, 26), {"block", {200, 200, 200}});
        for (const char* name : {"cut", "filled", "painted"}) solid.materials.push_back({name, {90, 60, 30}});
        return solid;
    }

    // In and around the lattice; often exactly on nodes and half-way between them, where rays are tangent and faces
    // coincide; now and then very far away.
    Vec3 any_place() {
        const Lattice& lattice = shadow_.lattice;
        Vec3 units;
        for (int a = 0; a < 3; ++a) {
            const double cells = lattice.cells[static_cast<std::size_t>(a)];
            double at = random_.between(-0.15, 1.15) * cells;
            if (random_.chance(0.3)) at = std::round(2.0 * at) / 2.0;
            units[a] = at * 4096.0;
        }
        if (random_.chance(0.01)) units *= random_.between(-2000.0, 2000.0);
        return lattice.object_from_units(units);
    }

    // From a hundredth of a cell to ten times the solid; often a whole number of units or cells.
    double any_size() {
        const double h = shadow_.lattice.spacing_m;
        if (random_.chance(0.02)) return h * random_.between(100.0, 300.0);
        if (random_.chance(0.2)) return h * random_.between(0.01, 1.0);
        if (random_.chance(0.2)) return h * random_.small(1, 6);
        return h * random_.between(0.5, 8.0);
    }

    ToolSweep any_sweep() {
        ToolSweep sweep;
        const double size = any_size();
        sweep.shape = random_.chance(0.7) ? ToolShape(BallTool{size}) : any_shape(random_, 0.3 * size, size);
        sweep.start = {any_place(), random_.chance(0.5) ? Quat(1, 0, 0, 0) : any_orientation(random_)};
        sweep.end = sweep.start;
        if (random_.chance(0.4)) {
            sweep.end.position_m =
                random_.chance(0.3) ? any_place() : sweep.start.position_m + (any_place() - any_place()) * 0.1;
            // Turning tools with long ways take many steps; a few of them are enough.
            if (random_.chance(0.02)) sweep.end.orientation = any_orientation(random_);
        }
        const double dice = random_.unit();
        sweep.operation = dice < 0.5 ? Operation::cut : dice < 0.8 ? Operation::fill : Operation::paint;
        if (dice > 0.97 && std::holds_alternative<BallTool>(sweep.shape)) sweep.operation = Operation::smooth;
        sweep.material = static_cast<std::uint8_t>(random_.small(0, 3));
        return sweep;
    }

    void perform(const ToolSweep& sweep) {
        const auto stats = engine_->carve(std::span(&sweep, 1));
        if (!stats) {  // too far away or too large: refused, and nothing happened
            ASSERT_FALSE(stats.error().remedy.empty()) << stats.error().line();
            ASSERT_TRUE(engine_->take_changes().empty());
            return;
        }
        last_ = sweep;
        if (beside_) {
            const auto done = beside_->carve(sweep);
            ASSERT_TRUE(done) << done.error().line();
            ASSERT_EQ(done->rays_touched, stats->rays_touched);
            ASSERT_EQ(done->rays_changed, stats->rays_changed);
        }
        follow(sweep.operation);
        if (!random_.chance(0.3)) return;
        history_.end_stroke();
        if (beside_) beside_->history.end_stroke();
    }

    // (A - B) - B = A - B, and so for filling and painting: the second time nothing changes.
    void repeat_last() {
        if (last_->operation == Operation::smooth) return;
        perform(*last_);
        const auto again = engine_->carve(std::span(&*last_, 1));
        ASSERT_TRUE(again.has_value());
        ASSERT_EQ(again->rays_changed, 0u);
        ASSERT_TRUE(engine_->take_changes().empty());
    }

    void undo_or_redo() {
        const bool undoes = random_.chance(0.6);
        const auto moved = undoes ? history_.undo(*engine_) : history_.redo(*engine_);
        ASSERT_TRUE(moved.has_value());
        if (beside_) {
            History& history = beside_->history;
            const auto theirs = undoes ? history.undo(*beside_->engine) : history.redo(*beside_->engine);
            ASSERT_TRUE(theirs.has_value());
            ASSERT_EQ(*theirs, *moved);
            beside_->follow();
        }
        follow(std::nullopt);
    }

    // Looks at every ray that changed, and brings shadow, surface and (for a tool's work) history up to date.
    void follow(std::optional<Operation> operation) {
        const Changes changes = engine_->take_changes();
        if (beside_) {
            const Changes& theirs = beside_->changes;
            ASSERT_EQ(first_held(theirs), first_held(changes)) << "the engines tell of other changes";
            if (operation) beside_->history.record(theirs);
        }
        std::set<std::uint32_t> seen;  // a long way of smoothing changes a ray several times
        for (const shared::ChangedRay& change : changes.rays) {
            if (!seen.insert(change.ray).second) continue;
            const RayPlace place = place_of(change.ray);
            const auto a = static_cast<std::size_t>(place.axis);
            const auto held = changes.before_of(change), shadow = shadow_.sets[a].ends(place.u, place.v);
            ASSERT_TRUE(same_depths(held, shadow)) << "what a ray held before is told wrong";
            const auto now = engine_->solid().sets[a].ends(place.u, place.v);
            ASSERT_TRUE(well_formed_ray(now, shadow_.lattice.cells[a] * 4096, shadow_.materials.size()));
            if (operation == Operation::cut) {
                ASSERT_TRUE(within(now, held)) << "a cut added material";
            }
            if (operation == Operation::fill) {
                ASSERT_TRUE(within(held, now)) << "filling took material away";
            }
            if (operation == Operation::paint) {
                ASSERT_TRUE(same_depths(now, held)) << "paint changed a shape";
            }
            shadow_.sets[a].replace(place.u, place.v, now);
        }
        surface_.update(engine_->solid(), changes, pool_);
        if (operation) history_.record(changes);
    }

    Random& random_;
    WorkerPool& pool_;
    Solid shadow_;
    Surface surface_;
    History history_;
    std::unique_ptr<CarvingEngine> engine_;
    std::optional<Beside> beside_;
    std::vector<Solid> kept_;
    std::optional<ToolSweep> last_;
    std::uint64_t steps_ = 0;
};

// Uses solids at random, with a device's engine beside the processor's or alone.
void use_at_random(std::uint64_t operations, const gpu::Device* device) {
    const std::uint64_t seed = from_environment("BURIN_TEST_SEED", std::random_device{}());
    std::printf("seed %llu, %llu operations; to replay: BURIN_TEST_SEED=%llu\n", static_cast<unsigned long long>(seed),
                static_cast<unsigned long long>(operations), static_cast<unsigned long long>(seed));
    testing::Test::RecordProperty("seed", std::to_string(seed));
    WorkerPool pool(2);
    constexpr std::uint64_t kOperationsASolid = 250;
    for (std::uint64_t done = 0, solid = 0; done < operations; ++solid) {
        Random random(seed + solid);
        Session session(random, pool, device);
        for (std::uint64_t i = 0; i < kOperationsASolid && done < operations; ++i, ++done) {
            session.step();
            ASSERT_FALSE(testing::Test::HasFatalFailure())
                << "seed " << seed << ", solid " << solid << ", operation " << i;
        }
        session.look_at_everything();
        ASSERT_FALSE(testing::Test::HasFatalFailure()) << "seed " << seed << ", solid " << solid << ", at its end";
        session.undo_everything();
        ASSERT_FALSE(testing::Test::HasFatalFailure()) << "seed " << seed << ", solid " << solid << ", undoing all";
        if (operations >= 100'000 && done % 50'000 < kOperationsASolid) {
            std::printf("%llu operations\n", static_cast<unsigned long long>(done));
            std::fflush(stdout);
        }
    }
}

class SoakOnADevice : public gpu::DeviceTest {};

}  // namespace

TEST(Soak, RandomUseBreaksNothing) {
    use_at_random(from_environment("BURIN_SOAK_OPERATIONS", static_cast<std::uint64_t>(repeated(6000))), nullptr);
}

// A device takes some ten times as long for each operation.
TEST_F(SoakOnADevice, RandomUseGivesWhatItGivesOnTheProcessor) {
    const gpu::Capabilities& can = device().capabilities();
    if (!can.shader_int64 || !can.shader_float64 || !can.buffer_address)
        GTEST_SKIP() << device().info().name << " cannot run the Vulkan engine";
    use_at_random(from_environment("BURIN_SOAK_OPERATIONS", static_cast<std::uint64_t>(repeated(5000))) / 10,
                  &device());
}

// A hundred thousand strokes of a tool much smaller than a cell, all over one place.
TEST(Soak, TinyStrokesAddUpWithoutHarm) {
    const std::uint64_t operations =
        from_environment("BURIN_SOAK_OPERATIONS", static_cast<std::uint64_t>(repeated(100'000)));
    WorkerPool pool(2);
    Random random(7);
    const Solid start = *make_block(Vec3(1), 32, {"block", {}});
    const auto engine = make_cpu_engine(start, pool);
    const double h = start.lattice.spacing_m;
    std::size_t most_ends = 0;
    for (std::uint64_t i = 0; i < operations; ++i) {
        const Vec3 p(0.5 + random.between(-2, 2) * h, 0.5 + random.between(-2, 2) * h, 0.5 + random.between(-2, 2) * h);
        const BallSweep sweep{
            p, p + Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)) * (0.2 * h),
            h * random.between(0.001, 0.05), 0, random.chance(0.6) ? Operation::cut : Operation::fill};
        ASSERT_TRUE(engine->carve(std::span(&sweep, 1)).has_value());
        for (const shared::ChangedRay& change : engine->take_changes().rays) {
            const RayPlace place = place_of(change.ray);
            const auto ends = engine->solid().sets[static_cast<std::size_t>(place.axis)].ends(place.u, place.v);
            ASSERT_TRUE(well_formed_ray(ends, start.lattice.cells[0] * 4096, 1)) << i;
            most_ends = std::max(most_ends, ends.size());
        }
    }
    EXPECT_GT(most_ends, 6u);
    EXPECT_TRUE(well_formed(engine->solid()));
}

}  // namespace burin::compute::test
