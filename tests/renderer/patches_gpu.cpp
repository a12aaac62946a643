// SPDX-License-Identifier: MIT
// Patches come and go; the picture shows exactly those that are there.
#include <chrono>
#include <map>
#include <random>
#include <thread>

#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {

using Patches = PictureTest;

TEST_F(Patches, ARemovedPatchIsGone) {
    const picture::Picture picture = bare_scene();
    const StereoImage empty = render(picture);
    set(1, ball_surface({-0.05, 0.15, 0}, 0.03));
    const StereoImage one = render(picture);
    set(2, ball_surface({0.06, 0.15, 0}, 0.03));
    const StereoImage two = render(picture);
    EXPECT_FALSE(one.left.rgba == two.left.rgba);
    renderer().surface().remove_patch(2);
    EXPECT_TRUE(render(picture).left.rgba == one.left.rgba);
    renderer().surface().remove_patch(1);
    renderer().surface().remove_patch(77);  // never there
    EXPECT_TRUE(render(picture).left.rgba == empty.left.rgba);
}

TEST_F(Patches, SettingAnIdAgainReplacesIt) {
    const picture::Picture picture = bare_scene();
    set(1, ball_surface({0, 0.15, 0}, 0.03, kGrey, 8));
    const StereoImage wanted = render(picture);
    set(1, ball_surface({0.1, 0.2, 0}, 0.05, kRed, 40));
    EXPECT_FALSE(render(picture).left.rgba == wanted.left.rgba);
    set(1, ball_surface({0.1, 0.1, 0}, 0.05, kRed, 20));  // twice before a frame: the last one counts
    set(1, ball_surface({0, 0.15, 0}, 0.03, kGrey, 8));
    const StereoImage again = render(picture);
    EXPECT_TRUE(again.left.rgba == wanted.left.rgba);
    EXPECT_EQ(renderer().stats().patches, 1u);
    EXPECT_EQ(renderer().stats().triangles, 8u * 16u * 2u);
}

TEST_F(Patches, ClearingLeavesOnlyWhatIsSetAfterwards) {
    const picture::Picture picture = bare_scene();
    const StereoImage empty = render(picture);
    for (std::uint32_t id = 0; id < 20; ++id) set(id, ball_surface({0.01 * id - 0.1, 0.15, 0}, 0.01, kGrey, 6));
    renderer().surface().clear_patches();
    EXPECT_TRUE(render(picture).left.rgba == empty.left.rgba);
    set(3, ball_surface({0, 0.15, 0}, 0.03));
    static_cast<void>(render(picture));
    EXPECT_EQ(renderer().stats().patches, 1u);
}

// Thousands of changes in random order, with growing and shrinking buffers, end in the same picture as setting the last
// state at once.
TEST_F(Patches, AnyHistoryWithTheSameEndGivesTheSamePicture) {
    const picture::Picture picture = bare_scene();
    std::mt19937 random(5);
    std::uniform_real_distribution<double> offset(-0.12, 0.12);
    std::map<std::uint32_t, Surface> last;
    for (int frame = 0; frame < 6; ++frame) {
        for (int change = 0; change < 150; ++change) {
            const auto id = static_cast<std::uint32_t>(random() % 200);
            if (random() % 4 == 0) {
                renderer().surface().remove_patch(id);
                last.erase(id);
            } else {
                const int rings = 4 + static_cast<int>(random() % 16);
                last[id] = ball_surface({offset(random), 0.15 + offset(random), offset(random)}, 0.01, kGrey, rings);
                set(id, last[id]);
            }
        }
        static_cast<void>(render(picture));
    }
    const StereoImage grown = render(picture);
    auto fresh = Renderer::create(device(), kTestSize);
    ASSERT_TRUE(fresh);
    for (const auto& [id, surface] : last) fresh->surface().set_patch(id, surface.vertices, surface.indices);
    const auto at_once = fresh->render(picture);
    ASSERT_TRUE(at_once);
    EXPECT_TRUE(grown.left.rgba == at_once->left.rgba);
    EXPECT_TRUE(grown.right.rgba == at_once->right.rgba);
    EXPECT_EQ(renderer().stats().triangles, fresh->stats().triangles);
    EXPECT_EQ(fresh->stats().patches, last.size());
}

