// SPDX-License-Identifier: MIT
// A solid as pages: what is saved and loaded is the same to the bit and goes on being so; what is lost is made again.
#include "compute/engine/engine.hpp"
#include "workpiece/saved_solid.hpp"

#include <gtest/gtest.h>

#include "base/json.hpp"
#include "sculpt/load_workpiece.hpp"
#include "sculpt/sculpture.hpp"
#include "toolbox/tool_options.hpp"
#include "workpiece/saved_changes.hpp"

namespace burin::workpiece {
namespace {

struct SavedBall {
    WorkerPool pool{1};
    sculpt::Sculpture carving{
        engine(*sculpt::load_workpiece({.source = "ball:0.1", .resolution = 90, .room = 0.1}, pool)), pool};

    std::unique_ptr<compute::CarvingEngine> engine(LoadedWorkpiece workpiece) {
        return compute::make_cpu_engine(std::move(workpiece.solid), pool);
    }
    void stroke(const Vec3& from, const Vec3& to) {
        const auto material = carving.add_material({"red", {200, 10, 10}});
        ASSERT_TRUE(material);
        toolbox::Tool tool{compute::BallTool{0.02}};
        tool.material = *material;
        const std::array sweeps{tool.sweep(Pose{from}, Pose{to})};
        const auto done = carving.update(sweeps);
        ASSERT_TRUE(done) << done.error().line();
    }
    [[nodiscard]] const compute::Solid& solid() const { return carving.engine().solid(); }
};

void expect_same(const compute::Solid& a, const compute::Solid& b) {
    EXPECT_TRUE(a.same_content(b));
    ASSERT_EQ(a.materials.size(), b.materials.size());
    for (std::size_t i = 0; i < a.materials.size(); ++i) {
        EXPECT_EQ(a.materials[i].name, b.materials[i].name);
        EXPECT_EQ(a.materials[i].colour, b.materials[i].colour);
    }
}

}  // namespace

TEST(SavedSolid, IsTheSameToTheBitAndGoesOnTheSame) {
    SavedBall ball;
    ball.stroke({-0.1, 0.03, 0.08}, {0.1, 0.01, 0.09});
    scene::Pages pages;
    ASSERT_TRUE(ball.carving.save(pages));
    Result<LoadedSolid> loaded = load_solid(pages, "ball.burin");
    ASSERT_TRUE(loaded) << loaded.error().line();
    EXPECT_EQ(loaded->lost, "");
    expect_same(loaded->solid, ball.solid());
    sculpt::Sculpture opened(compute::make_cpu_engine(std::move(loaded->solid), ball.pool), ball.pool);
    scene::Pages again;
    ASSERT_TRUE(opened.save(again));
    EXPECT_EQ(again.pages, pages.pages);
    ball.stroke({0.0, -0.1, 0.08}, {0.02, 0.1, 0.07});
    toolbox::Tool tool{compute::BallTool{0.02}};
    tool.material = *opened.add_material({"red", {200, 10, 10}});
    const std::array sweeps{tool.sweep(Pose{{0.0, -0.1, 0.08}}, Pose{{0.02, 0.1, 0.07}})};
    ASSERT_TRUE(opened.update(sweeps));
    expect_same(opened.engine().solid(), ball.solid());
}

TEST(SavedSolid, GivesThePagesThatHaveChangedAlone) {
    SavedBall ball;
    ball.carving.keep_history(1 << 24);
    scene::Pages whole;
    ASSERT_TRUE(ball.carving.save(whole));
    ball.stroke({0.0, 0.0, 0.1}, {0.01, 0.0, 0.1});
    scene::Pages changed{.whole = false};
    ASSERT_TRUE(ball.carving.save(changed));
    EXPECT_LT(changed.pages.size(), whole.pages.size() / 3);
    scene::Pages both = whole;
    for (const auto& [name, bytes] : changed.pages) both.pages[name] = bytes;
    expect_same(load_solid(both, "")->solid, ball.solid());
    scene::Pages nothing{.whole = false};
    ASSERT_TRUE(ball.carving.save(nothing));
    EXPECT_EQ(nothing.pages.size(), 1u) << "the head alone";
    // Undo goes back over a save.
    ASSERT_EQ(ball.carving.undo(1).value(), 1u);
    scene::Pages undone{.whole = false};
    ASSERT_TRUE(ball.carving.save(undone));
    for (const auto& [name, bytes] : undone.pages) both.pages[name] = bytes;
    for (const auto& [name, bytes] : whole.pages)
        EXPECT_TRUE(name.kind == "head" || both.pages.at(name) == bytes) << name.kind << name.number;
}

TEST(SavedSolid, IsMadeAgainFromTheChangesSinceItWasSaved) {
    SavedBall ball;
    ball.carving.keep_history(1 << 24);
    ball.carving.note_changes();
    scene::Pages before, nothing;
    ball.carving.copy(before);
    EXPECT_FALSE(ball.carving.take_change(nothing));
    std::vector<scene::Pages> changes;
    const auto take = [&] {
        EXPECT_TRUE(ball.carving.take_change(changes.emplace_back()));
        for (scene::Pages more; ball.carving.take_change(more);) changes.push_back(std::move(more));
    };
    ball.stroke({0.0, 0.0, 0.1}, {0.03, 0.0, 0.1});
    take();
    ball.stroke({0.03, 0.0, 0.1}, {0.05, 0.05, 0.08});
    ball.stroke({0.05, 0.05, 0.08}, {0.0, 0.09, 0.0});
    take();
    ball.carving.end_stroke();
    ASSERT_EQ(ball.carving.undo(1).value(), 1u);
    take();
    ball.stroke({-0.1, 0.0, 0.0}, {-0.1, 0.03, 0.0});
    take();
    compute::Solid made = load_solid(before, "")->solid;
    for (const scene::Pages& change : changes) ASSERT_TRUE(apply_change(made, change, "journal.burin"));
    expect_same(made, ball.solid());
    // One that is damaged changes nothing.
    scene::Pages torn = changes.back();
    torn.pages.at({"rays", 0}).resize(40);
    EXPECT_FALSE(apply_change(made, torn, "journal.burin"));
    torn = changes.back();
    torn.pages.at({"rays", 0})[5] ^= std::byte{0xff};
    static_cast<void>(apply_change(made, torn, "journal.burin"));
    EXPECT_TRUE(compute::well_formed(made));
}

TEST(SavedSolid, HasLostRaysMadeAgainToACellAndShowsWhere) {
    SavedBall ball;
    scene::Pages pages;
    ASSERT_TRUE(ball.carving.save(pages));
    for (const char* const kind : {"rays x", "rays y", "rays z"}) {
        scene::Pages torn = pages;
        ASSERT_EQ(torn.pages.erase({kind, 5}), 1u);
        const Result<LoadedSolid> loaded = load_solid(torn, "ball.burin");
        ASSERT_TRUE(loaded) << loaded.error().line();
        EXPECT_TRUE(loaded->lost.contains("1 page is damaged") && loaded->lost.contains("red")) << loaded->lost;
        ASSERT_TRUE(compute::well_formed(loaded->solid));
        EXPECT_EQ(loaded->solid.materials.back().name, "lost and made again");
        // Every node is inside as before, whichever set says so.
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            for (std::size_t ray = 0; ray < ball.solid().sets[a].ray_count(); ++ray) {
                const auto was = ball.solid().sets[a].ends(ray), is = loaded->solid.sets[a].ends(ray);
                ASSERT_EQ(was.size(), is.size());
                for (std::size_t end = 0; end < was.size(); ++end)
                    ASSERT_LE(std::abs(shared::depth_of(was[end]) - shared::depth_of(is[end])), shared::kUnitsPerCell);
            }
        }
    }
}

