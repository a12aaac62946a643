// SPDX-License-Identifier: MIT
// The one history of all parts: whose step is undone next, whatever the parts do meanwhile.
#include "document/history.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace burin::document {
namespace {

using scene::PartSteps, scene::StepWay;

constexpr std::uint32_t kCarved = 0, kObjects = 1, kSoft = 2;

// A part that keeps nothing but the numbers of its steps, and carries out orders when it is asked to.
struct Part {
    std::uint32_t number = 0;
    PartSteps steps = {};

    void make() {
        steps.last = ++steps.done;
        ++steps.made;
    }
    void go(StepWay way) {
        if (way == StepWay::back && steps.done >= steps.first) --steps.done;
        if (way == StepWay::forward && steps.done < steps.last) ++steps.done;
        if (way == StepWay::forget) steps.last = steps.done;
        if (way != StepWay::forget) ++steps.walked;
    }
};

std::vector<StepName> names(const History& history) { return {history.steps().begin(), history.steps().end()}; }

}  // namespace

TEST(History, UndoesTheStepsOfAllPartsInTheOrderInWhichTheyWereMade) {
    Part carved{kCarved}, objects{kObjects}, soft{kSoft};
    History history;
    const auto make = [&](Part& part) {
        part.make();
        history.follow(part.number, part.steps);
    };
    for (Part* part : {&carved, &objects, &carved, &soft, &carved}) make(*part);
    std::vector<std::uint32_t> undone;
    while (const auto step = history.back()) {
        undone.push_back(step->part);
        history.ordered(step->part, StepWay::back);
    }
    EXPECT_EQ(undone, (std::vector<std::uint32_t>{kCarved, kSoft, kCarved, kObjects, kCarved}));
    std::vector<std::uint32_t> redone;
    while (const auto step = history.forward()) {
        redone.push_back(step->part);
        history.ordered(step->part, StepWay::forward);
    }
    EXPECT_EQ(redone, (std::vector<std::uint32_t>{kCarved, kObjects, kCarved, kSoft, kCarved}));
}

// Three quick undos: the second and third are given before the first is known to be done.
TEST(History, DoesNotTakeBackTwiceWhatAnOrderUnderWayTakesBack) {
    Part carved{kCarved}, objects{kObjects};
    History history;
    const auto make = [&](Part& part) {
        part.make();
        history.follow(part.number, part.steps);
    };
    for (Part* part : {&carved, &objects, &carved, &carved}) make(*part);
    std::vector<std::uint32_t> undone;
    for (int i = 0; i < 3; ++i) {
        undone.push_back(history.back()->part);
        history.ordered(undone.back(), StepWay::back);
        history.follow(kCarved, carved.steps);  // news of before
    }
    EXPECT_EQ(undone, (std::vector<std::uint32_t>{kCarved, kCarved, kObjects}));
}

TEST(History, TakesBackAStrokeThatNobodyKnewOfAndCanRepeatIt) {
    Part carved{kCarved};
    History history;
    carved.make();
    history.follow(kCarved, carved.steps);
    history.ordered(kCarved, StepWay::back);  // of the first, as far as is known
    carved.make();                            // meanwhile
    carved.go(StepWay::back);
    history.follow(kCarved, carved.steps);
    EXPECT_EQ(history.back(), (StepName{kCarved, 1}));
    EXPECT_EQ(history.forward(), (StepName{kCarved, 2}));
}

TEST(History, EndsWhatCouldBeRepeatedInEveryPart) {
    Part carved{kCarved}, objects{kObjects};
    History history;
    const auto make = [&](Part& part) {
        part.make();
        history.follow(part.number, part.steps);
    };
    for (Part* part : {&objects, &carved}) make(*part);
    history.ordered(kCarved, StepWay::back);
    carved.go(StepWay::back);
    history.follow(kCarved, carved.steps);
    make(objects);
    EXPECT_FALSE(history.forward());
    EXPECT_TRUE(history.take_forgotten(kCarved));
    EXPECT_FALSE(history.take_forgotten(kCarved)) << "it was told";
    EXPECT_TRUE(history.take_forgotten().empty()) << "who made the step knows";
    history.follow(kCarved, carved.steps);  // it has not forgotten yet
    EXPECT_FALSE(history.forward());
    carved.go(StepWay::forget);
    carved.make();
    history.follow(kCarved, carved.steps);
    EXPECT_EQ(names(history), (std::vector<StepName>{{kObjects, 1}, {kObjects, 2}, {kCarved, 1}}));
}

