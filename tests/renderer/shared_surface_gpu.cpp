// SPDX-License-Identifier: MIT
// Several screens draw one surface: each shows what it would show of a surface of its own, and the surface is uploaded,
// kept and simplified once.
#include <algorithm>
#include <chrono>
#include <functional>
#include <random>
#include <thread>

#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {
namespace {

constexpr std::array<ImageSize, 4> kSizes{{{160, 120}, {120, 160}, {100, 100}, {200, 90}}};

// The eyes look at the same place from four sides, through screens around it.
picture::Picture scene_of(std::size_t screen) {
    picture::Picture picture = bare_scene();
    const Vec3 towards[]{{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 0, -1}};
    const Vec3 center{0.0, 0.15, 0.0}, out = towards[screen], right = glm::cross(Vec3(0, 1, 0), out), up(0, 1, 0);
    picture.screen = {center - 0.2 * right - 0.15 * up, center + 0.2 * right - 0.15 * up,
                      center - 0.2 * right + 0.15 * up};
    picture.viewer.head_world = {center + 0.6 * out, glm::angleAxis(std::atan2(out.x, out.z), Vec3(0, 1, 0))};
    picture.workpiece_object = {Vec3(-0.15, 0.0, -0.15), Vec3(0.15, 0.3, 0.15)};  // else other bounds redraw everything
    picture.tool = {0.01, {0.02, 0.16, 0.03}, {0.9, 0.5, 0.2}, {}, true};
    return picture;
}

}  // namespace

class SharedSurface : public gpu::DeviceTest {
protected:
    void SetUp() override {
        gpu::DeviceTest::SetUp();
        if (IsSkipped()) return;
        surface_ = std::make_shared<SurfaceStore>(device());
        for (std::size_t i = 0; i < kSizes.size(); ++i) {
            shared_.push_back(Renderer::create(device(), kSizes[i], {.surface = surface_}).value());
            alone_.push_back(Renderer::create(device(), kSizes[i]).value());
        }
    }
    void TearDown() override {
        shared_.clear();
        alone_.clear();
        surface_.reset();
        gpu::DeviceTest::TearDown();
    }
    void for_each_surface(const std::function<void(SurfaceStore&)>& change) {
        change(*surface_);
        for (Renderer& renderer : alone_) change(renderer.surface());
    }
    void flush() {
        auto commands = gpu::Commands::begin(device());
        ASSERT_TRUE(commands && surface_->flush(*commands));
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission && submission->wait());
    }
    void expect_same_picture(std::size_t screen) {
        const auto one = shared_[screen].render(scene_of(screen)), other = alone_[screen].render(scene_of(screen));
        ASSERT_TRUE(one && other);
        EXPECT_TRUE(one->left.rgba == other->left.rgba) << "left eye of screen " << screen;
        EXPECT_TRUE(one->right.rgba == other->right.rgba) << "right eye of screen " << screen;
    }
    static constexpr std::uint32_t kRow = 20;
    void set_row_of_balls() {
        for (std::uint32_t id = 0; id < kRow; ++id) {
            const Surface s = ball_surface({0.009 * id - 0.09, 0.15, 0.0}, 0.004, kGrey, 16);
            surface_->set_patch(id, s.vertices, s.indices);
        }
        flush();
    }
    // Changes patches and light in random order, and draws each screen every so many frames.
    void change_and_compare(const std::array<int, 4>& every, bool refines) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> offset(-0.1, 0.1);
        std::uint32_t coarser = 0;
        for (int frame = 0; frame < 30; ++frame) {
            for (int change = 0; change < 12; ++change) {
                const auto id = static_cast<std::uint32_t>(random() % 60);
                const Surface s = ball_surface({offset(random), 0.15 + offset(random), offset(random)}, 0.012, kGrey,
                                               6 + static_cast<int>(random() % 6));
                const auto open = static_cast<std::uint8_t>(random() % 256);
                const std::vector<geometry::VertexLight> light(s.vertices.size(), {.sun = open, .open = open});
                const auto kind = random() % 5;
                for_each_surface([&](SurfaceStore& surface) {
                    if (kind == 0) return surface.remove_patch(id);
                    surface.set_patch(id, s.vertices, s.indices);
                    if (kind < 3) surface.set_patch_light(id, light);
                });
            }
            if (frame == 20) for_each_surface([](SurfaceStore& surface) { surface.clear_patches(); });
            if (refines && frame % 5 == 3) {
                for_each_surface([](SurfaceStore& surface) { static_cast<void>(surface.refine(1000)); });
                for (auto* renderers : {&shared_, &alone_})
                    for (Renderer& renderer : *renderers) renderer.forget_picture();  // full redraws choose levels
            }
            flush();
            for (std::size_t i = 0; i < 4; ++i) {
                if (frame % every[i] == 0) expect_same_picture(i);
                coarser += shared_[i].stats().patch_counts.coarser;
            }
        }
        for (std::size_t i = 0; i < 4; ++i) expect_same_picture(i);
        EXPECT_EQ(coarser > 0, refines);
    }
    // Draws the first three screens until these have shown new levels, and some frames more. Returns how often each was
    // drawn whole.
    std::array<int, 3> settle(std::initializer_list<std::size_t> until) {
        std::array<int, 3> whole{};
        for (int frame = 0, rest = 0; frame < 30'000 && rest < 10; ++frame) {
            surface_->refine_beside(true);
            flush();
            for (std::size_t i = 0; i < 3; ++i) {
                EXPECT_TRUE(shared_[i].render(scene_of(i)));
                whole[i] += shared_[i].stats().part == all_of(kSizes[i]) ? 1 : 0;
            }
            rest += std::ranges::all_of(until, [&](std::size_t i) { return whole[i] > 0; }) ? 1 : 0;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return whole;
    }

    std::shared_ptr<SurfaceStore> surface_;
    std::vector<Renderer> shared_, alone_;
};