TEST(SavedSolid, SaysWhatWasLostAlongAllThreeDirections) {
    SavedBall ball;
    scene::Pages pages;
    ASSERT_TRUE(ball.carving.save(pages));
    for (const char* const kind : {"rays x", "rays y", "rays z"}) ASSERT_EQ(pages.pages.erase({kind, 0}), 1u);
    const Result<LoadedSolid> loaded = load_solid(pages, "ball.burin");
    ASSERT_TRUE(loaded) << loaded.error().line();
    EXPECT_TRUE(loaded->lost.contains("3 pages are damaged") && loaded->lost.contains("is lost, and is empty now"))
        << loaded->lost;
    EXPECT_TRUE(compute::well_formed(loaded->solid));
}

// One page of its beginning is damaged, and the changes bring in materials after the red one of what was made again.
TEST(SavedSolid, OfADamagedJournalTakesTheChangesThatAreSound) {
    SavedBall ball;
    ball.carving.keep_history(1 << 24);
    ball.carving.note_changes();
    scene::Pages before;
    ball.carving.copy(before);
    std::vector<scene::Pages> changes;
    ball.stroke({0.0, 0.0, 0.1}, {0.03, 0.0, 0.1});
    ASSERT_TRUE(ball.carving.take_change(changes.emplace_back()));
    ASSERT_TRUE(ball.carving.add_material({"blue", {10, 10, 200}}));
    ball.stroke({0.03, 0.0, 0.1}, {0.05, 0.05, 0.08});
    ASSERT_TRUE(ball.carving.take_change(changes.emplace_back()));
    ASSERT_EQ(before.pages.erase({"rays x", 5}), 1u);
    compute::Solid made = load_solid(before, "")->solid;
    for (const scene::Pages& change : changes) {
        const auto done = apply_change(made, change, "journal.burin");
        ASSERT_TRUE(done) << done.error().line();
        ASSERT_TRUE(compute::well_formed(made));
    }
    ASSERT_EQ(made.materials.size(), ball.solid().materials.size() + 1);
    EXPECT_EQ(made.materials.back().name, "lost and made again");
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        for (std::size_t ray = 0; ray < made.sets[a].ray_count(); ++ray) {
            const auto was = ball.solid().sets[a].ends(ray), is = made.sets[a].ends(ray);
            ASSERT_EQ(was.size(), is.size());
            for (std::size_t end = 0; end < was.size(); ++end) {
                ASSERT_LE(std::abs(shared::depth_of(was[end]) - shared::depth_of(is[end])), shared::kUnitsPerCell);
                const bool is_red = shared::material_of(is[end]) + 1 == made.materials.size();
                ASSERT_TRUE(is_red || shared::material_of(is[end]) == shared::material_of(was[end]));
            }
        }
    }
}

