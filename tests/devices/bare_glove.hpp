// SPDX-License-Identifier: MIT
// The far end of a glove's line without a controller: a test writes what a controller would say, and reads what the
// host sends, frame by frame.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "devices/emulators/glove_wire.hpp"
#include "devices/gloves/glove_link.hpp"
#include "tests/devices/told_clock.hpp"

namespace burin::devices {

class BareGlove {
public:
    BareGlove() {
        file_ = ::posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
        std::array<char, 128> name{};
        EXPECT_TRUE(file_ >= 0 && ::grantpt(file_) == 0 && ::unlockpt(file_) == 0 &&
                    ::ptsname_r(file_, name.data(), name.size()) == 0);
        name_ = name.data();
        far_end_ = ::open(name.data(), O_RDWR | O_NOCTTY | O_CLOEXEC);
        termios line{};
        EXPECT_EQ(::tcgetattr(far_end_, &line), 0);
        ::cfmakeraw(&line);
        EXPECT_EQ(::tcsetattr(far_end_, TCSANOW, &line), 0);
    }
    ~BareGlove() {
        ::close(far_end_);
        ::close(file_);
    }
    BareGlove(const BareGlove&) = delete;
    BareGlove& operator=(const BareGlove&) = delete;

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] ToldClock& clock() { return clock_; }

    void say(const GloveSet& set) {
        const std::vector<std::byte> frame = controller_frame(set);
        EXPECT_EQ(::write(file_, frame.data(), frame.size()), static_cast<ssize_t>(frame.size()));
    }
    // Returns the frames of the host's next turn: laws, and the forces or the stop with which a turn ends. Half a
    // minute without any is a failure.
    [[nodiscard]] std::vector<HeardGloveFrame> heard_turn() {
        constexpr int kMostWaits = 600;
        std::vector<HeardGloveFrame> turn;
        for (int waits = 0; waits < kMostWaits;) {
            std::byte byte{};
            if (::read(file_, &byte, 1) != 1) {
                pollfd comes{file_, POLLIN, 0};
                waits += ::poll(&comes, 1, 50) == 0 ? 1 : 0;
                continue;
            }
            auto frame = ear_.take(byte);
            if (!frame) continue;
            turn.push_back(std::move(*frame));
            if (!turn.back().command.law) return turn;
        }
        ADD_FAILURE() << "nothing has come for half a minute";
        turn.push_back({.bytes = {}, .command = {}});
        return turn;
    }
    // Lets the time of a turn pass for the host, and returns what it sends then.
    [[nodiscard]] std::vector<HeardGloveFrame> next_turn() {
        clock_.move_on(GloveLink::kSend_ns);
        return heard_turn();
    }
    // Returns all frames that have come and been asked for by nobody. To be called when the host is gone.
    [[nodiscard]] std::vector<HeardGloveFrame> left() {
        std::vector<HeardGloveFrame> frames;
        for (std::byte byte{}; ::read(file_, &byte, 1) == 1;)
            if (auto frame = ear_.take(byte)) frames.push_back(std::move(*frame));
        return frames;
    }

private:
    int file_ = -1, far_end_ = -1;  // the far end is held open, so that what came last is still there to be read
    std::string name_;
    ToldClock clock_;
    GloveControllerEar ear_;
};

}  // namespace burin::devices
