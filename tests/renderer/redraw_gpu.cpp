// SPDX-License-Identifier: MIT
// Drawing only what has changed gives, bit for bit, the picture that drawing everything gives: random changes of the
// scene before a still head, each drawn by one renderer in part and by another as a whole.
#include <random>

#include "tests/renderer/panel/panel_pictures.hpp"
#include "tests/renderer/test_scene.hpp"

namespace burin::renderer {
namespace {

constexpr ImageSize kSize{240, 180};

// A ball in patches of a few rings and segments each, which meet without cracks.
std::vector<Surface> ball_in_patches(const Vec3& center, double radius, std::uint32_t colour) {
    constexpr int kParts = 6, kRings = 8;
    std::vector<Surface> parts;
    for (int i = 0; i < kParts; ++i)
        for (int j = 0; j < kParts; ++j) {
            Surface s;
            for (int y = 0; y <= kRings; ++y)
                for (int x = 0; x <= kRings; ++x) {
                    const double latitude = std::numbers::pi * ((i * kRings + y) / double(kParts * kRings) - 0.5);
                    const double a = 2.0 * std::numbers::pi * (j * kRings + x) / double(kParts * kRings);
                    const Vec3 n{std::cos(latitude) * std::cos(a), std::sin(latitude),
                                 -std::cos(latitude) * std::sin(a)};
                    s.vertex(center + radius * n, n, colour);
                }
            constexpr std::uint32_t kRow = kRings + 1;
            for (std::uint32_t y = 0; y < kRings; ++y)
                for (std::uint32_t x = 0; x < kRings; ++x) {
                    const std::uint32_t a = y * kRow + x;
                    s.indices.insert(s.indices.end(), {a, a + 1, a + kRow + 1, a, a + kRow + 1, a + kRow});
                }
            parts.push_back(std::move(s));
        }
    return parts;
}

picture::Picture furnished_scene() {
    picture::Picture picture = bare_scene();
    picture.show_grid = picture.show_wall_frame = true;
    picture.pedestal = {{0, 0.06, -0.1}, 0.08, {0.7, 0.7, 0.7}, true};
    picture.workpiece_object.include({-0.08, 0.07, -0.18});
    picture.workpiece_object.include({0.08, 0.23, -0.02});
    picture.box = {{{0.05, 0.15, -0.03}, Quat{1, 0, 0, 0}}, {0.12, 0.1, 0.08}, {0.3, 0.6, 0.8}, true};
    return picture;
}

// What a session may do between two frames, to the scene and to both renderers.
class Changes {
public:
    Changes(gpu::Device& device, PanelPainter& painter, picture::Picture& picture, std::array<Renderer*, 2> renderers)
        : device_(device), painter_(painter), picture_(picture), renderers_(renderers) {
        for (Renderer* r : renderers_) r->show_panel(painter.view());
        paint_panel();
        for (const std::uint32_t colour : {kGrey, kRed})
            looks_.push_back(ball_in_patches({0, 0.15, -0.1}, 0.07, colour));
        for (std::uint32_t id = 0; id < looks_[0].size(); ++id) set(id, looks_[0][id]);
    }
    void make() {
        const std::uint32_t id = number(static_cast<std::uint32_t>(looks_[0].size()));
        switch (number(17)) {
            case 0:
            case 1:
            case 2: move_tool(); break;
            case 3: picture_.tool.visible = !picture_.tool.visible; break;
            case 4: picture_.box.center_world.position_m = somewhere(); break;
            case 5:
                picture_.proposed_box = {
                    {somewhere(), turn()}, {0.06, 0.05, 0.04}, {0.9, 0.6, 0.2}, number(2) == 0, 0.2};
                break;
            case 6: picture_.bubble = {somewhere(), between(0.01, 0.05), {0.4, 0.7, 0.6}, number(3) > 0}; break;
            case 7: set(id, looks_[number(2)][id]); break;
            case 8:
                for (Renderer* r : renderers_) r->surface().remove_patch(id);
                break;
            case 9: light(id); break;
            case 10:
            case 11: touch(); break;
            case 12: picture_.contact.visible = !picture_.contact.visible; break;
            case 13: stand_panel(); break;
            case 14: picture_.panel.reset(); break;
            case 15: paint_panel(); break;
            case 16:
                if (picture_.objects.size() > 3) picture_.objects.erase(picture_.objects.begin());
                picture_.objects.push_back(
                    {mesh_, {somewhere(), turn(), between(0.002, 0.02)}, {between(0, 1), 0.5, 0.3}});
                break;
            default: break;
        }
    }

private:
    std::uint32_t number(std::uint32_t below) { return static_cast<std::uint32_t>(random_() % below); }
    double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
    Vec3 somewhere() { return {between(-0.1, 0.1), between(0.05, 0.25), between(-0.12, 0.1)}; }
    Quat turn() { return glm::angleAxis(between(-2.0, 2.0), glm::normalize(somewhere())); }
    void move_tool() {
        picture_.tool.visible = true;
        picture_.tool.radius_m = between(0.002, 0.015);
        picture_.tool.center_world = somewhere();
        picture_.tool.stylus_world = {picture_.tool.center_world, turn()};
        picture_.tool.colour = {between(0, 1), between(0, 1), between(0, 1)};
        picture_.tool.mesh = nullptr;
        picture_.tool.spine_m = Vec3(0.0);
        if (number(2) == 0) return;
        // A long box along its spine, no wider than the round about it.
        picture_.tool.mesh = mesh_;
        const Quat turned = turn();
        picture_.tool.world_from_mesh = {picture_.tool.center_world, turned, picture_.tool.radius_m};
        picture_.tool.spine_m = picture_.tool.radius_m * (turned * Vec3(0.0, 4.0, 0.0));
    }
    // At the tool's ball or away from it, with any force from none to too much.
    void touch() {
        picture::PictureContact& c = picture_.contact;
        const Vec3 normal = turn() * Vec3(0, 0, 1);
        c.point_world = number(2) == 0 ? somewhere() : picture_.tool.center_world - picture_.tool.radius_m * normal;
        c.normal_world = normal;
        c.force_N = between(0.0, 6.0) * (turn() * Vec3(0, 0, 1));
        c.metres_per_N = between(0.005, 0.02);
        c.colour = {between(0, 1), between(0, 1), between(0, 1)};
        c.visible = true;
    }
    void stand_panel() {
        const std::uint64_t version = picture_.panel ? picture_.panel->version : 0;
        picture_.panel =
            picture::PicturePanel{{{somewhere(), turn()}, {between(0.02, 0.2), between(0.02, 0.2)}}, version};
    }
    void paint_panel() {
        PanelMesh mesh;
        add_box(mesh, {0, 0, 64, 48}, rgba(number(256), number(256), number(256), 200));
        add_box(mesh, {number(30), number(20), 30, 20}, rgba(number(256), 200, 100, 255), kThird);
        auto commands = gpu::Commands::begin(device_);
        ASSERT_TRUE(painter_.record(*commands, mesh));
        ASSERT_TRUE(std::move(*commands).submit());
        if (picture_.panel) ++picture_.panel->version;
    }
    void set(std::uint32_t id, const Surface& s) {
        for (Renderer* r : renderers_) r->surface().set_patch(id, s.vertices, s.indices);
    }
    void light(std::uint32_t id) {
        std::vector<geometry::VertexLight> lights(looks_[0][id].vertices.size());
        for (geometry::VertexLight& l : lights)
            l = {static_cast<std::uint8_t>(number(256)), static_cast<std::uint8_t>(number(256))};
        for (Renderer* r : renderers_) r->surface().set_patch_light(id, lights);
    }

