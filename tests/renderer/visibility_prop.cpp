// SPDX-License-Identifier: MIT
// What culling leaves out cannot be seen: from a hundred thousand random heads before random screens, each patch that
// is left out is looked at triangle by triangle, in the world frame and by other means: lines of sight meet the
// screen's plane (point_on_screen), triangles are asked for their own side, and boxes are tried by separating axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "renderer/surface/visibility.hpp"
#include "shaders/shared/parallax_fade.h"
#include "wall/projection.hpp"

namespace burin::renderer {
namespace {

constexpr ImageSize kSize{1280, 720};

class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}
    double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
    bool once_in(int n) { return std::uniform_int_distribution<int>(1, n)(engine_) == 1; }
    Vec3 direction() {
        for (;;) {
            const Vec3 v{between(-1, 1), between(-1, 1), between(-1, 1)};
            const double length = glm::length(v);
            if (length > 0.1 && length <= 1.0) return v / length;
        }
    }
    Quat turn() { return glm::angleAxis(between(0.0, std::numbers::pi), direction()); }

private:
    std::mt19937 engine_;
};

struct Patch {
    std::vector<shared::SurfaceVertex> vertices;
    std::vector<std::uint32_t> indices;
    PatchShape shape;
};
struct Solid {
    std::vector<Patch> patches;
    std::vector<Box> inner;  // wholly inside
};

// A star-shaped closed surface around a middle: r = R (1 + b sin(w n.d1) sin(w n.d2)), in 12 sectors of 3 rings.
void add_blob(Solid& solid, const Vec3& middle, double radius, double bumps, Random& random) {
    const Vec3 d1 = random.direction(), d2 = random.direction();
    const auto at = [&](int ring, int segment) {
        const double latitude = std::numbers::pi * (ring / 6.0 - 0.5), a = std::numbers::pi * segment / 6.0;
        const Vec3 n{std::cos(latitude) * std::cos(a), std::sin(latitude), -std::cos(latitude) * std::sin(a)};
        const Vec3 p =
            middle + radius * (1.0 + bumps * std::sin(7.0 * glm::dot(n, d1)) * std::sin(7.0 * glm::dot(n, d2))) * n;
        return shared::SurfaceVertex{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z), 0, 0};
    };
    for (int ring = 0; ring < 6; ring += 2)
        for (int segment = 0; segment < 12; segment += 2) {
            Patch patch;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3; ++j) patch.vertices.push_back(at(ring + i, segment + j));
            for (std::uint32_t i = 0; i < 2; ++i)
                for (std::uint32_t j = 0; j < 2; ++j) {
                    const std::uint32_t a = 3 * i + j;
                    patch.indices.insert(patch.indices.end(), {a, a + 1, a + 4, a, a + 4, a + 3});
                }
            patch.shape = shape_of(patch.vertices, patch.indices);
            solid.patches.push_back(std::move(patch));
        }
    // The mesh lies within its vertices' distances from the middle, less what its flat triangles cut off.
    const double half = 0.72 * (1.0 - bumps) * radius / std::sqrt(3.0);
    solid.inner.push_back({middle - Vec3(half), middle + Vec3(half)});
}

Solid random_solid(Random& random) {
    Solid solid;
    add_blob(solid, Vec3(0.0), 0.1, random.between(0.0, 0.3), random);
    for (int i = 0; i < 3; ++i)
        add_blob(solid, 0.16 * random.direction(), 0.03, random.between(0.1, 0.4),
                 random);  // small and rough: often hidden
    return solid;
}

wall::Screen random_screen(Random& random) {
    const Quat turn = random.turn();
    const double width = random.between(0.2, 3.0), height = random.between(0.2, 3.0);
    const Vec3 x = turn * Vec3(width, 0, 0), y = turn * Vec3(0, height, 0);
    const Vec3 middle = random.between(0.0, 2.0) * random.direction();
    return {middle - 0.5 * (x + y), middle + 0.5 * (x - y), middle - 0.5 * (x - y)};
}

