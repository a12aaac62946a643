// SPDX-License-Identifier: MIT
// Touch lets go when the hand does: no hand in free air is held by a contact that is not there.
//
// Hands go at up to 2 m/s through meshes that are hard to touch, press, stop, and are set inside them; the mesh under
// them is exchanged for a thicker and a thinner one, as by undo and fill; work budgets go from 10 to 333 us, for one
// part and for twenty. Whenever the ball at the hand is clear of the mesh and outside it for 100 ticks, then by the end
// of these the proxy is at the hand and the force zero, unless the contact is sound: the ball at the proxy touches the
// mesh without being deep in it, and the mesh stands in its straight way to the hand. A tree of triangles that contact
// does not use judges all of this. BURIN_SOAK_OPERATIONS: so many ticks in all. BURIN_TOUCH_MODELS: a folder of meshes
// to be touched too.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <numbers>
#include <random>

#include "bench/measure/bumpy_sphere.hpp"
#include "bench/measure/rough_surfaces.hpp"
#include "devices/haptic/simulated_omni.hpp"
#include "geometry/contact/touch_mesh.hpp"
#include "geometry/files/mesh_import.hpp"
#include "geometry/mesh/triangle_tree.hpp"
#include "haptics/channels.hpp"
#include "haptics/contact/separation.hpp"
#include "haptics/haptic_loop.hpp"
#include "tests/haptics/session_tools.hpp"
#include "tests/haptics/surfaces.hpp"

