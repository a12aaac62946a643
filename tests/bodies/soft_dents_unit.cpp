// SPDX-License-Identifier: MIT
// Dents of a plastic body are undone and repeated to the bit, and come back from pages.
#include "bodies/soft_dents.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "bodies/soft_part.hpp"

namespace burin::bodies {
namespace {

using scene::StepWay;

constexpr double kLump_m = 0.03;
constexpr Nanoseconds kLumpUpdate_ns = 4'000'000;

SoftPartSetup lump_setup() {
    SoftPartSetup setup;
    setup.spacing_m = kLump_m / 3.2;
    setup.material.young_Pa = 40e3;
    setup.material.yield_Pa = 4e3;
    return setup;
}

// A lump of putty that one point presses.
class Lump {
public:
    Lump() : part_(SoftPart::create(lump_setup()).value()) {}

    void update(double depth_m, const Vec3& from) {
        haptics::TickRecord tick;
        tick.contact.point_count = 1;
        tick.contact.points[0].hip_object_m = (kLump_m - depth_m) * from;
        now_ns_ += kLumpUpdate_ns;
        tick.time_ns = now_ns_;
        part_->take_ticks(0, {&tick, 1});
        ASSERT_TRUE(part_->update(now_ns_, nullptr));
    }
    // Presses it from a side, lets go, and waits until nothing moves any more.
    void dent(const Vec3& from, double deepest_m = 0.008) {
        constexpr int kPresses = 60;
        for (int i = 1; i <= kPresses; ++i) update(deepest_m * i / kPresses, from);
        rest();
    }
    void away(const Vec3& from) {
        constexpr double kFar_m = -0.05;
        update(kFar_m, from);
    }
    void rest() {
        for (int i = 0; i < 1000; ++i) away({0.0, 1.0, 0.0});
    }
    void go(StepWay way) {
        part_->go(way);
        away({0.0, 1.0, 0.0});
    }
    [[nodiscard]] std::vector<Vec3> places() const { return part_->state().places_m; }
    [[nodiscard]] SoftPart& part() { return *part_; }

private:
    std::unique_ptr<SoftPart> part_;
    Nanoseconds now_ns_ = 0;
};

constexpr Vec3 kFromTop{0.0, 1.0, 0.0}, kFromSide{1.0, 0.0, 0.0};

double farthest_m(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double most_m = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) most_m = std::max(most_m, glm::distance(a[i], b[i]));
    return most_m;
}

// What a document's reader gives of each step: its pages numbered 0.
std::vector<scene::Pages> each_of(const scene::Steps& steps) {
    std::vector<scene::Pages> all;
    for (std::int64_t number = steps.first; number <= steps.last; ++number) {
        scene::Pages one;
        for (const auto& [name, bytes] : steps.pages)
            if (name.number == number) one.pages[{name.kind, 0}] = bytes;
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace

TEST(SoftDents, AreUndoneAndRepeatedToTheBit) {
    Lump lump;
    lump.rest();
    const auto fresh = lump.places();
    lump.dent(kFromTop);
    const auto first = lump.places();
    lump.dent(kFromSide);
    const auto second = lump.places();
    ASSERT_GT(farthest_m(fresh, first), 1e-4);
    ASSERT_GT(farthest_m(first, second), 1e-4);
    EXPECT_EQ(lump.part().undo_steps(), (scene::PartSteps{.first = 1, .done = 2, .last = 2, .made = 2}));
    lump.go(StepWay::back);
    EXPECT_TRUE(lump.places() == first);
    lump.go(StepWay::back);
    EXPECT_TRUE(lump.places() == fresh);
    lump.go(StepWay::back);
    EXPECT_TRUE(lump.places() == fresh) << "there is none before";
    EXPECT_EQ(lump.part().undo_steps(), (scene::PartSteps{.first = 1, .done = 0, .last = 2, .made = 2, .walked = 3}));
    lump.go(StepWay::forward);
    lump.go(StepWay::forward);
    EXPECT_TRUE(lump.places() == second);
    lump.rest();
    EXPECT_TRUE(lump.places() == second) << "it stays there";
}

TEST(SoftDents, LeaveNothingBehindWhenTheyAreUndone) {
    Lump lump, other;
    lump.rest();
    other.rest();
    lump.dent(kFromSide);
    lump.go(StepWay::back);
    lump.dent(kFromTop);
    other.dent(kFromTop);
    EXPECT_TRUE(lump.places() == other.places()) << "it is pressed as a new one is";
    EXPECT_EQ(lump.part().undo_steps().last, 1) << "what was taken back is forgotten";
}

TEST(SoftDents, AreTakenBackWhenNobodyWouldBePressedByIt) {
    Lump lump;
    lump.rest();
    const auto fresh = lump.places();
    for (int i = 1; i <= 60; ++i) lump.update(0.008 * i / 60, kFromTop);
    lump.part().go(StepWay::back);
    lump.update(0.008, kFromTop);
    EXPECT_GT(farthest_m(fresh, lump.places()), 1e-4);
    EXPECT_EQ(lump.part().undo_steps().walked, 0u);
    // In the dent and free of it, but within the shape from before.
    for (int i = 0; i < 50; ++i) lump.update(0.001, kFromTop);
    EXPECT_GT(farthest_m(fresh, lump.places()), 1e-4);
    EXPECT_EQ(lump.part().undo_steps().walked, 0u);
    lump.away(kFromTop);
    EXPECT_TRUE(lump.places() == fresh);
    EXPECT_EQ(lump.part().undo_steps(), (scene::PartSteps{.first = 1, .done = 0, .last = 1, .made = 1, .walked = 1}));
}

TEST(SoftDents, OfAnElasticBodyAreNone) {
    SoftPartSetup setup = lump_setup();
    setup.material.yield_Pa = 0.0;
    const auto part = SoftPart::create(setup).value();
    haptics::TickRecord tick;
    tick.contact.point_count = 1;
    tick.contact.points[0].hip_object_m = {0.0, 0.025, 0.0};
    for (int i = 1; i < 20; ++i) {
        part->take_ticks(0, {&tick, 1});
        ASSERT_TRUE(part->update(i * kLumpUpdate_ns, nullptr));
    }
    EXPECT_EQ(part->undo_steps(), scene::PartSteps());
    scene::Pages pages;
    EXPECT_FALSE(part->save(pages));
}

TEST(SoftDents, ComeBackFromPagesWithTheirSteps) {
    Lump lump, opened;
    lump.rest();
    const auto fresh = lump.places();
    lump.dent(kFromTop);
    const auto first = lump.places();
    lump.dent(kFromSide);
    const auto second = lump.places();
    lump.go(StepWay::back);
    scene::Pages pages;
    ASSERT_TRUE(lump.part().save(pages));
    ASSERT_TRUE(pages.steps);
    const auto steps = each_of(*pages.steps);
    ASSERT_EQ(steps.size(), 2u);
    const auto loaded = opened.part().load(pages, *pages.steps, steps, "x.burin");
    ASSERT_TRUE(loaded) << loaded.error().line();
    EXPECT_TRUE(opened.places() == first);
    opened.go(StepWay::forward);
    EXPECT_TRUE(opened.places() == second);
    opened.go(StepWay::back);
    opened.go(StepWay::back);
    EXPECT_TRUE(opened.places() == fresh);
    // A save after that gives the steps that have changed alone, and is the same body.
    scene::Pages later{.whole = false};
    ASSERT_TRUE(opened.part().save(later));
    EXPECT_EQ(later.steps->done, 0);
    EXPECT_EQ(later.steps->last, 2);
}

TEST(SoftDents, OfDamagedPagesOrAnotherBodyAreRefusedAndLeaveTheBodyAsItIs) {
    Lump lump, other;
    lump.rest();
    lump.dent(kFromTop);
    scene::Pages pages;
    ASSERT_TRUE(lump.part().save(pages));
    const auto steps = each_of(*pages.steps);
    const auto before = other.places();
    const auto refuses = [&](scene::Pages bad) {
        const auto loaded = other.part().load(bad, *pages.steps, steps, "x.burin");
        EXPECT_TRUE(other.places() == before);
        return loaded ? std::string() : loaded.error().line();
    };
    scene::Pages bad = pages;
    bad.pages[{"head", 0}][3] ^= std::byte{1};
    EXPECT_TRUE(refuses(bad).contains("another soft body"));
    for (const std::size_t at : {std::size_t{0}, std::size_t{4}}) {
        bad = pages;
        bad.pages[{"shape", 0}][at] ^= std::byte{1};
        EXPECT_TRUE(refuses(bad).contains("damaged")) << at;
    }
    bad = pages;
    bad.pages[{"shape", 0}].pop_back();
    EXPECT_TRUE(refuses(bad).contains("damaged"));
    bad = pages;
    std::fill_n(bad.pages[{"shape", 0}].begin() + 8, 24, std::byte{0xff});  // no number
    EXPECT_TRUE(refuses(bad).contains("damaged"));
}

}  // namespace burin::bodies