// From 1 cm to 3 m before the screen's plane and up to several widths to the side; the workpiece anywhere near.
picture::Picture random_view(Random& random) {
    picture::Picture picture;
    picture.screen = random_screen(random);
    const wall::Screen& s = picture.screen;
    const Vec3 x = s.lower_right_world - s.lower_left_world, y = s.upper_left_world - s.lower_left_world;
    const Vec3 out = glm::normalize(glm::cross(x, y));
    const double away = random.once_in(4) ? random.between(0.01, 0.06) : random.between(0.1, 3.0);
    const double aside = random.once_in(4) ? 4.0 : 0.6;
    const auto on_screen = [&](double most) {
        return s.lower_left_world + (0.5 + random.between(-most, most)) * x + (0.5 + random.between(-most, most)) * y;
    };
    picture.viewer.head_world.position_m = on_screen(aside) + away * out;
    picture.viewer.head_world.orientation = random.turn();
    picture.world_from_object.orientation = random.turn();
    picture.world_from_object.scale = std::exp(random.between(-1.0, 2.0));
    picture.world_from_object.position_m = on_screen(0.8) + random.between(-1.5, 0.5) * out;
    picture.lattice_origin_object = 0.1 * random.direction();
    return picture;
}

// A way from a to b and a box, by separating axes (Ericson, Real-Time Collision Detection, 5.3.3), with the box a
// little larger: a way that just touches it counts as meeting it.
bool way_meets(const Vec3& a, const Vec3& b, const Box& box) {
    const Vec3 half = 0.5 * box.extent() * (1.0 + 1e-9), middle = 0.5 * (a + b) - box.center(), along = 0.5 * (b - a);
    const Vec3 size = glm::abs(along);
    for (int i = 0; i < 3; ++i)
        if (std::abs(middle[i]) > half[i] + size[i]) return false;
    const Vec3 across = glm::abs(glm::cross(middle, along));
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        if (across[i] > half[j] * size[k] + half[k] * size[j]) return false;
    }
    return true;
}

// The scene as one eye sees it, for brute force.
class Looker {
public:
    Looker(const picture::Picture& picture, const Solid& solid, const Vec3& eye_world)
        : picture_(picture), solid_(solid), eye_world_(eye_world) {
        const Similarity object_from_world = inverse(picture.world_from_object);
        eye_ = object_from_world * eye_world - picture.lattice_origin_object;
        width_ = glm::length(picture.screen.lower_right_world - picture.screen.lower_left_world);
        height_ = glm::length(picture.screen.upper_left_world - picture.screen.lower_left_world);
    }
    // Some of the patch's triangles show their front, at one of four points, to the eye.
    [[nodiscard]] bool sees(const Patch& patch) const {
        for (std::size_t t = 0; t < patch.indices.size(); t += 3) {
            std::array<Vec3, 4> p;
            for (std::size_t k = 0; k < 3; ++k) {
                const shared::SurfaceVertex& v = patch.vertices[patch.indices[t + k]];
                p[k] = {v.x, v.y, v.z};
            }
            p[3] = (p[0] + p[1] + p[2]) / 3.0;
            if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), eye_ - p[0]) <= 0.0) continue;
            for (const Vec3& point : p)
                if (in_picture(point) && in_the_open(point)) return true;
        }
        return false;
    }

private:
    [[nodiscard]] bool in_picture(const Vec3& point) const {
        const Vec3 world = picture_.world_from_object * (picture_.lattice_origin_object + point);
        const double ahead =
            wall::distance_in_front(picture_.screen, eye_world_) - wall::distance_in_front(picture_.screen, world);
        if (ahead <= 1e-6) return false;
        const Vec2 at = point_on_screen(picture_.screen, eye_world_, world);
        return at.x >= 0.0 && at.y >= 0.0 && at.x <= width_ && at.y <= height_;
    }
    [[nodiscard]] bool in_the_open(const Vec3& point) const {
        for (const Box& box : solid_.inner)
            if (way_meets(eye_, point, box)) return false;
        return true;
    }

    const picture::Picture& picture_;
    const Solid& solid_;
    Vec3 eye_world_, eye_{0.0};
    double width_ = 0.0, height_ = 0.0;
};

