// SPDX-License-Identifier: MIT
#include "devices/trackers/dtrack_protocol.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace burin::devices {
namespace {

// Takes numbers and blocks off a line's front. After the first failure there is nothing more.
class DTrackLine {
public:
    explicit DTrackLine(std::string_view rest) : rest_(rest) {}

    [[nodiscard]] bool is_sound() const { return is_sound_; }
    std::size_t count(std::size_t most) {
        skip_blanks();
        std::size_t value = 0;
        const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (error != std::errc{} || value > most) return is_sound_ = false, 0;
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return value;
    }
    // Takes a block of at least so many numbers; those beyond kept are left out.
    std::vector<double> block(std::size_t least) {
        skip_blanks();
        const std::size_t close = rest_.find(']');
        if (!is_sound_ || !rest_.starts_with('[') || close == std::string_view::npos)
            return is_sound_ = false, std::vector<double>(least);
        std::string_view inside = rest_.substr(1, close - 1);
        rest_.remove_prefix(close + 1);
        std::vector<double> numbers;
        while (numbers.size() < kMostNumbers) {
            inside.remove_prefix(std::min(inside.find_first_not_of(' '), inside.size()));
            double value = 0.0;
            const auto [end, error] = std::from_chars(inside.data(), inside.data() + inside.size(), value);
            if (error != std::errc{}) break;
            numbers.push_back(value);
            inside.remove_prefix(static_cast<std::size_t>(end - inside.data()));
        }
        if (numbers.size() < least) is_sound_ = false;
        numbers.resize(std::max(numbers.size(), least));
        return numbers;
    }

private:
    static constexpr std::size_t kMostNumbers = 16;
    void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size())); }

    std::string_view rest_;
    bool is_sound_ = true;
};

// A whole number that a block gives as any other; 0 where it is none.
std::uint32_t whole(double value) {
    return value >= 0.0 && value <= 4294967295.0 ? static_cast<std::uint32_t>(value) : 0u;
}

DTrackBody body_of(const std::vector<double>& who, const std::vector<double>& place_mm,
                   const std::vector<double>& rotation) {
    DTrackBody body;
    constexpr double kMostNumber = 1e6;
    // What is no number is -1, which no body has.
    body.number = who[0] >= 0.0 && who[0] <= kMostNumber ? static_cast<std::int32_t>(who[0]) : -1;
    body.is_tracked = who[1] >= 0.0;
    body.pose.position_m = 0.001 * Vec3(place_mm[0], place_mm[1], place_mm[2]);
    glm::dmat3 turn;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) turn[column][row] = rotation[static_cast<std::size_t>(3 * column + row)];
    // What is no rotation becomes a quaternion of no length, which nobody takes for one. Columns of length 1 that span
    // the volume 1 are at right angles (Hadamard's inequality).
    bool is_rotation = std::abs(glm::determinant(turn) - 1.0) < 0.01;
    for (int column = 0; column < 3; ++column)
        is_rotation = is_rotation && std::abs(glm::length(turn[column]) - 1.0) < 0.01;
    body.pose.orientation = is_rotation ? glm::normalize(glm::quat_cast(turn)) : Quat(0.0, 0.0, 0.0, 0.0);
    return body;
}

bool read_bodies(DTrackLine line, DTrackFrame& frame) {
    std::vector<DTrackBody> bodies;
    const std::size_t count = line.count(kMostDTrackBodies);
    for (std::size_t i = 0; i < count && line.is_sound(); ++i) {
        const auto who = line.block(2), place = line.block(3), rotation = line.block(9);
        if (line.is_sound()) bodies.push_back(body_of(who, place, rotation));
    }
    if (line.is_sound()) frame.bodies = std::move(bodies);
    return line.is_sound();
}

