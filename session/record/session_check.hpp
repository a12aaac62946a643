// SPDX-License-Identifier: MIT
// Checksums of what a session did, so that a replay can tell whether it does the same: FNV-1a over the bits of what
// ticks felt and gave, and of where frames have things. No protection against intent. One thread at a time.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "base/space.hpp"

namespace burin::haptics {
struct TickRecord;  // haptics/tick_record.hpp
}  // namespace burin::haptics

namespace burin::session {

// FNV-1a of 64 bits (Fowler, Noll, Vo; RFC 9923), a word at a time, its lowest byte first.
class CheckSum {
public:
    explicit CheckSum(std::uint64_t seed = 0) : sum_(14695981039346656037u ^ seed) {}
    void add(std::uint64_t bits) {
        for (int i = 0; i < 64; i += 8) add_byte(static_cast<unsigned char>(bits >> i));
    }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const Vec3& v) {
        for (int i = 0; i < 3; ++i) add(v[i]);
    }
    void add(const Quat& q) {
        for (const double x : {q.w, q.x, q.y, q.z}) add(x);
    }
    void add_bytes(std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) add_byte(static_cast<unsigned char>(byte));
    }
    [[nodiscard]] std::uint64_t sum() const { return sum_; }

private:
    void add_byte(unsigned char byte) { sum_ = (sum_ ^ byte) * 1099511628211u; }
    std::uint64_t sum_;
};

// What a frame's checksum covers of the session's state, as words: a copy that another thread can sum up later.
// Who sees the session fills it (desk/viewer/state_words.hpp).
using StateWords = std::array<std::uint64_t, 34>;

class SessionCheck {
public:
    explicit SessionCheck(std::size_t parts = 1) : parts_(parts) {}
    void tick(std::size_t part, const haptics::TickRecord& record);
    // Returns the checksum of a frame that draws the tools of these ticks, one of each part, and has taken its surface
    // updates. Earlier ticks are not asked for again.
    [[nodiscard]] std::uint64_t frame(std::span<const std::uint64_t> ticks, const StateWords& state);

private:
    struct After {
        std::uint64_t tick = 0, check = 0;
    };
    struct Part {
        std::uint64_t check = 0;
        std::deque<After> ticks;  // not seen by a frame yet, except for the first

        [[nodiscard]] std::uint64_t at(std::uint64_t tick);
    };
    std::vector<Part> parts_;
};

}  // namespace burin::session