TEST(SavedSolid, WithAnImpossibleNumberInItsHeadIsRefusedAtOnce) {
    SavedBall ball;
    scene::Pages pages;
    ASSERT_TRUE(ball.carving.save(pages));
    const std::vector<std::byte> head = pages.pages.at({"head", 0});
    const Json sound = Json::parse(std::string(reinterpret_cast<const char*>(head.data()), head.size()));
    const auto expect_refused = [&](const std::string& place, const Json& value) {
        Json json = sound;
        json[Json::json_pointer(place)] = value;
        const std::string text = json.dump();
        const auto bytes = std::as_bytes(std::span(text));
        pages.pages.at({"head", 0}) = {bytes.begin(), bytes.end()};
        const auto loaded = load_solid(pages, "ball.burin");
        ASSERT_FALSE(loaded) << place << " " << value.dump();
        EXPECT_TRUE(loaded.error().line().contains("open an earlier copy")) << loaded.error().line();
    };
    for (const double spacing : {1e300, 1e100, 1e12, 1e-300, 0.0, -1.0}) expect_refused("/spacing_m", spacing);
    for (const double origin : {1e300, -1e300, 1e30}) expect_refused("/origin_m/1", origin);
    for (const double cells : {0.0, -3.0, 1e300, 5000.0}) expect_refused("/cells/2", cells);
    for (const char* const place : {"/spacing_m", "/origin_m", "/cells", "/materials", "/page_side"})
        expect_refused(place, nullptr);
    expect_refused("/materials", Json::array());
    expect_refused("/page_side", 1e300);
    for (const double part : {-1.0, 256.0, 1e300}) expect_refused("/materials/0/colour/1", part);
}

TEST(SavedSolid, OfDamagedBytesIsToldAndNeverTaken) {
    SavedBall ball;
    scene::Pages pages;
    ASSERT_TRUE(ball.carving.save(pages));
    scene::Pages headless = pages;
    headless.pages.erase({"head", 0});
    EXPECT_FALSE(load_solid(headless, "ball.burin"));
    scene::Pages alone;
    alone.pages[{"head", 0}] = pages.pages.at({"head", 0});
    EXPECT_FALSE(load_solid(alone, "ball.burin"));
    for (auto& [name, bytes] : pages.pages) {
        if (name.kind == "head" || bytes.size() < 4) continue;
        bytes[bytes.size() / 3] ^= std::byte{0xff};
    }
    const auto loaded = load_solid(pages, "ball.burin");
    EXPECT_TRUE(!loaded || compute::well_formed(loaded->solid));
}

}  // namespace burin::workpiece
