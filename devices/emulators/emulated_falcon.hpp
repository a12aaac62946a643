// SPDX-License-Identifier: MIT
// A Novint Falcon that is not there: its USB chip, its boot loader, its firmware and its legs, around a simulated arm
// in a scripted hand, at the far end of a socket (devices/falcon/falcon_socket.hpp). The driver speaks with it byte for
// byte as with a real one: it takes firmware at the speeds and by the greetings of the boot loader alone and once it
// has said that it is clear to send, says a byte of the first load back wrongly, as users of libnifalcon report,
// answers each packet with one, in one piece or two, after pieces with nothing in them, and has encoders of whole
// steps. The force on the arm is what its legs make of the motors' commands.
// The script begins when a host has sent its first packet. One thread runs it; drills and the written command are any
// thread's.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "devices/emulators/emulated_motion.hpp"
#include "devices/falcon/falcon_kinematics.hpp"
#include "devices/hand/simulated_hand.hpp"
#include "devices/presence/owned_file.hpp"

namespace burin::devices {

struct EmulatedFalconOptions {
    std::vector<HandPose> script;  // of the hand, device frame; empty: circling_hand()
    SilenceDrill silence;          // its cable is pulled then
    bool has_firmware = true;      // as one that was used since it was switched on
    bool is_homed = true;
    // Of its firmware's loads, from when it is plugged in: in so many of the first, one byte is said back wrongly.
    int bad_loads = 1;
};

class EmulatedFalcon {
public:
    // Fails where one of that name runs already.
    [[nodiscard]] static Result<EmulatedFalcon> create(const std::string& name, EmulatedFalconOptions options = {});
    // Runs in real time until `ends` says so, which is asked a thousand times a second.
    void run(const std::function<bool()>& ends);

    // Drills. Silent: it hears and does not answer. Pulled: its cable is; plugged in again it has lost its firmware and
    // its home where `options` say that it began so.
    void fall_silent(bool is_silent) { drill_->is_silent = is_silent; }
    void pull_cable(bool is_pulled) { drill_->is_pulled = is_pulled; }
    void home(bool is_homed) { drill_->is_homed = is_homed; }
    // Reads angles that its legs cannot have.
    void lose_its_pose(bool is_lost) { drill_->is_lost = is_lost; }
    // Sends so many bytes of rubbish before each packet.
    void babble(int bytes) { drill_->babble = bytes; }

    // Returns the motors' commands that were last written to it.
    [[nodiscard]] FalconCounts written() const { return written_->get(); }
    // Returns the force at the grip that they make where it is.
    [[nodiscard]] Vec3 written_N() const;
    // Returns the newest kMostHeard packets that the host has sent, in their order, as they came: "<AAAAAAAAAAAADA>".
    [[nodiscard]] std::vector<std::string> heard() const;
    static constexpr std::size_t kMostHeard = 4096;
    [[nodiscard]] int firmware_loads() const { return drill_->loads; }
    [[nodiscard]] unsigned int lamps() const { return drill_->lamps; }

private:
    struct Drill {
        std::atomic<bool> is_silent = false, is_pulled = false, is_homed = true, is_lost = false;
        std::atomic<int> babble = 0, loads = 0;
        std::atomic<unsigned int> lamps = 0;
    };
    // Three numbers of 16 bits in one word, so that they are read as they were written.
    class Counts {
    public:
        void set(const FalconCounts& counts) {
            std::uint64_t word = 0;
            for (std::size_t i = 0; i < kFalconLegs; ++i)
                word |= std::uint64_t{static_cast<std::uint16_t>(counts[i])} << (16 * i);
            word_ = word;
        }
        [[nodiscard]] FalconCounts get() const {
            const std::uint64_t word = word_;
            FalconCounts counts;
            for (std::size_t i = 0; i < kFalconLegs; ++i)
                counts[i] = static_cast<std::int16_t>(static_cast<std::uint16_t>(word >> (16 * i)));
            return counts;
        }

    private:
        std::atomic<std::uint64_t> word_ = 0;
    };
    struct Heard {
        void keep(const std::string& packet);
        std::mutex mutex;
        std::deque<std::string> packets;
    };
    class Device;
    EmulatedFalcon(OwnedFile listener, EmulatedFalconOptions options)
        : listener_(std::move(listener)), options_(std::move(options)) {}

    OwnedFile listener_;
    EmulatedFalconOptions options_;
    std::unique_ptr<Drill> drill_ = std::make_unique<Drill>();
    std::unique_ptr<Heard> heard_ = std::make_unique<Heard>();
    std::unique_ptr<Counts> written_ = std::make_unique<Counts>(), encoders_ = std::make_unique<Counts>();
};

}  // namespace burin::devices