// What the vertex shader makes of a patch where parallax fades, in both eyes' pictures.
class FadedDrawing {
public:
    explicit FadedDrawing(const picture::Picture& picture) : picture_(picture) {
        const wall::Eyes eyes = wall::eyes_of(picture.viewer);
        middle_ = middle_of(eyes);
        const std::array from{eyes.left_world, eyes.right_world, middle_};
        for (std::size_t i = 0; i < 3; ++i) clip_[i] = off_axis_projection(picture.screen, from[i], 0.005, 200.0);
    }
    struct Seen {
        bool moves = false;  // a vertex is not where the eye sees it
        bool shows = false;  // a triangle's front is within a picture, at one of four points
    };
    [[nodiscard]] Seen look(const Patch& patch) const {
        Seen seen;
        for (std::size_t eye = 0; eye < 2; ++eye) {
            std::vector<glm::vec4> drawn;
            for (const shared::SurfaceVertex& v : patch.vertices) {
                const glm::dvec4 world(
                    picture_.world_from_object * (picture_.lattice_origin_object + Vec3{v.x, v.y, v.z}), 1.0);
                const glm::vec4 plain(clip_[eye] * world);
                drawn.push_back(shared::parallax_faded(
                    plain, glm::vec4(clip_[2] * world),
                    static_cast<float>(wall::distance_in_front(picture_.screen, middle_)),
                    static_cast<float>(picture_.edge_fade), static_cast<float>(picture_.edge_fade_band)));
                seen.moves |= drawn.back() != plain;
            }
            for (std::size_t t = 0; t < patch.indices.size(); t += 3)
                seen.shows |=
                    shows({drawn[patch.indices[t]], drawn[patch.indices[t + 1]], drawn[patch.indices[t + 2]]});
        }
        return seen;
    }

private:
    static bool shows(const std::array<glm::vec4, 3>& clip) {
        std::array<Vec2, 4> p{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (clip[i].w < 1e-3f) return false;  // cut by the eye's plane: not looked at
            p[i] = {clip[i].x / clip[i].w, clip[i].y / clip[i].w};
            p[3] += p[i] / 3.0;
        }
        const Vec2 u = p[1] - p[0], v = p[2] - p[0];
        if (u.x * v.y - u.y * v.x >= -1e-6) return false;  // y is down: fronts turn the other way
        return std::ranges::any_of(p, [](const Vec2& q) { return std::abs(q.x) <= 1.0 && std::abs(q.y) <= 1.0; });
    }

    const picture::Picture& picture_;
    Vec3 middle_{0.0};
    std::array<Mat4, 3> clip_;
};

}  // namespace

TEST(Culling, LosesNothingThatEitherEyeOfARandomHeadCouldSee) {
    constexpr int kHeads = 100'000, kHeadsASolid = 500, kPatchesAHead = 3;
    Random random(20);
    std::array<int, 4> reasons{};
    int heads = 0, seen = 0;
    Solid solid;
    while (heads < kHeads) {
        if (heads % kHeadsASolid == 0) solid = random_solid(random);
        const picture::Picture picture = random_view(random);
        const wall::Eyes eyes = wall::eyes_of(picture.viewer);
        if (!wall::can_be_seen(picture.screen, eyes)) continue;
        ++heads;
        const EyePair pair = eye_frusta(picture, kSize, all_of(kSize));
        for (int k = 0; k < kPatchesAHead; ++k) {
            const auto chosen =
                static_cast<std::size_t>(random.between(0.0, static_cast<double>(solid.patches.size())));
            const Patch& patch = solid.patches[std::min(chosen, solid.patches.size() - 1)];
            const Hidden why = hidden(pair, patch.shape, solid.inner);
            ++reasons[static_cast<std::size_t>(why)];
            const bool left = Looker(picture, solid, eyes.left_world).sees(patch),
                       right = Looker(picture, solid, eyes.right_world).sees(patch);
            seen += left || right ? 1 : 0;
            ASSERT_FALSE(why != Hidden::no && (left || right))
                << "head " << heads << ", reason " << static_cast<int>(why) << (left ? ", left eye" : ", right eye");
        }
    }
    // Each reason is tried often, and what is drawn is not all there is.
    for (const int count : reasons) EXPECT_GT(count, kHeads * kPatchesAHead / 200);
    EXPECT_GT(seen, kHeads * kPatchesAHead / 20);
    // Few are drawn in vain: what is not called hidden is seen, at one of few points, in half of the cases or more.
    EXPECT_GT(2 * seen, reasons[0]);
}