TEST(History, NamesNoStepThatAPartHasDropped) {
    History history;
    history.follow(kCarved, {.first = 1, .done = 3, .last = 3, .made = 3});
    history.follow(kObjects, {.first = 1, .done = 1, .last = 1, .made = 1});
    history.follow(kCarved, {.first = 3, .done = 4, .last = 4, .made = 4});
    EXPECT_EQ(names(history), (std::vector<StepName>{{kCarved, 3}, {kObjects, 1}, {kCarved, 4}}));
}

TEST(History, OfADocumentWithoutOneHasStrokesFirst) {
    History history;
    history.adopt(kCarved, {.first = -2, .done = 1, .last = 2, .made = 7});
    history.adopt(kObjects, {});
    ASSERT_EQ(history.steps().size(), 5u);
    EXPECT_EQ(history.done(), 4u);
    EXPECT_EQ(history.forward(), (StepName{kCarved, 2}));
    EXPECT_TRUE(history.leads_forward(kCarved));
    EXPECT_FALSE(history.leads_forward(kObjects));
}

TEST(History, RefusesBytesThatAreNoneOfIts) {
    History history;
    history.adopt(kCarved, {.first = 1, .done = 3, .last = 4});
    const std::vector<std::byte> good = history.bytes();
    ASSERT_TRUE(History::from(good));
    EXPECT_FALSE(History::from({}));
    EXPECT_FALSE(History::from(std::span(good).first(good.size() - 1)));
    const auto with = [&](std::size_t at, int value) {
        std::vector<std::byte> bad = good;
        bad[at] = std::byte(value);
        return History::from(bad);
    };
    EXPECT_FALSE(with(0, 5)) << "more lead back than there are";
    EXPECT_FALSE(with(11, 255)) << "it claims billions";
    EXPECT_FALSE(with(8, 0)) << "an empty run";
    EXPECT_FALSE(with(19, 127)) << "a number out of all bounds";
    std::vector<std::byte> twice = good;
    twice.insert(twice.end(), good.begin() + 4, good.end());
    EXPECT_FALSE(History::from(twice)) << "the same steps once more";
}

// Parts make steps, go and are saved in any order; what each is asked for is then always its own newest.
RC_GTEST_PROP(History, AsksEachPartForItsOwnNewestStepAndComesBackFromItsBytes, ()) {
    std::vector<Part> parts{{kCarved, {}}, {kObjects, {}}, {kSoft, {}}};
    History history;
    const auto moves = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 6));
    for (const int move : moves) {
        if (move < 3) {
            Part& part = parts[static_cast<std::size_t>(move)];
            part.make();
            history.follow(part.number, part.steps);
            for (const std::uint32_t other : history.take_forgotten()) parts[other].go(StepWay::forget);
        } else if (move < 5) {
            const StepWay way = move == 3 ? StepWay::back : StepWay::forward;
            const auto step = way == StepWay::back ? history.back() : history.forward();
            if (!step) continue;
            Part& part = parts[step->part];
            RC_ASSERT(step->number == (way == StepWay::back ? part.steps.done : part.steps.done + 1));
            history.ordered(part.number, way);
            part.go(way);
            history.follow(part.number, part.steps);
        } else {
            std::optional<History> again = History::from(history.bytes());
            RC_ASSERT(again.has_value());
            for (const Part& part : parts) again->adopt(part.number, part.steps);
            RC_ASSERT(*again == history);
            history = std::move(*again);
        }
    }
}

}  // namespace burin::document
