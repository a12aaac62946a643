// SPDX-License-Identifier: MIT
// The emulated library of a Quanser wand's maker: the functions of the HIL API that Burin calls
// (devices/drivers/hil_api.hpp), around an emulated wand that runs in a process of its own
// (devices/emulators/emulated_wand.hpp). A session loads it in place of libhil.so, so that the driver at work is the
// real one. A card that is not there, another's, or gone returns an error, as does each of its functions then.
// The watchdog is that of a Q8 card as the comments of hil.h describe it, and in doubt the stricter way: volts go to
// zero only if all lines that are outputs are told to go tristate as well, either alone is refused when it is started,
// once it has expired nothing is read or written until it is cleared, and clearing it brings the volts back.
//
// State is static, as the interface is of C. What a test changes is told when it is compiled: BURIN_EMULATED_HIL_MAJOR,
// and BURIN_EMULATED_HIL_LACKS, which leaves a function out.
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "devices/drivers/hil_api.hpp"
#include "devices/presence/hil_shared.hpp"

#ifndef BURIN_EMULATED_HIL_MAJOR
#define BURIN_EMULATED_HIL_MAJOR 2
#endif

namespace burin::devices {
namespace {

// Numbers of this library's own; the maker's are not needed.
constexpr HilError kNoCard = -1001, kInUse = -1002, kGone = -1003, kBadChannel = -1004, kExpired = -1005,
                   kOneAlone = -1006, kNoSuchState = -1007, kTooMany = -1008;
constexpr std::size_t kMostCards = 4;
constexpr std::array<std::uint32_t, 6> kEnableLines{0, 1, 2, 3, 16, 17};

struct Card {
    HilSharedMemory memory;
    double watchdog_s = 0.0;
    std::set<std::uint32_t> outputs{}, go_tristate{}, go_to_zero{};  // digital lines; the last, analog channels
};

struct Library {
    std::mutex mutex;
    std::array<std::optional<Card>, kMostCards> cards;
    MonotonicClock clock;
};

Library& library() {
    static Library one;
    return one;
}

// Calls what is to be done with a card that is there, and gives the error of one that is not.
template <typename Does>
HilError with_card(HilCard handle, Does does) {
    const std::lock_guard lock(library().mutex);
    const auto at = reinterpret_cast<std::uintptr_t>(handle) - 1;
    if (at >= kMostCards || !library().cards[at]) return kNoCard;
    Card& card = *library().cards[at];
    if (!card.memory->is_alive(library().clock.now_ns())) return kGone;
    if (const std::int32_t error = card.memory->error) return error;
    return does(card);
}

bool is_expired(const Card& card) { return card.memory->has_expired(library().clock.now_ns()); }

// Calls what is to be done with a card that gives access to its hardware.
template <typename Does>
HilError with_open_card(HilCard handle, Does does) {
    return with_card(handle, [&](Card& card) { return is_expired(card) ? kExpired : does(card); });
}

void start_watchdog(Card& card) { card.memory->watchdog_ns = library().clock.now_ns() + nanoseconds(card.watchdog_s); }

}  // namespace
}  // namespace burin::devices

using namespace burin::devices;  // NOLINT: the functions below are C's, outside of every namespace

extern "C" {

HilError hil_get_version(HilVersion* version) {
    *version = {sizeof(HilVersion), BURIN_EMULATED_HIL_MAJOR, 4, 0, 0};
    return 0;
}

HilError hil_open(const char* /*type*/, const char* identifier, HilCard* card) {
    const std::lock_guard lock(library().mutex);
    auto memory = HilSharedMemory::open(identifier != nullptr ? identifier : "");
    if (!memory) return kNoCard;
    if (!(*memory)->is_alive(library().clock.now_ns())) return kGone;
    if (const std::int32_t error = (*memory)->error) return error;
    for (std::size_t i = 0; i < kMostCards; ++i) {
        if (library().cards[i]) continue;
        // It is another's as long as that process lives.
        if (!take_ownership((*memory)->owner)) return kInUse;
        (*memory)->opener = static_cast<std::uint32_t>(::getpid());
        library().cards[i].emplace(Card{std::move(*memory)});
        *card = reinterpret_cast<HilCard>(i + 1);
        return 0;
    }
    return kTooMany;
}

HilError hil_close(HilCard handle) {
    const std::lock_guard lock(library().mutex);
    const auto at = reinterpret_cast<std::uintptr_t>(handle) - 1;
    if (at >= kMostCards || !library().cards[at]) return kNoCard;
    library().cards[at]->memory->owner = 0;
    library().cards[at].reset();
    return 0;
}

HilError hil_set_encoder_counts(HilCard handle, const std::uint32_t* channels, std::uint32_t count,
                                const std::int32_t* to) {
    return with_open_card(handle, [&](Card& card) {
        const auto raw = card.memory->encoder_counts.read();
        auto zero = card.memory->zero_counts.read();
        if (!raw || !zero) return kGone;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (channels[i] >= raw->size()) return kBadChannel;
            (*zero)[channels[i]] = (*raw)[channels[i]] - to[i];
        }
        card.memory->zero_counts.write(*zero);
        card.memory->setter = static_cast<std::uint32_t>(::getpid());
        return HilError{0};
    });
}