    static std::shared_ptr<const picture::DrawnMesh> long_box() {
        geometry::TriangleMesh box;
        for (int i = 0; i < 8; ++i)
            box.positions_m.emplace_back((i & 1) != 0 ? 0.7 : -0.7, (i & 2) != 0 ? 4.7 : -0.7,
                                         (i & 4) != 0 ? 0.7 : -0.7);
        box.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                         {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
        return picture::drawn_mesh(box);
    }

    gpu::Device& device_;
    PanelPainter& painter_;
    std::shared_ptr<const picture::DrawnMesh> mesh_ = long_box();
    picture::Picture& picture_;
    std::array<Renderer*, 2> renderers_;
    std::mt19937 random_{7};
    std::vector<std::vector<Surface>> looks_;
};

std::size_t different_pixels(const Image& a, const Image& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) count += same_colour(&a.rgba[i], &b.rgba[i]) ? 0 : 1;
    return count;
}

class Redraw : public gpu::DeviceTest {
protected:
    // refined: the first picture has coarser levels, and later ones keep them.
    void compare(std::uint32_t samples, bool refined, int frames, double fade = 0.0) {
        std::vector<Renderer> made;
        for (int i = 0; i < 2; ++i) {
            auto renderer = Renderer::create(device(), kSize, {.samples = samples});
            ASSERT_TRUE(renderer) << renderer.error().line();
            made.push_back(std::move(*renderer));
        }
        picture::Picture picture = furnished_scene();
        picture.edge_fade = fade;
        picture.edge_fade_band = 0.7;
        auto painter = PanelPainter::create(device(), {64, 48}, plain_atlas());
        ASSERT_TRUE(painter) << painter.error().line();
        Changes changes(device(), *painter, picture, {&made[0], &made[1]});
        for (Renderer& r : made) {
            ASSERT_TRUE(r.render(picture));
            const std::size_t made_coarser = refined ? r.surface().refine(1000) : 0;
            ASSERT_EQ(made_coarser > 0, refined);
            r.forget_picture();
            ASSERT_TRUE(r.render(picture));
            ASSERT_EQ(r.stats().patch_counts.coarser > 0, refined);
        }
        std::size_t parts = 0;
        for (int frame = 0; frame < frames; ++frame) {
            for (int change = 0; change <= frame % 3; ++change) changes.make();
            const auto part = made[0].render(picture);
            made[1].forget_picture();
            const auto whole = made[1].render(picture);
            ASSERT_TRUE(part && whole);
            if (made[0].stats().part != all_of(kSize)) ++parts;
            if (made[0].stats().parts.size() > 1) ++apart_;
            ASSERT_EQ(different_pixels(part->left, whole->left), 0u) << "left, frame " << frame;
            ASSERT_EQ(different_pixels(part->right, whole->right), 0u) << "right, frame " << frame;
        }
        EXPECT_GT(3 * parts, 2 * static_cast<std::size_t>(frames)) << "most frames were drawn in part";
    }