// Where parallax fades a vertex is drawn between where an eye and where the middle sees it. What is called bent() may
// be; the rest must be drawn where the eye sees it, bit for bit. Of neither is anything lost.
TEST(Culling, LosesNothingThatIsDrawnWhereParallaxFades) {
    constexpr int kHeads = 20'000, kHeadsASolid = 200, kPatchesAHead = 3;
    Random random(22);
    int bent_patches = 0, moved = 0, bent_and_hidden = 0, bent_and_seen = 0, straight_and_hidden = 0;
    Solid solid;
    for (int head = 0; head < kHeads; ++head) {
        if (head % kHeadsASolid == 0) solid = random_solid(random);
        picture::Picture picture = random_view(random);
        picture.edge_fade = random.between(0.2, 1.0);
        picture.edge_fade_band = random.between(0.0, 0.6);
        if (!wall::can_be_seen(picture.screen, wall::eyes_of(picture.viewer))) continue;
        const EyePair pair = eye_frusta(picture, kSize, all_of(kSize));
        const bool bends =
            std::ranges::any_of(solid.patches, [&](const Patch& patch) { return bent(pair, patch.shape.bounds); });
        for (int k = 0; k < kPatchesAHead; ++k) {
            const auto chosen =
                static_cast<std::size_t>(random.between(0.0, static_cast<double>(solid.patches.size())));
            const Patch& patch = solid.patches[std::min(chosen, solid.patches.size() - 1)];
            const bool is_bent = bent(pair, patch.shape.bounds);
            const bool gone = hidden(pair, patch.shape, bends ? std::span<const Box>{} : solid.inner) != Hidden::no;
            const FadedDrawing drawing(picture);
            const auto [moves, shows] = drawing.look(patch);
            ASSERT_FALSE(moves && !is_bent) << "head " << head;
            if (is_bent) {
                ASSERT_FALSE(gone && shows) << "head " << head;
            } else if (gone) {
                const wall::Eyes eyes = wall::eyes_of(picture.viewer);
                for (const Vec3& eye : {eyes.left_world, eyes.right_world})
                    ASSERT_FALSE(Looker(picture, solid, eye).sees(patch)) << "head " << head;
            }
            bent_patches += is_bent ? 1 : 0;
            moved += moves ? 1 : 0;
            bent_and_hidden += is_bent && gone ? 1 : 0;
            bent_and_seen += is_bent && shows ? 1 : 0;
            straight_and_hidden += !is_bent && gone ? 1 : 0;
        }
    }
    EXPECT_GT(moved, 1000);
    EXPECT_LT(bent_patches, 3 * moved) << "most of what is called bent is";
    EXPECT_GT(bent_and_hidden, 300);
    EXPECT_GT(bent_and_seen, 300);
    EXPECT_GT(straight_and_hidden, 1000);
}

// Not only whole pictures are culled: a part's frustum holds what the part shows.
TEST(Culling, OfAPartOfThePictureLosesNothingInIt) {
    Random random(21);
    int inside = 0;
    for (int i = 0; i < 20'000; ++i) {
        const picture::Picture picture = random_view(random);
        const wall::Eyes eyes = wall::eyes_of(picture.viewer);
        if (!wall::can_be_seen(picture.screen, eyes)) continue;
        const auto at = [&](double most) { return static_cast<std::uint32_t>(random.between(0.0, most)); };
        PixelRect part{at(kSize.width - 2), at(kSize.height - 2), 0, 0};
        part.width = 1 + at(kSize.width - part.x - 1);
        part.height = 1 + at(kSize.height - part.y - 1);
        const EyePair pair = eye_frusta(picture, kSize, part);
        const Vec3 p_world = picture.world_from_object * (0.3 * random.direction());
        if (wall::distance_in_front(picture.screen, eyes.left_world) -
                wall::distance_in_front(picture.screen, p_world) <
            1e-3)
            continue;
        const Vec2 on = point_on_screen(picture.screen, eyes.left_world, p_world);
        const double x =
            on.x / glm::length(picture.screen.lower_right_world - picture.screen.lower_left_world) * kSize.width;
        const double y = (1.0 - on.y / glm::length(picture.screen.upper_left_world - picture.screen.lower_left_world)) *
                         kSize.height;
        if (x < part.x || y < part.y || x > part.x + part.width || y > part.y + part.height) continue;
        ++inside;
        Box box;
        box.include(inverse(picture.world_from_object) * p_world - picture.lattice_origin_object);
        ASSERT_FALSE(beside(pair.eyes[0], box)) << x << " " << y;
    }
    EXPECT_GT(inside, 300);
}

}  // namespace burin::renderer