TEST_F(Patches, AFreshSurfaceOfManyPatchesIsOneDraw) {
    for (std::uint32_t id = 0; id < 500; ++id) set(id, ball_surface({0, 0.15, 0}, 0.02, kGrey, 4));
    static_cast<void>(render(bare_scene()));
    EXPECT_EQ(renderer().stats().draws, 1u);
}

TEST_F(Patches, OnlyWhatChangedIsUploaded) {
    for (std::uint32_t id = 0; id < 100; ++id) set(id, ball_surface({0, 0.15, 0}, 0.02, kGrey, 8));
    static_cast<void>(render(bare_scene()));
    const std::uint64_t all = renderer().stats().uploaded_bytes;
    static_cast<void>(render(bare_scene()));
    EXPECT_EQ(renderer().stats().uploaded_bytes, 0u);
    set(7, ball_surface({0, 0.15, 0}, 0.03, kGrey, 8));
    static_cast<void>(render(bare_scene()));
    EXPECT_EQ(renderer().stats().uploaded_bytes * 100, all);
}

// Levels are worked out beside the frames, and taken up by one whole picture.
TEST_F(Patches, CoarserLevelsComeBesideTheFrames) {
    const picture::Picture picture = bare_scene();
    set(1, ball_surface({0, 0.15, 0}, 0.01, kGrey, 40));  // of pixels
    static_cast<void>(render(picture));
    const auto frames_until_coarser = [&] {
        for (int frame = 0; frame < 10'000; ++frame) {
            renderer().surface().refine_beside(true);
            static_cast<void>(render(picture));
            if (renderer().stats().part == all_of(renderer().size())) return frame;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return -1;
    };
    ASSERT_GE(frames_until_coarser(), 0) << "it never came";
    EXPECT_EQ(renderer().stats().patch_counts.coarser, 1u);
    renderer().surface().refine_beside(true);
    static_cast<void>(render(picture));
    EXPECT_TRUE(renderer().stats().part.empty()) << "once it is there nothing more is drawn";
}

// A patch that changes all the time is not worth it; once it rests it is.
TEST_F(Patches, PatchesThatChangeAreLeftAloneUntilTheyRest) {
    const picture::Picture picture = bare_scene();
    const auto wait_for_any = [&](bool resting) {
        bool coarser = false;
        for (int turn = 0; turn < 50 && !coarser; ++turn) {
            renderer().surface().refine_beside(resting);
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            static_cast<void>(render(picture));
            coarser = renderer().stats().patch_counts.coarser > 0;
        }
        return coarser;
    };
    for (int change = 0; change < 5; ++change) {
        set(1, ball_surface({0, 0.15, 0}, 0.01 + 0.0001 * change, kGrey, 40));
        static_cast<void>(render(picture));
        for (int frame = 0; frame < 10; ++frame) {
            renderer().surface().refine_beside(false);
            static_cast<void>(render(picture));
            ASSERT_EQ(renderer().stats().patch_counts.coarser, 0u);
        }
    }
    for (int turn = 0; turn < 200; ++turn)
        if (wait_for_any(true)) return;
    FAIL() << "it never came";
}

// What has just come may stay as it is, and so may its first light; only what has changed may soon change again.
TEST_F(Patches, NeedRestForLevelsOnlyOnceTheyHaveChanged) {
    PatchStore store;
    DrawnPatches drawn(store);
    const auto tile = [](double radius) {
        const Surface ball = ball_surface({0, 0.15, 0}, radius, kGrey, 8);
        auto made = std::make_shared<geometry::SurfaceTile>();
        made->vertices.assign(ball.vertices.begin(), ball.vertices.end());
        made->indices.assign(ball.indices.begin(), ball.indices.end());
        return made;
    };
    const auto flush = [&] {
        auto commands = gpu::Commands::begin(device());
        ASSERT_TRUE(commands && store.flush(device(), *commands));
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission && submission->wait());
        for (const PatchStore::Patch* patch : store.in_order()) drawn.of(*patch).wanted = true;
    };
    const auto first = tile(0.02);
    const auto light = [&](std::uint8_t sun) {
        return std::vector<geometry::VertexLight>(first->vertices.size(), {.sun = sun, .open = 255});
    };
    store.set(1, first);
    flush();
    EXPECT_TRUE(store.next_detail(false)) << "new";
    store.set_light(1, light(200));
    flush();
    EXPECT_TRUE(store.next_detail(false)) << "its first light";
    store.set_light(1, light(100));
    flush();
    EXPECT_FALSE(store.next_detail(false)) << "other light";
    EXPECT_TRUE(store.next_detail(true));
    store.set(1, tile(0.03));
    flush();
    EXPECT_FALSE(store.next_detail(false)) << "another surface";
    for (int frame = 0; frame < 100; ++frame) flush();
    EXPECT_TRUE(store.next_detail(false)) << "it has rested";
}