    std::size_t apart_ = 0;  // frames that were drawn in several parts
};

}  // namespace

TEST_F(Redraw, OfWhatChangedEqualsDrawingEverything) {
    compare(1, false, 60);
    EXPECT_GT(apart_, 0u);
}

TEST_F(Redraw, OfWhatChangedEqualsDrawingEverythingWithSeveralSamples) { compare(0, false, 30); }

TEST_F(Redraw, OfWhatChangedEqualsDrawingEverythingWithCoarserLevels) {
    compare(1, true, 30);
    if (!HasFatalFailure()) compare(0, true, 15);
}

TEST_F(Redraw, OfWhatChangedEqualsDrawingEverythingWhereParallaxFades) {
    compare(1, true, 20, 0.9);
    if (!HasFatalFailure()) compare(0, false, 6, 1.0);
}

// The tool keeps the surroundings' light off what is near it, farther than it reaches itself; here that is a pedestal
// alone.
TEST_F(Redraw, OfAToolOverAPedestalEqualsDrawingEverything) {
    auto in_part = Renderer::create(device(), kSize), as_a_whole = Renderer::create(device(), kSize);
    ASSERT_TRUE(in_part && as_a_whole);
    picture::Picture picture = bare_scene();
    picture.viewer.head_world.position_m = {0.0, 0.35, 0.6};  // looks down on it
    picture.pedestal = {{0, 0.06, -0.1}, 0.14, {0.7, 0.7, 0.7}, true};
    // Close over it, and as high as a shadow is cast at all, where that has a wide soft edge.
    for (const Vec3& at : {Vec3(0, 0.08, -0.1), Vec3(0.01, 0.08, -0.08), Vec3(-0.07, 0.28, 0.02),
                           Vec3(-0.03, 0.28, 0.02), Vec3(-0.03, 0.28, -0.01)}) {
        picture.tool = {0.015, at, {0.9, 0.5, 0.2}, {}, true};
        const auto part = in_part->render(picture);
        as_a_whole->forget_picture();
        const auto whole = as_a_whole->render(picture);
        ASSERT_TRUE(part && whole);
        EXPECT_EQ(different_pixels(part->left, whole->left), 0u) << at.y;
        EXPECT_EQ(different_pixels(part->right, whole->right), 0u) << at.y;
    }
    EXPECT_NE(in_part->stats().part, all_of(kSize));
}

TEST_F(Redraw, OfNothingDrawsNothing) {
    auto renderer = Renderer::create(device(), kSize);
    ASSERT_TRUE(renderer);
    const picture::Picture picture = furnished_scene();
    const Surface ball = ball_surface({0, 0.15, -0.1}, 0.07);
    renderer->surface().set_patch(0, ball.vertices, ball.indices);
    const auto first = renderer->render(picture), second = renderer->render(picture);
    ASSERT_TRUE(first && second);
    EXPECT_TRUE(renderer->stats().part.empty());
    EXPECT_EQ(renderer->stats().draws, 0u);
    EXPECT_TRUE(first->left.rgba == second->left.rgba);
}

// A tool that moves: its stylus, its shadow and where it touches are far apart, and with one rectangle around all of
// them as well the picture is the same.
TEST_F(Redraw, OfPartsApartDrawsFewerPixelsThanOneAroundThem) {
    std::vector<Renderer> made;
    for (const bool apart : {true, false}) {
        auto renderer = Renderer::create(device(), {960, 720}, {.samples = 1, .savings = {.parts_apart = apart}});
        ASSERT_TRUE(renderer);
        made.push_back(std::move(*renderer));
    }
    picture::Picture picture = furnished_scene();
    picture.box.visible = false;
    const std::vector<Surface> ball = ball_in_patches({0, 0.15, -0.1}, 0.07, kGrey);
    std::array<std::uint64_t, 2> pixels{};
    for (Renderer& r : made)
        for (std::uint32_t id = 0; id < ball.size(); ++id)
            r.surface().set_patch(id, ball[id].vertices, ball[id].indices);
    for (int frame = 0; frame < 4; ++frame) {
        const Vec3 at{0.004 * frame, 0.19, -0.04};
        picture.tool = {0.003, at, {0.9, 0.5, 0.2}, {at, glm::angleAxis(1.2, glm::normalize(Vec3(-1, 1, 0)))}, true};
        std::array<std::optional<StereoImage>, 2> pictures;
        for (std::size_t i = 0; i < 2; ++i) {
            auto drawn = made[i].render(picture);
            ASSERT_TRUE(drawn);
            pictures[i] = std::move(*drawn);
            if (frame == 0) continue;
            for (const PixelRect& part : made[i].stats().parts) pixels[i] += std::uint64_t{part.width} * part.height;
        }
        EXPECT_TRUE(pictures[0]->left.rgba == pictures[1]->left.rgba);
        EXPECT_TRUE(pictures[0]->right.rgba == pictures[1]->right.rgba);
    }
    EXPECT_LT(pixels[0], pixels[1]);
    EXPECT_GT(pixels[0], 0u);
}

}  // namespace burin::renderer