HilError hil_set_digital_directions(HilCard handle, const std::uint32_t* inputs, std::uint32_t input_count,
                                    const std::uint32_t* outputs, std::uint32_t count) {
    return with_open_card(handle, [&](Card& card) {
        for (std::uint32_t i = 0; i < input_count; ++i) card.outputs.erase(inputs[i]);
        card.outputs.insert(outputs, outputs + count);
        return HilError{0};
    });
}

HilError hil_read_encoder(HilCard handle, const std::uint32_t* channels, std::uint32_t count, std::int32_t* to) {
    return with_open_card(handle, [&](Card& card) {
        const auto raw = card.memory->encoder_counts.read();
        const auto zero = card.memory->zero_counts.read();
        if (!raw || !zero) return kGone;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (channels[i] >= raw->size()) return kBadChannel;
            to[i] = static_cast<std::int32_t>(std::lround((*raw)[channels[i]] - (*zero)[channels[i]]));
        }
        return HilError{0};
    });
}

HilError hil_write_analog(HilCard handle, const std::uint32_t* channels, std::uint32_t count, const double* volts) {
    // A driver that leaves a card writes to it once more: what reaches a card that is gone reaches no motor either.
    const std::lock_guard lock(library().mutex);
    const auto at = reinterpret_cast<std::uintptr_t>(handle) - 1;
    if (at >= kMostCards || !library().cards[at]) return kNoCard;
    Card& card = *library().cards[at];
    if (is_expired(card)) return kExpired;
    auto all = card.memory->volts.read().value_or(std::array<double, 6>{});
    for (std::uint32_t i = 0; i < count; ++i) {
        if (channels[i] >= all.size()) return kBadChannel;
        all[channels[i]] = volts[i];
    }
    card.memory->volts.write(all);
    if (!card.memory->is_alive(library().clock.now_ns())) return kGone;
    return card.memory->error;
}

HilError hil_write_digital(HilCard handle, const std::uint32_t* channels, std::uint32_t count, const char* states) {
    const std::lock_guard lock(library().mutex);
    const auto at = reinterpret_cast<std::uintptr_t>(handle) - 1;
    if (at >= kMostCards || !library().cards[at]) return kNoCard;
    Card& card = *library().cards[at];
    if (is_expired(card)) return kExpired;
    std::uint32_t enabled = card.memory->enabled;
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t motor = 0; motor < kEnableLines.size(); ++motor)
            if (channels[i] == kEnableLines[motor])
                enabled = states[i] != 0 ? enabled | 1u << motor : enabled & ~(1u << motor);
    card.memory->enabled = enabled;
    return card.memory->is_alive(library().clock.now_ns()) ? HilError{0} : kGone;
}

// A Q8 card has no other states than 0 V and tristate.
HilError hil_watchdog_set_analog_expiration_state(HilCard handle, const std::uint32_t* channels, std::uint32_t count,
                                                  const double* volts) {
    return with_card(handle, [&](Card& card) {
        for (std::uint32_t i = 0; i < count; ++i)
            if (volts[i] != 0.0) return kNoSuchState;
        card.go_to_zero.insert(channels, channels + count);
        return HilError{0};
    });
}

HilError hil_watchdog_set_digital_expiration_state(HilCard handle, const std::uint32_t* lines, std::uint32_t count,
                                                   const HilDigitalState* states) {
    return with_card(handle, [&](Card& card) {
        constexpr HilDigitalState kGoesTristate = 2;  // t_digital_state: low, high, tristate, no change
        for (std::uint32_t i = 0; i < count; ++i)
            if (states[i] != kGoesTristate) return kNoSuchState;
        card.go_tristate.insert(lines, lines + count);
        return HilError{0};
    });
}

HilError hil_watchdog_start(HilCard handle, double timeout_s) {
    return with_card(handle, [&](Card& card) {
        if (is_expired(card)) return kExpired;
        if (card.go_to_zero.empty() != card.go_tristate.empty()) return kOneAlone;
        card.memory->takes_off = !card.go_to_zero.empty() && std::ranges::includes(card.go_tristate, card.outputs);
        card.watchdog_s = timeout_s;
        start_watchdog(card);
        return HilError{0};
    });
}

HilError hil_watchdog_reload(HilCard handle) {
    return with_card(handle, [](Card& card) {
        if (is_expired(card)) return HilError{0};
        start_watchdog(card);
        return HilError{1};
    });
}

HilError hil_watchdog_clear(HilCard handle) {
    return with_card(handle, [](Card& card) {
        card.memory->watchdog_ns = 0;
        return HilError{0};
    });
}

#ifndef BURIN_EMULATED_HIL_LACKS
HilError hil_watchdog_stop(HilCard handle) {
    return with_card(handle, [](Card& card) {
        if (!is_expired(card)) card.memory->watchdog_ns = 0;
        return HilError{0};
    });
}
#endif

HilError msg_get_error_messageA(const char* /*locale*/, HilError error, char* to, std::size_t size) {
    const char* text = "an error";
    if (error == kNoCard) text = "there is no such card";
    if (error == kInUse) text = "the card is in use";
    if (error == kGone) text = "the card does not answer";
    if (error == kExpired) text = "the watchdog has expired";
    if (error == kOneAlone) text = "analog and digital expiration states go together";
    if (error == kTooMany) text = "this program has four cards open already";
    if (error == kNoSuchState) text = "the card has no such expiration state";
    std::snprintf(to, size, "%s", text);
    return 0;
}

}  // extern "C"
