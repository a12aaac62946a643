// SPDX-License-Identifier: MIT
// What a Quanser wand's driver calls of its maker's library, call by call with all arguments, in told time: a card that
// is no library writes each call down, and its watchdog expires when a test says so.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <future>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "devices/drivers/hil_wand.hpp"
#include "tests/devices/told_clock.hpp"

namespace burin::devices {
namespace {

struct HilCall {
    std::string what;
    std::vector<double> numbers;  // channels, then values
    Nanoseconds time_ns = 0;
    bool operator==(const HilCall& other) const { return what == other.what && numbers == other.numbers; }
};

// Counts of encoders of which no wand's can be: tens of degrees of one of its two arms alone.
constexpr std::array<std::int32_t, 6> kContradicting{3'000, -2'100, 4'300, 0, 0, 0};

// A card that the functions below write to.
struct NotedCard {
    std::string identifier = "3";          // as the driver opens it
    Clock* clock = nullptr;                // null: nobody serves it, and no call should come
    std::atomic<HilWand*> wand = nullptr;  // asks for a force after each turn; null: nobody does
    DeviceWrench asks;
    std::vector<HilCall> calls;
    std::vector<int> expires_in_turns;      // of its watchdog
    std::vector<int> contradicts_in_turns;  // in which one encoder reads what the others cannot
    std::string fails_at;                   // a call, which fails in this turn and while the card is gone
    int fails_in = -1, switches_on_in = -1;
    int turn = 0, turns = 0;
    bool notes_its_end = false;  // goes on to write down calls when all turns are over
    std::promise<void> is_over;
    bool is_done = false;
    std::mutex lock;  // of the calls, whatever a driver calls of which thread

    [[nodiscard]] bool fails(const std::string& what) const { return turn == fails_in && what == fails_at; }
    void note(const std::string& what, std::vector<double> numbers = {}) {
        const std::scoped_lock held(lock);
        if (!is_done) calls.push_back({what, std::move(numbers), clock != nullptr ? clock->now_ns() : 0});
    }
};
// Those that there are; one test at a time has any.
std::vector<NotedCard*> noted_cards;

NotedCard& noted(HilCard card) { return *static_cast<NotedCard*>(card); }

template <typename Value>
void note_channels(HilCard card, const std::string& what, const std::uint32_t* channels, std::uint32_t count,
                   const Value* values) {
    std::vector<double> numbers(channels, channels + count);
    for (std::uint32_t i = 0; i < count; ++i) numbers.push_back(static_cast<double>(values[i]));
    noted(card).note(what, std::move(numbers));
}

HilApi noting_api() {
    HilApi api;
    api.open = [](const char* type, const char* identifier, HilCard* card) {
        const auto is_it = [&](const NotedCard* one) { return one->identifier == identifier; };
        const auto found = std::ranges::find_if(noted_cards, is_it);
        if (found == noted_cards.end()) return HilError{-7};
        (*found)->note(std::string("open ") + type + " " + identifier);
        *card = *found;
        return HilError{0};
    };
    api.close = [](HilCard card) { return noted(card).note("close"), HilError{0}; };
    api.set_encoder_counts = [](HilCard card, const std::uint32_t* channels, std::uint32_t count,
                                const std::int32_t* to) {
        return note_channels(card, "counts", channels, count, to), HilError{0};
    };
    api.set_digital_directions = [](HilCard card, const std::uint32_t*, std::uint32_t inputs,
                                    const std::uint32_t* outputs, std::uint32_t count) {
        std::vector<double> numbers{static_cast<double>(inputs)};
        numbers.insert(numbers.end(), outputs, outputs + count);
        return noted(card).note("directions", std::move(numbers)), HilError{0};
    };
    api.read_encoder = [](HilCard card, const std::uint32_t* channels, std::uint32_t count, std::int32_t* to) {
        std::fill_n(to, count, 0);  // it stays in its jig
        if (std::ranges::count(noted(card).contradicts_in_turns, noted(card).turn) > 0)
            std::ranges::copy(kContradicting, to);
        return note_channels(card, "read", channels, count, to), HilError{noted(card).fails("read") ? -7 : 0};
    };
    api.write_analog = [](HilCard card, const std::uint32_t* channels, std::uint32_t count, const double* volts) {
        note_channels(card, "volts", channels, count, volts);
        HilWand* const wand = noted(card).wand.load();
        if (wand == nullptr || noted(card).is_done) return HilError{0};
        // What clearing the watchdog brings back is written over: that is no turn's.
        if (noted(card).calls.size() > 1 && std::prev(noted(card).calls.end(), 2)->what == "clear") return HilError{0};
        const bool fails = noted(card).fails("volts");
        wand->exchange().command(noted(card).asks, noted(card).clock->now_ns());
        if (noted(card).turn == noted(card).switches_on_in) static_cast<void>(wand->switch_amplifiers(true));
        if (++noted(card).turn == noted(card).turns) {
            noted(card).is_done = !noted(card).notes_its_end;
            noted(card).is_over.set_value();
        }
        return HilError{fails ? -7 : 0};
    };
    api.write_digital = [](HilCard card, const std::uint32_t* lines, std::uint32_t count, const char* states) {
        return note_channels(card, "lines", lines, count, states), HilError{0};
    };
    api.watchdog_analog = [](HilCard card, const std::uint32_t* channels, std::uint32_t count, const double* volts) {
        return note_channels(card, "expires to", channels, count, volts), HilError{0};
    };
    api.watchdog_digital = [](HilCard card, const std::uint32_t* lines, std::uint32_t count, const int* states) {
        return note_channels(card, "lines expire to", lines, count, states), HilError{0};
    };
    api.watchdog_start = [](HilCard card, double timeout_s) {
        return noted(card).note("start", {timeout_s}), HilError{0};
    };
    api.watchdog_reload = [](HilCard card) {
        const bool expires =
            std::ranges::count(noted(card).expires_in_turns, noted(card).turn) > 0 && noted(card).wand != nullptr;
        return noted(card).note("reload"), HilError{noted(card).fails("reload") ? -7 : expires ? 0 : 1};
    };
    api.watchdog_clear = [](HilCard card) { return noted(card).note("clear"), HilError{0}; };
    api.watchdog_stop = [](HilCard card) { return noted(card).note("stop"), HilError{0}; };
    return api;
}

WandDescription wand_with_other_lines() {
    WandDescription wand = quanser_wand_of_maker();
    wand.mechanism.card = "q2_usb";
    wand.mechanism.enable_lines = {7, 2, 31, 12, 19, 5};
    return wand;
}

const std::vector<double> kChannelZeros{0, 1, 2, 3, 4, 5, 0, 0, 0, 0, 0, 0};
const std::vector<double> kLinesOff{7, 2, 31, 12, 19, 5, 0, 0, 0, 0, 0, 0};
// By hil.h: low, high, tristate (2), no change.
const std::vector<double> kLinesTristate{7, 2, 31, 12, 19, 5, 2, 2, 2, 2, 2, 2};
const std::vector<double> kLinesOn{7, 2, 31, 12, 19, 5, 1, 1, 1, 1, 1, 1};

// Serves a card that is among the noted ones.
std::unique_ptr<HilWand> serving(NotedCard& card, const WandDescription& description, std::unique_ptr<Clock> clock) {
    card.clock = clock.get();
    auto wand = HilWand::serve_card(noting_api(), card.identifier, description, std::move(clock),
                                    [&card](HilWand& opened) { card.wand = &opened; });
    EXPECT_TRUE(wand) << wand.error().line();
    return wand ? std::move(*wand) : nullptr;
}

// Serves the one card that there is for so many turns, and ends.
void serve_noted(NotedCard& card, int turns) {
    card.turns = turns;
    card.asks = {Vec3(0.4, -0.7, 1.1), Vec3(0.05, 0.0, -0.09)};
    noted_cards = {&card};
    const auto wand = serving(card, wand_with_other_lines(), std::make_unique<ToldClock>());
    ASSERT_TRUE(wand);
    EXPECT_EQ(card.is_over.get_future().wait_for(std::chrono::seconds(30)), std::future_status::ready);
}

// Two wands, each with lines of its own, that are asked for a wrench each in every turn.
class TwoWands {
public:
    // Only those that are named are served; each fails in this turn, if any, and stays away.
    explicit TwoWands(std::initializer_list<std::size_t> served, int fails_in = -1) {
        cards_[0].asks = {Vec3(0.4, -0.7, 1.1), Vec3(0.05, 0.0, -0.09)};
        cards_[1].asks = {Vec3(-0.6, 0.3, 0.5), Vec3(-0.03, 0.0, 0.07)};
        cards_[1].identifier = "5";
        noted_cards = {&cards_[0], &cards_[1]};
        for (NotedCard& card : cards_) card.fails_at = "read", card.fails_in = fails_in;
        for (const std::size_t i : served) {
            WandDescription description = wand_with_other_lines();
            if (i == 1) description.mechanism.enable_lines = {1, 9, 4, 28, 16, 23};
            auto clock = std::make_unique<TurnsClock>();
            clocks_[i] = clock.get();
            wands_[i] = serving(cards_[i], description, std::move(clock));
        }
        for (const std::size_t i : served) take_turns(i);
    }
    ~TwoWands() {
        for (const std::size_t i : {0u, 1u})
            if (wands_[i]) close(i);
    }
    TwoWands(const TwoWands&) = delete;
    TwoWands& operator=(const TwoWands&) = delete;
    // More than it takes until there is force.
    void take_turns(std::size_t i) { clocks_[i]->take_turns(400); }
    void close(std::size_t i) {
        clocks_[i]->let_go();
        wands_[i].reset();
        cards_[i].wand = nullptr;
    }
    [[nodiscard]] const std::vector<HilCall>& calls(std::size_t i) const { return cards_[i].calls; }
    // The newest state that the haptic thread reads of a wand.
    [[nodiscard]] ServedState told(std::size_t i) { return wands_[i]->exchange().newest(); }

private:
    std::array<NotedCard, 2> cards_;
    std::array<TurnsClock*, 2> clocks_{};
    std::array<std::unique_ptr<HilWand>, 2> wands_;
};

bool has_volts(const HilCall& call) {
    return call.what == "volts" && !std::equal(call.numbers.begin() + 6, call.numbers.end(), kChannelZeros.begin() + 6);
}

}  // namespace

TEST(HilCalls, BeginWithTheLinesOffZeroVoltsAWatchdogAndCountersAtZero) {
    NotedCard card;
    serve_noted(card, 3);
    const std::vector<HilCall> begins{{"open q2_usb 3", {}, 0},
                                      {"clear", {}, 0},
                                      {"directions", {0, 7, 2, 31, 12, 19, 5}, 0},
                                      {"lines", kLinesOff, 0},
                                      {"volts", kChannelZeros, 0},
                                      {"expires to", kChannelZeros, 0},
                                      {"lines expire to", kLinesTristate, 0},
                                      {"start", {0.05}, 0},
                                      {"counts", kChannelZeros, 0},
                                      // The first turn switches the amplifiers on, and the next ones do not.
                                      {"reload", {}, 0},
                                      {"read", kChannelZeros, 0},
                                      {"lines", kLinesOn, 0},
                                      {"volts", kChannelZeros, 0},
                                      {"reload", {}, 0},
                                      {"read", kChannelZeros, 0},
                                      {"volts", kChannelZeros, 0}};
    ASSERT_GE(card.calls.size(), begins.size());
    for (std::size_t i = 0; i < begins.size(); ++i)
        EXPECT_EQ(card.calls[i], begins[i]) << i << ": " << card.calls[i].what;
}

TEST(HilCalls, AfterTheWatchdogTheLinesAreSetAnewAndNoTurnOfTheHoldTimeHasVoltsEitherTime) {
    NotedCard card;
    card.expires_in_turns = {400, 900};
    serve_noted(card, 1400);
    std::vector<std::size_t> expired;
    for (std::size_t i = 0; i + 1 < card.calls.size(); ++i)
        if (card.calls[i].what == "reload" && card.calls[i + 1].what == "clear") expired.push_back(i);
    ASSERT_EQ(expired.size(), 2u);
    for (const std::size_t at : expired) {
        const std::vector<HilCall> follow{
            {"reload", {}, 0},          {"clear", {}, 0},       {"volts", kChannelZeros, 0}, {"start", {0.05}, 0},
            {"read", kChannelZeros, 0}, {"lines", kLinesOn, 0}, {"volts", kChannelZeros, 0}};
        for (std::size_t i = 0; i < follow.size(); ++i)
            EXPECT_EQ(card.calls[at + i], follow[i]) << i << ": " << card.calls[at + i].what;
        const Nanoseconds expired_ns = card.calls[at].time_ns;
        bool had_before = false, has_again = false;
        for (std::size_t i = 0; i < card.calls.size(); ++i) {
            const Nanoseconds since_ns = card.calls[i].time_ns - expired_ns;
            had_before = had_before || (i < at && since_ns > -5'000'000 && has_volts(card.calls[i]));
            EXPECT_FALSE(i > at && since_ns < kServedErrorHolds_ns && has_volts(card.calls[i])) << since_ns;
            if (i > at && since_ns > kServedErrorHolds_ns + 2'000'000 && since_ns < kServedErrorHolds_ns + 10'000'000)
                has_again = has_again || has_volts(card.calls[i]);
        }
        EXPECT_TRUE(had_before);
        EXPECT_TRUE(has_again);
    }
}

TEST(HilCalls, AWatchdogThatExpiresInTurnAfterTurnGetsItsLinesEachTimeAndNoVolts) {
    NotedCard card;
    for (int turn = 400; turn < 450; ++turn) card.expires_in_turns.push_back(turn);
    serve_noted(card, 600);
    int clears = 0, lines_on = 0;
    Nanoseconds first_ns = 0;
    std::string before;  // the card is cleared when it is opened too, without a reload
    for (const HilCall& call : card.calls) {
        if (call.what == "clear" && before == "reload" && clears++ == 0) first_ns = call.time_ns;
        before = call.what;
        if (clears == 0) continue;
        lines_on += call == HilCall{"lines", kLinesOn, 0} ? 1 : 0;
        EXPECT_FALSE(has_volts(call)) << call.time_ns - first_ns;
    }
    EXPECT_EQ(clears, 50);
    EXPECT_EQ(lines_on, 50);
}

TEST(HilCalls, EncodersThatContradictOneAnotherLeaveNoVoltsInAnyTurnOfTheHoldTimeEitherTime) {
    NotedCard card;
    card.contradicts_in_turns = {400, 900, 1000};
    serve_noted(card, 1500);
    Nanoseconds last_ns = 0;
    int contradicted = 0, had_force = 0;
    bool has_force = false;
    for (const HilCall& call : card.calls) {
        if (call.what == "read" && call.numbers[6] == kContradicting[0]) {
            last_ns = call.time_ns;
            ++contradicted;
            had_force += std::exchange(has_force, false) ? 1 : 0;
        }
        if (!has_volts(call)) continue;
        has_force = true;
        EXPECT_FALSE(last_ns > 0 && call.time_ns - last_ns < kServedErrorHolds_ns) << call.time_ns - last_ns;
    }
    EXPECT_EQ(contradicted, 3);
    EXPECT_EQ(had_force, 2) << "before the first and again before the second; the third is within the hold time";
    EXPECT_TRUE(has_force) << "at the end";
}

TEST(HilCalls, AWandThatIsLostIsToldWhereItWasAndAsItStood) {
    for (const std::size_t own : {0u, 1u}) {
        TwoWands wands({own}, 600);
        const ServedState before = wands.told(own);
        EXPECT_EQ(before.fault, DeviceFault::none);
        for (int time = 0; time < 2; ++time) {
            wands.take_turns(own);
            const ServedState lost = wands.told(own);
            EXPECT_EQ(lost.fault, DeviceFault::disconnected);
            EXPECT_LT(glm::distance(lost.pose_device.position_m, before.pose_device.position_m), 1e-12);
            EXPECT_GT(std::abs(glm::dot(lost.pose_device.orientation, before.pose_device.orientation)), 1.0 - 1e-12);
            EXPECT_EQ(lost.joints, before.joints);
        }
    }
}

// Whatever call fails: the card is left with zero volts and its lines off, is looked for a second later, and one whose
// counters may be new gets neither lines nor volts until somebody switches the amplifiers on.
TEST(HilCalls, ACardThatFailsIsLeftOffAndHasNoVoltsInAnyTurnUntilItIsSwitchedOn) {
    for (const std::string call : {"read", "reload", "volts"})
        for (const int turn : {1, 100, 400, 401}) {
            NotedCard card;
            card.fails_at = call;
            card.fails_in = turn;
            card.switches_on_in = 900;
            serve_noted(card, 1300);
            const auto closed =
                std::ranges::find_if(card.calls, [](const HilCall& one) { return one.what == "close"; });
            ASSERT_NE(closed, card.calls.end()) << call << turn;
            const std::vector<HilCall> leaves{
                {"volts", kChannelZeros, 0}, {"lines", kLinesOff, 0}, {"stop", {}, 0}, {"close", {}, 0}};
            for (std::size_t i = 0; i < leaves.size(); ++i)
                EXPECT_EQ(*(closed - 3 + static_cast<std::ptrdiff_t>(i)), leaves[i]) << call << turn << i;
            const Nanoseconds failed_ns = closed->time_ns;
            Nanoseconds on_ns = 0;
            bool is_open = false, has_volts_again = false;
            for (auto one = closed + 1; one != card.calls.end(); ++one) {
                if (one->what.starts_with("open")) {
                    EXPECT_FALSE(std::exchange(is_open, true)) << "once";
                    EXPECT_GE(one->time_ns - failed_ns, HilWand::kAgain_ns);
                }
                EXPECT_TRUE(is_open) << one->what << " of a card that is not open";
                if (*one == HilCall{"lines", kLinesOn, 0}) {
                    EXPECT_EQ(std::exchange(on_ns, one->time_ns), 0) << "once";
                    EXPECT_EQ((one - 1)->what, "counts") << "where it stands is the jig";
                }
                EXPECT_FALSE(has_volts(*one) && (on_ns == 0 || one->time_ns - on_ns < kServedErrorHolds_ns))
                    << call << turn;
                has_volts_again = has_volts_again || has_volts(*one);
            }
            EXPECT_TRUE(has_volts_again) << call << turn;
        }
}

TEST(HilCalls, EndWithZeroVoltsTheLinesOffAndTheWatchdogStopped) {
    NotedCard card;
    card.notes_its_end = true;
    serve_noted(card, 400);
    const std::vector<HilCall> last{
        {"volts", kChannelZeros, 0}, {"lines", kLinesOff, 0}, {"stop", {}, 0}, {"close", {}, 0}};
    ASSERT_GT(card.calls.size(), last.size());
    const std::size_t begins = card.calls.size() - last.size();
    for (std::size_t i = 0; i < last.size(); ++i) EXPECT_EQ(card.calls[begins + i], last[i]) << i;
    EXPECT_TRUE(std::ranges::any_of(card.calls, has_volts)) << "it pressed until then";
}

// Each card has its own volts and lines while both are served, is left off and closed, and is not called afterwards.
TEST(HilCalls, EachOfTwoCardsHasItsOwnVoltsAndEndsOffWhicheverEndsFirst) {
    const std::array<std::vector<double>, 2> lines_off{kLinesOff, {1, 9, 4, 28, 16, 23, 0, 0, 0, 0, 0, 0}};
    const std::array<std::vector<double>, 2> lines_on{kLinesOn, {1, 9, 4, 28, 16, 23, 1, 1, 1, 1, 1, 1}};
    const auto pressing = [](const std::vector<HilCall>& calls) {
        const auto last = std::find_if(calls.rbegin(), calls.rend(), has_volts);
        return last == calls.rend() ? std::vector<double>{} : last->numbers;
    };
    std::array<std::vector<double>, 2> alone;
    for (const std::size_t i : {0u, 1u}) {
        TwoWands wands{i};
        wands.close(i);
        alone[i] = pressing(wands.calls(i));
        ASSERT_FALSE(alone[i].empty()) << i;
    }
    EXPECT_NE(alone[0], alone[1]);
    for (const std::size_t ends_first : {0u, 1u}) {
        TwoWands wands{0, 1};
        wands.close(ends_first);
        const std::size_t count = wands.calls(ends_first).size();
        wands.take_turns(1 - ends_first);
        wands.close(1 - ends_first);
        EXPECT_EQ(wands.calls(ends_first).size(), count) << "nothing after it is closed";
        for (const std::size_t i : {0u, 1u}) {
            const std::vector<HilCall>& calls = wands.calls(i);
            const std::vector<HilCall> last{
                {"volts", kChannelZeros, 0}, {"lines", lines_off[i], 0}, {"stop", {}, 0}, {"close", {}, 0}};
            ASSERT_GT(calls.size(), last.size());
            EXPECT_EQ(calls.front().what, i == 0 ? "open q2_usb 3" : "open q2_usb 5");
            EXPECT_TRUE(std::equal(last.rbegin(), last.rend(), calls.rbegin())) << i << ends_first;
            EXPECT_EQ(std::ranges::count(calls, last.back()), 1) << i;
            bool presses = false;
            for (const HilCall& call : calls) {
                if (call.what == "lines") {
                    EXPECT_TRUE(call.numbers == lines_off[i] || call.numbers == lines_on[i]) << i;
                }
                if (has_volts(call)) {
                    EXPECT_EQ(call.numbers, alone[i]) << i;
                }
                EXPECT_FALSE(presses && call.what == "volts" && !has_volts(call) && &call < &calls.back() - 3)
                    << i << ": a turn without force while the other ends";
                presses = presses || has_volts(call);
            }
        }
    }
}

}  // namespace burin::devices