// Screens that draw seldom collect what changes meanwhile.
TEST_F(SharedSurface, ShowsOnEachScreenWhatASurfaceOfItsOwnWould) { change_and_compare({1, 4, 7, 10}, false); }

// With the views at rest a patch that a screen does not see may have levels or not.
TEST_F(SharedSurface, ShowsTheSameLevelsAsASurfaceOfItsOwnWould) { change_and_compare({1, 1, 1, 1}, true); }

TEST_F(SharedSurface, IsUploadedKeptAndSimplifiedOnce) {
    for (std::uint32_t id = 0; id < 40; ++id) {
        const Surface s = ball_surface({0.004 * id - 0.08, 0.15, 0.0}, 0.01, kGrey, 10);
        for_each_surface([&](SurfaceStore& surface) { surface.set_patch(id, s.vertices, s.indices); });
    }
    flush();
    for (std::size_t i = 0; i < 4; ++i) expect_same_picture(i);
    for_each_surface([](SurfaceStore& surface) { static_cast<void>(surface.refine(1000)); });
    SurfaceStore::Work alone;
    std::uint64_t alone_bytes = 0;
    for (Renderer& renderer : alone_) {
        alone.uploads += renderer.surface().work().uploads;
        alone.uploaded_bytes += renderer.surface().work().uploaded_bytes;
        alone.detail_jobs += renderer.surface().work().detail_jobs;
        alone_bytes += renderer.surface().patches().device_bytes();
    }
    const SurfaceStore::Work& once = surface_->work();
    ASSERT_EQ(once.uploads, 1u);
    ASSERT_EQ(once.detail_jobs, 40u);
    EXPECT_EQ(alone.uploads, 4 * once.uploads);
    EXPECT_EQ(alone.uploaded_bytes, 4 * once.uploaded_bytes);
    EXPECT_EQ(alone.detail_jobs, 4 * once.detail_jobs);
    EXPECT_EQ(alone_bytes, 4 * surface_->patches().device_bytes());
}

TEST_F(SharedSurface, GetsNewLevelsDrawnOnTheScreensThatSeeThem) {
    // To the left of the first screen's picture, in view of the second and third.
    const Surface s = ball_surface({-0.5, 0.15, 0.0}, 0.01, kGrey, 16);
    surface_->set_patch(1, s.vertices, s.indices);
    flush();
    for (std::size_t i = 0; i < 3; ++i) ASSERT_TRUE(shared_[i].render(scene_of(i)));
    ASSERT_EQ(shared_[0].stats().patch_counts.drawn, 0u);
    ASSERT_EQ(shared_[1].stats().patch_counts.drawn, 1u);
    ASSERT_EQ(shared_[2].stats().patch_counts.drawn, 1u);
    EXPECT_EQ(settle({1, 2}), (std::array<int, 3>{0, 1, 1}));
    EXPECT_EQ(surface_->work().detail_jobs, 1u) << "though two screens want it";
}

// A screen's size and its views may change, and it may go, while its patches are being simplified.
TEST_F(SharedSurface, GoesOnBeingSimplifiedWhateverBecomesOfAScreen) {
    set_row_of_balls();
    for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(shared_[i].render(scene_of(i)));
    surface_->refine_beside(true);
    ASSERT_TRUE(shared_[0].resize(kSizes[3], Views::left));
    shared_.erase(shared_.begin() + 1, shared_.end());
    for (int frame = 0; frame < 30'000 && shared_[0].stats().patch_counts.coarser < kRow; ++frame) {
        surface_->refine_beside(true);
        flush();
        ASSERT_TRUE(shared_[0].render(scene_of(0)));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_EQ(shared_[0].stats().patch_counts.coarser, kRow);
    EXPECT_EQ(surface_->work().detail_jobs, kRow) << "none is done twice";
}

TEST_F(SharedSurface, OutlivesItsWorkAndItsOwner) {
    set_row_of_balls();
    ASSERT_TRUE(shared_[0].render(scene_of(0)));
    surface_->refine_beside(true);
    surface_.reset();  // the screens still draw it
    ASSERT_TRUE(shared_[0].render(scene_of(0)));
    shared_.clear();  // while its thread works
}

// A screen that nobody sees for long does not collect without end what happens meanwhile.
TEST_F(SharedSurface, IsDrawnWholeOnAScreenThatHasMissedMuch) {
    for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(shared_[i].render(scene_of(i)));
    for (int frame = 0; frame < 120; ++frame) {
        for (std::uint32_t id = 0; id < 40; ++id) {
            const Surface s = ball_surface({0.004 * id - 0.08, 0.15, 0.0001 * frame}, 0.01, kGrey, 4);
            for_each_surface([&](SurfaceStore& surface) { surface.set_patch(id, s.vertices, s.indices); });
        }
        flush();
        ASSERT_TRUE(shared_[0].render(scene_of(0)));
    }
    // Far from all that has changed before.
    const Surface late = ball_surface({0.0, 0.25, 0.05}, 0.01, kGrey, 4);
    for_each_surface([&](SurfaceStore& surface) { surface.set_patch(99, late.vertices, late.indices); });
    flush();
    expect_same_picture(1);
    EXPECT_EQ(shared_[1].stats().part, all_of(kSizes[1]));
}

TEST_F(SharedSurface, OnAnotherDeviceIsRefused) {
    auto other = gpu::Device::create();
    ASSERT_TRUE(other);
    const auto refused = Renderer::create(*other, kTestSize, {.surface = surface_});
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("another graphics device"), std::string::npos) << refused.error().line();
}

}  // namespace burin::renderer