// The new mesh may have as many vertices as the old one, so that nothing but the order tells whose light it is.
TEST_F(Patches, ANewMeshIsNotLitByTheLightOfTheOldOne) {
    const picture::Picture picture = bare_scene();
    const Surface ball = ball_surface({0, 0.15, 0}, 0.03, kGrey, 20),
                  moved = ball_surface({0.01, 0.15, 0}, 0.03, kGrey, 20);
    ASSERT_EQ(ball.vertices.size(), moved.vertices.size());
    const std::vector<geometry::VertexLight> dark(ball.vertices.size(), {.sun = 0, .open = 40}),
        dim(ball.vertices.size(), {.sun = 100, .open = 150});
    set(1, moved);
    const StereoImage lit = render(picture);
    renderer().surface().set_patch_light(1, dim);
    const StereoImage dimmed = render(picture);
    ASSERT_FALSE(lit.left.rgba == dimmed.left.rgba);

    set(1, ball);
    renderer().surface().set_patch_light(1, dark);  // comes with the mesh
    static_cast<void>(render(picture));
    set(1, moved);
    EXPECT_TRUE(render(picture).left.rgba == lit.left.rgba) << "the light went with its mesh";

    set(1, ball);
    static_cast<void>(render(picture));
    renderer().surface().set_patch_light(1, dark);  // comes later, and is overtaken before the next frame
    set(1, moved);
    EXPECT_TRUE(render(picture).left.rgba == lit.left.rgba) << "the light was for the mesh before";

    set(1, ball);
    static_cast<void>(render(picture));
    renderer().surface().set_patch_light(1, dark);
    set(1, moved);
    renderer().surface().set_patch_light(1, dim);
    EXPECT_TRUE(render(picture).left.rgba == dimmed.left.rgba) << "the last light counts";

    set(1, ball);
    static_cast<void>(render(picture));
    renderer().surface().set_patch_light(1, dark);
    renderer().surface().clear_patches();
    set(1, moved);
    EXPECT_TRUE(render(picture).left.rgba == lit.left.rgba) << "nothing outlives a clearing";
}

