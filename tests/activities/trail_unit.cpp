// SPDX-License-Identifier: MIT
// The activity that is there to be copied, fed with ticks by hand. One of yours wants the same tests.
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "picture/picture.hpp"
#include "tests/activities/one_hand.hpp"
#include "tests/activities/trail.hpp"

namespace burin::activities {
namespace {

// Draws along +X at 1 mm a tick, with the button down or not, and returns what the activity has ordered.
session::ActivityOrders drawn_along(Trail& trail, OneHand& hand, int from_mm, int to_mm, bool is_down) {
    std::vector<haptics::TickRecord> ticks;
    for (int mm = from_mm; mm <= to_mm; ++mm) {
        haptics::TickRecord tick;
        tick.sample.buttons = is_down ? 1u : 0u;
        tick.contact.points[0].proxy_object_m = {1e-3 * mm, 0.0, 0.0};
        ticks.push_back(tick);
    }
    session::ActivityOrders orders;
    hand.step(trail, ticks, orders);
    return orders;
}

picture::Picture staged(const Trail& trail, const Similarity& world_from_object = {}) {
    picture::Picture scene;
    scene.world_from_object = world_from_object;
    trail.stage(scene, 0);
    return scene;
}

}  // namespace

TEST(Trail, LeavesABeadEverySoFarWhileTheButtonIsDownAndNoneElse) {
    Trail trail(0.0095);
    OneHand hand;
    (void)drawn_along(trail, hand, 0, 100, false);
    EXPECT_TRUE(staged(trail).objects.empty());
    EXPECT_FALSE(trail.panel().buttons().at(0).enabled);
    (void)drawn_along(trail, hand, 0, 40, true);
    EXPECT_EQ(staged(trail).objects.size(), 5u) << "at 0, 10, 20, 30 and 40 mm";
    const Similarity turned{{0.0, 1.0, 0.0}, glm::angleAxis(0.5 * std::numbers::pi, Vec3(0.0, 1.0, 0.0)), 2.0};
    const Vec3 last_world_m = staged(trail, turned).objects.back().world_from_mesh.position_m;
    EXPECT_LT(glm::distance(last_world_m, Vec3(0.0, 1.0, -0.08)), 1e-12) << "the piece is turned and twice as large";
}

TEST(Trail, TheSameTicksInOtherFramesGiveTheSameCheck) {
    Trail at_once(0.004), in_three(0.004), shorter(0.004);
    OneHand hand, other, third;
    (void)drawn_along(at_once, hand, 0, 90, true);
    (void)drawn_along(in_three, other, 0, 17, true);
    (void)drawn_along(in_three, other, 18, 18, true);
    (void)drawn_along(in_three, other, 19, 90, true);
    (void)drawn_along(shorter, third, 0, 80, true);
    EXPECT_EQ(at_once.check(), in_three.check());
    EXPECT_NE(at_once.check(), shorter.check());
}

TEST(Trail, IsClearedByItsActAndRefusesItWhereNothingIsDrawn) {
    Trail trail(0.004);
    OneHand hand;
    session::ActivityOrders orders;
    const std::vector<std::string> words{"clear"};
    ASSERT_TRUE(session::check_act(&trail, words));
    const auto refused = trail.act(words, orders);
    ASSERT_FALSE(refused);
    EXPECT_TRUE(refused.error().line().contains("draw with the button down")) << refused.error().line();
    (void)drawn_along(trail, hand, 0, 40, true);
    ASSERT_TRUE(trail.act(words, orders));
    EXPECT_TRUE(staged(trail).objects.empty());
}

TEST(Trail, LaysBeadsAsFarApartAsItsSliderSaysAndItsActTakes) {
    Trail trail(0.0095);
    OneHand hand;
    session::ActivityOrders orders;
    const auto tell = [&](const std::vector<std::string>& words) -> Result<void> {
        if (auto checked = session::check_act(&trail, words); !checked) return checked;
        return trail.act(words, orders);
    };
    const auto sliders = trail.panel().all<session::ActivityPanel::Slider>();
    ASSERT_EQ(sliders.size(), 1u);
    EXPECT_EQ(sliders[0].value, 0.0095);
    EXPECT_TRUE(tell(session::with_value(sliders[0].act, "0.0195")));
    EXPECT_EQ(trail.panel().all<session::ActivityPanel::Slider>()[0].value, 0.0195);
    (void)drawn_along(trail, hand, 0, 40, true);
    EXPECT_EQ(staged(trail).objects.size(), 3u) << "at 0, 20 and 40 mm";
    for (const char* const wrong : {"nan", "0", "-0.01", "2", "near"}) EXPECT_FALSE(tell({"apart", wrong})) << wrong;
    EXPECT_TRUE(tell({"apart", "near"}).error().line().contains("a number from 0.0001 to 1, in m"));
    EXPECT_EQ(trail.panel().all<session::ActivityPanel::Slider>()[0].value, 0.0195) << "nothing has changed";
    EXPECT_EQ(trail.settings(), Trail(0.0095).settings()) << "a recording begins as it began";
    Trail other(0.0095);
    EXPECT_NE(other.check(), trail.check());
}

TEST(Trail, SaysOnceThatItIsFull) {
    Trail trail(0.0005);
    OneHand hand;
    EXPECT_TRUE(drawn_along(trail, hand, 1, static_cast<int>(Trail::kMostBeads), true).messages.empty());
    EXPECT_EQ(drawn_along(trail, hand, 1, 20, true).messages.size(), 1u);
    EXPECT_TRUE(drawn_along(trail, hand, 21, 40, true).messages.empty());
    EXPECT_EQ(staged(trail).objects.size(), Trail::kMostBeads);
}

TEST(Trail, IsMadeAnewOfItsSettingsAndOfNoOthers) {
    const auto made = Trail::of_settings(Trail(0.1).settings());
    ASSERT_TRUE(made) << made.error().line();
    EXPECT_EQ((*made)->settings(), Trail(0.1).settings());
    for (const char* const other : {"", "trail", "trail --apart -1", "trail --apart 0.1 ", "seek --targets 1 --seed 2"})
        EXPECT_FALSE(Trail::of_settings(other)) << other;
}

}  // namespace burin::activities