// Bodies with an inertial sensor, which have numbers of their own.
bool read_hybrids(DTrackLine line, DTrackFrame& frame) {
    std::vector<DTrackBody> bodies;
    const std::size_t count = line.count(kMostDTrackBodies);
    for (std::size_t i = 0; i < count && line.is_sound(); ++i) {
        const auto who = line.block(3), place = line.block(3), rotation = line.block(9);
        if (!line.is_sound()) break;
        DTrackBody body = body_of(who, place, rotation);
        body.is_tracked = who[1] > 0.0;  // its state, in place of a quality
        bodies.push_back(body);
    }
    if (line.is_sound()) frame.hybrids = std::move(bodies);
    return line.is_sound();
}

// The older form: eight buttons, of which the upper four are the stick's directions.
bool read_older_flysticks(DTrackLine line, std::vector<DTrackFlystick>& to) {
    const std::size_t count = line.count(kMostDTrackBodies);
    for (std::size_t i = 0; i < count && line.is_sound(); ++i) {
        const auto who = line.block(3), place = line.block(3), rotation = line.block(9);
        if (!line.is_sound()) break;
        const std::uint32_t bits = whole(who[2]) & 0xffu;
        const auto axis = [&](std::uint32_t back, std::uint32_t forth) {
            return (bits & back) != 0 ? -1.0 : (bits & forth) != 0 ? 1.0 : 0.0;
        };
        to.push_back({body_of(who, place, rotation), 8, bits, {axis(0x20, 0x80), axis(0x10, 0x40)}});
    }
    return line.is_sound();
}

bool read_flysticks(DTrackLine line, std::vector<DTrackFlystick>& to) {
    static_cast<void>(line.count(kMostDTrackBodies));  // how many there could be
    const std::size_t count = line.count(kMostDTrackBodies);
    for (std::size_t i = 0; i < count && line.is_sound(); ++i) {
        const auto who = line.block(4);
        const std::uint32_t buttons = whole(who[2]), sticks = whole(who[3]);
        const auto place = line.block(3), rotation = line.block(9);
        if (!line.is_sound() || buttons > kMostFlystickButtons || sticks > kMostFlystickSticks) return false;
        const std::size_t words = buttons > 0 ? 1 : 0;
        const auto states = line.block(words + sticks);
        if (!line.is_sound()) return false;
        DTrackFlystick stick{body_of(who, place, rotation), buttons, 0, {}};
        const std::uint32_t mask = buttons >= 32 ? ~0u : (1u << buttons) - 1u;
        if (words > 0) stick.buttons = whole(states[0]) & mask;
        stick.sticks.assign(states.begin() + static_cast<std::ptrdiff_t>(words),
                            states.begin() + static_cast<std::ptrdiff_t>(words + sticks));
        to.push_back(std::move(stick));
    }
    return line.is_sound();
}

}  // namespace

DTrackFrame dtrack_frame(std::string_view datagram) {
    DTrackFrame frame;
    std::vector<DTrackFlystick> older, newer;
    bool has_newer = false;
    while (!datagram.empty()) {
        const std::size_t end = datagram.find('\n');
        std::string_view text = datagram.substr(0, end);
        datagram.remove_prefix(end == std::string_view::npos ? datagram.size() : end + 1);
        while (text.ends_with('\r') || text.ends_with('\0')) text.remove_suffix(1);
        const std::string_view word = text.substr(0, text.find(' '));
        DTrackLine line(text.substr(word.size()));
        bool is_read = true;
        if (word == "fr") {
            const std::size_t number = line.count(0xffffffff);
            if ((is_read = line.is_sound())) frame.number = static_cast<std::uint32_t>(number);
        } else if (word == "6d") {
            is_read = read_bodies(line, frame);
        } else if (word == "6di") {
            is_read = read_hybrids(line, frame);
        } else if (word == "6df") {
            is_read = read_older_flysticks(line, older);
        } else if (word == "6df2") {
            has_newer = true;
            is_read = read_flysticks(line, newer);
        }
        if (!is_read && frame.fault.empty()) frame.fault = std::string(word);
    }
    frame.flysticks = has_newer ? std::move(newer) : std::move(older);
    return frame;
}

}  // namespace burin::devices