// Levels hide what light shows, so those of another light or mesh must not come back.
TEST_F(Patches, TakesNoLevelsOfAnotherMeshOrLight) {
    PatchStore store;
    DrawnPatches drawn(store);
    const auto tile = [](double radius) {
        const Surface ball = ball_surface({0, 0.15, 0}, radius, kGrey, 8);
        auto made = std::make_shared<geometry::SurfaceTile>();
        made->vertices.assign(ball.vertices.begin(), ball.vertices.end());
        made->indices.assign(ball.indices.begin(), ball.indices.end());
        return made;
    };
    const auto flush = [&] {
        auto commands = gpu::Commands::begin(device());
        ASSERT_TRUE(commands && store.flush(device(), *commands));
        auto submission = std::move(*commands).submit();
        ASSERT_TRUE(submission && submission->wait());
        for (const PatchStore::Patch* patch : store.in_order()) drawn.of(*patch).wanted = true;
    };
    const auto levels_of = [&]() -> DetailDone {
        auto job = store.next_detail(true);
        EXPECT_TRUE(job);
        if (!job) return {};
        const std::vector<std::uint32_t> one{job->surface->indices.begin(), job->surface->indices.begin() + 3};
        return {std::move(*job), {{.indices = one, .smooth = 3, .error_m = 1e-4}}};
    };
    const auto first = tile(0.02);
    store.set(1, first);
    flush();
    DetailDone of_first = levels_of();
    const std::vector<geometry::VertexLight> light(first->vertices.size(), {.sun = 90, .open = 255});
    store.set_light(1, light);
    flush();
    EXPECT_FALSE(store.take(std::move(of_first))) << "other light";
    DetailDone of_lit = levels_of();
    store.set(1, tile(0.021));
    store.set_light(1, light);
    flush();
    EXPECT_FALSE(store.take(std::move(of_lit))) << "another mesh";
    EXPECT_TRUE(store.take(levels_of())) << "as it is";
}

TEST_F(Patches, KeepTheirLevelsInPicturesOfAnotherSize) {
    const picture::Picture picture = bare_scene();
    const Surface ball = ball_surface({0, 0.15, 0}, 0.01, kGrey, 40);
    constexpr ImageSize kOther{100, 160};
    set(1, ball);
    static_cast<void>(render(picture));
    ASSERT_GT(renderer().surface().refine(10), 0u);
    ASSERT_TRUE(renderer().resize(kOther));
    const StereoImage resized = render(picture);
    EXPECT_EQ(renderer().stats().patch_counts.coarser, 1u);
    EXPECT_EQ(renderer().stats().pipelines, 1u) << "pipelines stay as well";

    auto fresh = Renderer::create(device(), kOther);
    ASSERT_TRUE(fresh);
    fresh->surface().set_patch(1, ball.vertices, ball.indices);
    ASSERT_TRUE(fresh->render(picture));
    ASSERT_GT(fresh->surface().refine(10), 0u);
    fresh->forget_picture();
    const auto expected = fresh->render(picture);
    ASSERT_TRUE(expected);
    EXPECT_TRUE(resized.left.size == kOther && resized.left.rgba == expected->left.rgba);
    EXPECT_TRUE(resized.right.rgba == expected->right.rgba);
    EXPECT_FALSE(renderer().resize({0, 160}));
    EXPECT_TRUE(render(picture).left.rgba == expected->left.rgba) << "an Error leaves it as it was";
}

// A mode that never shows one of the eyes has the other one's picture alone, which is the same bit for bit.
TEST_F(Patches, AreDrawnForOneEyeAsForBoth) {
    picture::Picture picture = bare_scene();
    picture.show_grid = picture.show_wall_frame = true;
    picture.tool = {0.01, {0.0, 0.16, 0.05}, {0.9, 0.5, 0.2}, {}, true};
    set(1, ball_surface({0, 0.15, 0}, 0.05));
    const StereoImage both = render(picture);
    ASSERT_FALSE(both.left.rgba == both.right.rgba);
    const std::uint32_t pipelines = renderer().stats().pipelines;
    ASSERT_TRUE(renderer().resize(kTestSize, Views::left));
    EXPECT_TRUE(render(picture).left.rgba == both.left.rgba);
    ASSERT_TRUE(renderer().resize(kTestSize, Views::right));
    EXPECT_TRUE(render(picture).right.rgba == both.right.rgba);
    picture.tool.center_world.x += 0.02;
    const StereoImage part = render(picture);
    EXPECT_FALSE(renderer().stats().part == all_of(kTestSize));
    ASSERT_TRUE(renderer().resize(kTestSize, Views::both));
    EXPECT_TRUE(render(picture).right.rgba == part.right.rgba) << "also in part";
    EXPECT_EQ(renderer().stats().pipelines, 3 * pipelines) << "those of both were kept";
}

}  // namespace burin::renderer