namespace burin::haptics {
namespace {

constexpr int kTicksToLetGo = 100, kTicksBetweenLooks = 20;

// A mesh with what touches it and what judges by it.
class Touchable {
public:
    explicit Touchable(geometry::TriangleMesh mesh)
        : mesh_(std::move(mesh)), tree_(mesh_.positions_m, mesh_.triangles) {
        auto touched = geometry::TouchMesh::create(mesh_);
        snapshot_ = touched->snapshot();
        for (const Vec3& p : mesh_.positions_m) box_.include(p);
    }
    [[nodiscard]] geometry::LocalSurface surface(std::uint64_t sequence) const {
        geometry::LocalSurface surface;
        surface.sequence = sequence;
        surface.radius_m = 1e3;
        surface.meshes = {{snapshot_, 0}};
        return surface;
    }
    [[nodiscard]] double distance_m(const Vec3& p) const {
        const auto near = tree_.nearest(p, hint_);
        hint_ = near.triangle;
        return near.distance_m;
    }
    // By the winding number, the sum of all triangles' solid angles (Van Oosterom and Strackee 1983).
    [[nodiscard]] bool is_outside(const Vec3& p) const {
        double angle = 0.0;
        for (const auto& t : mesh_.triangles) {
            const Vec3 a = mesh_.positions_m[t[0]] - p, b = mesh_.positions_m[t[1]] - p,
                       c = mesh_.positions_m[t[2]] - p;
            const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
            angle += 2.0 * std::atan2(glm::dot(a, glm::cross(b, c)),
                                      la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
        }
        return std::abs(angle) < 2.0 * std::numbers::pi;
    }
    [[nodiscard]] bool is_way_clear(const Vec3& from, const Vec3& to, double radius_m) const {
        const double length = glm::length(to - from);
        const int parts = 1 + static_cast<int>(length / (0.2 * radius_m));
        for (int i = 0; i <= parts; ++i)
            if (distance_m(from + (static_cast<double>(i) / parts) * (to - from)) < radius_m) return false;
        return true;
    }
    [[nodiscard]] const Box& box() const { return box_; }
    [[nodiscard]] const geometry::TriangleMesh& mesh() const { return mesh_; }

private:
    geometry::TriangleMesh mesh_;
    geometry::TriangleTree tree_;
    std::shared_ptr<const geometry::TouchSnapshot> snapshot_;
    Box box_;
    mutable std::uint32_t hint_ = 0;
};

// Each vertex moved along the mean of its triangles' normals.
geometry::TriangleMesh thickened(geometry::TriangleMesh mesh, double by_m) {
    std::vector<Vec3> normals(mesh.positions_m.size(), Vec3(0.0));
    for (const auto& t : mesh.triangles) {
        const Vec3 n = glm::cross(mesh.positions_m[t[1]] - mesh.positions_m[t[0]],
                                  mesh.positions_m[t[2]] - mesh.positions_m[t[0]]);
        for (const std::uint32_t v : t) normals[v] += n;
    }
    for (std::size_t v = 0; v < normals.size(); ++v)
        if (glm::length(normals[v]) > 0.0) mesh.positions_m[v] += by_m * glm::normalize(normals[v]);
    return mesh;
}

struct LetGoScene {
    std::string name;
    std::unique_ptr<Touchable> now, thicker;
};

class LetGoDice {
public:
    explicit LetGoDice(std::uint64_t seed) : engine_(seed) {}
    double between(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
    bool one_in(int n) { return engine_() % static_cast<std::uint64_t>(n) == 0; }
    Vec3 in(const Box& box, double wider_m) {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p[axis] = between(box.lo[axis] - wider_m, box.hi[axis] + wider_m);
        return p;
    }

private:
    std::mt19937_64 engine_;
};

// A hand that goes from one place to the next, at a speed of its own for each, and rests in between.
class Hand {
public:
    Hand(const Box& box, std::uint64_t seed) : dice_(seed), box_(box), at_(dice_.in(box, 0.03)), to_(at_) {}
    Vec3 move() {
        const Vec3 way = to_ - at_;
        const double left_m = glm::length(way), step_m = 1e-3 * speed_;
        if (rest_ > 0) {
            --rest_;
        } else if (left_m <= step_m) {
            at_ = to_;
            to_ = dice_.in(box_, 0.03);
            speed_ = dice_.one_in(2) ? dice_.between(0.02, 0.3) : dice_.between(0.3, 2.0);
            rest_ = dice_.one_in(2) ? static_cast<int>(dice_.between(0.0, 300.0)) : 0;
        } else {
            at_ += (step_m / left_m) * way;
        }
        return at_;
    }
    // Half of them inside or nearly so.
    void set_elsewhere(const geometry::TriangleMesh& mesh) {
        at_ = dice_.in(box_, 0.03);
        if (dice_.one_in(2)) {
            const auto vertex =
                static_cast<std::size_t>(dice_.between(0.0, 1.0) * static_cast<double>(mesh.positions_m.size() - 1));
            at_ = mesh.positions_m[vertex] + 0.003 * dice_.in({Vec3(-1.0), Vec3(1.0)}, 0.0);
        }
    }
    LetGoDice& dice() { return dice_; }

private:
    LetGoDice dice_;
    Box box_;
    Vec3 at_, to_;
    double speed_ = 0.1;
    int rest_ = 0;
};

// A device that is never read: the loop repeats the samples it is handed.
class Unread final : public devices::HapticDevice {
public:
    Unread() {
        description_ = devices::SimulatedOmni(*devices::SimulatedHand::create({{0.0, Vec3(0.0)}})).description();
        description_.workspace_m = Vec3(1.0);
    }
    [[nodiscard]] const devices::DeviceDescription& description() const noexcept override { return description_; }
    [[nodiscard]] devices::DeviceSample read() noexcept override { return {}; }
    void write(const devices::DeviceWrench&) noexcept override {}

private:
    devices::DeviceDescription description_;
};

struct LetGoFigures {
    std::uint64_t ticks = 0, contacts = 0, looks_free = 0, sound = 0, violations = 0, let_go = 0, held_over = 0;
    std::string worst;
};

std::uint64_t number_in(const char* name, std::uint64_t otherwise) {
    const char* text = std::getenv(name);
    return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

class LetGoRun {
public:
    LetGoRun(const LetGoScene& scene, std::size_t parts, double radius_m, double budget_us, double friction,
             std::uint64_t seed, const toolbox::FeltTool& tool = {})
        : scene_(scene), radius_m_(radius_m), shape_(tool.shape), devices_(parts), channels_(parts) {
        std::vector<LoopPart> all;
        for (std::size_t i = 0; i < parts; ++i) {
            channels_[i] = std::make_unique<HapticChannels>(64, 64);
            all.push_back({devices_[i], *channels_[i]});
            hands_.emplace_back(scene.now->box(), seed + i);
        }
        loop_ = std::make_unique<HapticLoop>(all, clock_);
        held_.assign(parts, 0);
        parameters_.sequence = 1;
        parameters_.probe = ball_probe(radius_m);
        if (shape_.touches())
            parameters_.probe = tool.probe, parameters_.shape = shape_, parameters_.tool = tool.surface;
        parameters_.clearance_ratio = 0.0;
        parameters_.max_surface_age_s = 0.0;
        parameters_.work.pace = 1e6 / 3.0 / (1e3 * budget_us);
        for (TouchMaterial& m : parameters_.materials) m.static_friction = m.dynamic_friction = friction;
        off_ = parameters_;
        off_.enabled = false;
    }

    void go(int turns, LetGoFigures& figures) {
        for (int turn = 0; turn < turns; ++turn) {
            now_ns_ += 1'000'000;
            if (turn % 700 == 699) ++sequence_;  // undo and fill
            const bool thick = sequence_ % 2 == 0;
            const Touchable& solid = thick ? *scene_.thicker : *scene_.now;
            if (surface_.sequence != sequence_) surface_ = solid.surface(sequence_);
            std::vector<PartInput> inputs;
            for (Hand& hand : hands_) {
                const bool set = hand.dice().one_in(500);
                if (set) hand.set_elsewhere(solid.mesh());
                PartInput input;
                input.sample.time_ns = now_ns_;
                input.sample.position_device_m = hand.move();
                input.surface = &surface_;
                input.parameters = set ? &off_ : &parameters_;
                inputs.push_back(input);
            }
            loop_->repeat(inputs, now_ns_, 0);
            for (std::size_t i = 0; i < hands_.size(); ++i) judge(i, solid, turn, figures);
        }
    }

private:
    void judge(std::size_t part, const Touchable& solid, int turn, LetGoFigures& figures) {
        TickRecord record;
        ASSERT_TRUE(channels_[part]->records.pop(record));
        for (TickRecord s; channels_[part]->ticks.pop(s);) continue;
        ++figures.ticks;
        figures.contacts += record.in_contact() ? 1 : 0;
        figures.let_go += (record.flags & kTickLetGo) != 0 ? 1 : 0;
        figures.held_over += record.turn.held_over ? 1 : 0;
        const Vec3 hand = record.deepest().hip_object_m, proxy = record.deepest().proxy_object_m;
        const bool is_held = record.in_contact() || glm::length(record.gate.given.force_device_N) > 1e-3;
        if (!is_held || !is_free(solid, hand, held_[part])) {
            held_[part] = 0;
            return;
        }
        // Looked at now and then, for it takes long; a hand that was not free in between is not held.
        if (++held_[part] % kTicksBetweenLooks != 0) return;
        ++figures.looks_free;
        if (!solid.is_outside(hand) || is_sound(solid, proxy, hand)) {
            figures.sound += 1;
            held_[part] = 0;
            return;
        }
        if (held_[part] < kTicksToLetGo) return;
        ++figures.violations;
        held_[part] = 0;
        figures.worst = scene_.name + ", ball " + std::to_string(1e3 * radius_m_) + " mm, part " +
                        std::to_string(part) + ", turn " + std::to_string(turn) + ", force " +
                        std::to_string(glm::length(record.gate.given.force_device_N)) + " N, flags " +
                        std::to_string(record.flags) + ", hand " + std::to_string(1e3 * solid.distance_m(hand)) +
                        " mm off, proxy " + std::to_string(1e3 * solid.distance_m(proxy)) + " mm, apart " +
                        std::to_string(1e3 * glm::length(proxy - hand)) + " mm";
        if (shape_.touches()) figures.worst += ", with a shape";
    }

    [[nodiscard]] bool is_free(const Touchable& solid, const Vec3& hand, int held) const {
        // A ball around the tool, which is held upright.
        if (shape_.touches())
            return (held + 1) % kTicksBetweenLooks != 0 || solid.distance_m(hand) > 1.05 * shape_.reach_m;
        return (held + 1) % kTicksBetweenLooks != 0 || solid.distance_m(hand) > 1.05 * radius_m_;
    }
    [[nodiscard]] bool is_sound(const Touchable& solid, const Vec3& proxy, const Vec3& hand) const {
        if (shape_.touches()) return stands_between(solid, proxy, hand);
        const double distance_m = solid.distance_m(proxy);
        return distance_m > 0.75 * radius_m_ && distance_m < 1.2 * radius_m_ &&
               !solid.is_way_clear(proxy, hand, 0.95 * radius_m_);
    }

    // Whether the tool meets the mesh somewhere on its straight way from the proxy to the hand.
    [[nodiscard]] bool stands_between(const Touchable& solid, const Vec3& proxy, const Vec3& hand) const {
        const int parts = 1 + static_cast<int>(glm::length(hand - proxy) / (0.1 * shape_.size_m));
        for (int i = 0; i <= parts; ++i) {
            const Vec3 at = proxy + (static_cast<double>(i) / parts) * (hand - proxy);
            if (solid.distance_m(at) > shape_.reach_m) continue;
            for (const auto& t : solid.mesh().triangles)
                if (is_met(at, {solid.mesh().positions_m[t[0]], solid.mesh().positions_m[t[1]],
                                solid.mesh().positions_m[t[2]]}))
                    return true;
        }
        return false;
    }
    [[nodiscard]] bool is_met(const Vec3& at, const geometry::Triangle& t) const {
        const Vec3 lo = glm::min(glm::min(t.a, t.b), t.c) - at, hi = glm::max(glm::max(t.a, t.b), t.c) - at;
        const Vec3 off = glm::max(glm::max(lo - shape_.bounds.hi, shape_.bounds.lo - hi), Vec3(0.0));
        if (off != Vec3(0.0)) return false;
        for (std::uint32_t i = 0; i < shape_.piece_count; ++i) {
            const Separation s = separation(shape_, shape_.pieces[i], t, {at, at - t.a, HUGE_VAL, 1e-9});
            if (s.overlaps || s.gap_m < 0.95 * shape_.rounding_m) return true;
        }
        return false;
    }

    const LetGoScene& scene_;
    double radius_m_;
    ToolShape shape_;
    std::vector<Unread> devices_;
    std::vector<std::unique_ptr<HapticChannels>> channels_;
    std::vector<Hand> hands_;
    SimulatedClock clock_;
    std::unique_ptr<HapticLoop> loop_;
    TickParameters parameters_, off_;
    geometry::LocalSurface surface_;
    std::vector<int> held_;
    std::uint64_t sequence_ = 1;
    Nanoseconds now_ns_ = 1'000'000'000;
};

LetGoScene scene_of(std::string name, const geometry::TriangleMesh& mesh) {
    return {std::move(name), std::make_unique<Touchable>(mesh), std::make_unique<Touchable>(thickened(mesh, 0.0015))};
}

// Moved to the origin and scaled to 100 mm.
geometry::TriangleMesh fitted(geometry::TriangleMesh mesh) {
    Box box;
    for (const Vec3& p : mesh.positions_m) box.include(p);
    const double scale = 0.1 / std::max({box.extent().x, box.extent().y, box.extent().z});
    for (Vec3& p : mesh.positions_m) p = scale * (p - box.center());
    return mesh;
}

std::vector<LetGoScene> scenes() {
    std::vector<LetGoScene> all;
    all.push_back(scene_of("rough ball", bench::rough_ball(20'000)));
    all.push_back(scene_of("file", bench::file_plate()));
    all.push_back(scene_of("machined part", bench::machined_part()));
    all.push_back(scene_of("needles", bench::needle_comb(20)));
    all.push_back(scene_of("bumpy sphere", bench::mesh_of(bench::BumpySphere{}, 60)));
    if (const char* folder = std::getenv("BURIN_TOUCH_MODELS")) {
        for (const auto& file : std::filesystem::directory_iterator(folder)) {
            auto mesh = geometry::import_mesh(file.path(), LengthUnit::m);
            if (mesh) all.push_back(scene_of(file.path().filename().string(), fitted(std::move(mesh->mesh))));
        }
    }
    return all;
}

}  // namespace

TEST(LetGo, AHandInFreeAirIsNotHeld) {
    const std::uint64_t ticks = number_in("BURIN_SOAK_OPERATIONS", 60'000), seed = number_in("BURIN_TEST_SEED", 1);
    const std::vector<LetGoScene> all = scenes();
    LetGoFigures sum;
    std::uint64_t run = 42, let_go_at_ease = 0;  // begins with hard ones
    LetGoDice dice(seed);
    while (sum.ticks < ticks) {
        const LetGoScene& scene = all[run % all.size()];
        const std::size_t parts = std::array<std::size_t, 4>{1, 5, 1, 20}[run % 4];
        const double radius_m = std::array{0.002, 0.004, 0.001, 0.0}[(run / 2) % 4];
        const double budget_us = std::array{333.0, 67.0, 17.0, 10.0}[(run / 3) % 4];
        LetGoFigures figures;
        LetGoRun(scene, parts, radius_m > 0.0 ? radius_m : 5e-4, budget_us, dice.one_in(2) ? 0.4 : 0.0,
                 seed + 100 * run)
            .go(parts == 1 ? 4000 : 600, figures);
        if (figures.violations > 0)
            ADD_FAILURE() << "run " << run << ", " << parts << " parts, " << budget_us << " us: " << figures.violations
                          << " times; " << figures.worst;
        sum.ticks += figures.ticks, sum.contacts += figures.contacts, sum.violations += figures.violations;
        sum.looks_free += figures.looks_free, sum.sound += figures.sound, sum.let_go += figures.let_go;
        sum.held_over += figures.held_over;
        if (parts == 1 && budget_us > 300.0) let_go_at_ease += figures.let_go;
        ++run;
    }
    std::cout << sum.ticks << " ticks, " << sum.contacts << " in contact, " << sum.held_over
              << " held over; held in free air at " << sum.looks_free << " looks, soundly at " << sum.sound
              << "; let go by the watch " << sum.let_go << " times, " << let_go_at_ease
              << " of them of one part with 333 us; " << sum.violations << " violations\n";
    EXPECT_GT(sum.contacts, ticks / 20);
    EXPECT_GT(sum.looks_free, 0u);
}

// The same for tools that touch with their shape, so many ticks of each. The way to the hand is looked at with the
// shape itself, triangle by triangle.
TEST(LetGo, AHandInFreeAirIsNotHeldByAShape) {
    const std::uint64_t ticks = number_in("BURIN_SOAK_OPERATIONS", 12'000), seed = number_in("BURIN_TEST_SEED", 1);
    const std::vector<LetGoScene> all = scenes();
    const std::vector<std::pair<const char*, compute::ToolShape>> tools{
        {"mill", compute::CylinderTool{0.001, 0.006}},
        {"cone", compute::ConeTool{0.0005, 0.002, 0.006}},
        {"bull-nose", compute::BullNoseTool{0.0015, 0.0005, 0.006}},
        {"box", compute::BoxTool{{0.002, 0.0015, 0.0025}}},
        {"mesh", compute::MeshTool{std::make_shared<geometry::TriangleMesh>(test::six_sided_bar(0.0015, 0.005))}}};
    for (const auto& [name, shape] : tools) {
        const toolbox::FeltTool felt = toolbox::felt_tool(shape);
        LetGoFigures sum;
        for (std::uint64_t run = 0; sum.ticks < ticks; ++run) {
            const double budget_us = std::array{333.0, 100.0, 33.0}[run % 3];
            LetGoFigures figures;
            LetGoRun(all[run % all.size()], 1, 0.0, budget_us, run % 2 == 0 ? 0.0 : 0.4, seed + 100 * run, felt)
                .go(1000, figures);
            if (figures.violations > 0)
                ADD_FAILURE() << name << ", run " << run << ", " << budget_us << " us: " << figures.violations
                              << " times; " << figures.worst;
            sum.ticks += figures.ticks, sum.contacts += figures.contacts, sum.violations += figures.violations;
            sum.looks_free += figures.looks_free, sum.sound += figures.sound, sum.let_go += figures.let_go;
        }
        std::cout << name << ": " << sum.ticks << " ticks, " << sum.contacts << " in contact; held in free air at "
                  << sum.looks_free << " looks, soundly at " << sum.sound << "; let go by the watch " << sum.let_go
                  << " times; " << sum.violations << " violations\n";
        EXPECT_GT(sum.contacts, sum.ticks / 50) << name;
    }
}

}  // namespace burin::haptics
