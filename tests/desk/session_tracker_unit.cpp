// SPDX-License-Identifier: MIT
// Trackers by the network, over this machine's own loopback.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

#include "devices/trackers/udp_tracker.hpp"
#include "session/input/input_line.hpp"
#include "session/live/session_watch.hpp"

namespace burin::session {
namespace {

using devices::TrackerSample;
using devices::UdpTracker;

class Sender {
public:
    explicit Sender(std::uint16_t port) : socket_(socket(AF_INET, SOCK_DGRAM, 0)) {
        to_.sin_family = AF_INET;
        to_.sin_port = htons(port);
        to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    }
    ~Sender() { close(socket_); }
    void send(const std::string& text) const {
        ASSERT_EQ(sendto(socket_, text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&to_), sizeof(to_)),
                  static_cast<ssize_t>(text.size()));
    }

private:
    int socket_;
    sockaddr_in to_{};
};

std::unique_ptr<UdpTracker> open_port(Clock& clock) {
    auto port = UdpTracker::open("udp:0", {clock, {}, parse_tracker_line});
    EXPECT_TRUE(port) << port.error().line();
    return std::move(*port);
}

// Waits until so many have come, but not for ever.
std::vector<TrackerSample> heard_by(UdpTracker& port, std::size_t count) {
    std::vector<TrackerSample> all;
    for (int i = 0; i < 30'000 && all.size() < count; ++i) {
        for (TrackerSample& heard : port.take()) all.push_back(std::move(heard));
        if (all.size() < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return all;
}

}  // namespace

TEST(UdpTracker, HearsHeadsAndWandsInTheirOrder) {
    MonotonicClock clock;
    const auto port = open_port(clock);
    const Sender sender(port->port());
    const Nanoseconds before_ns = clock.now_ns();
    sender.send("head 0.1 1.6 2 0 0 0 1\n\nwand 1 0 1 1 0 0 0 1 lost\nwand-button 0 press 2");
    sender.send("wand-stick 0 -0.5 1\n");
    const auto heard = heard_by(*port, 4);
    ASSERT_EQ(heard.size(), 4u);
    EXPECT_EQ(input_of(heard[0].input), Input(HeadInput{{{0.1, 1.6, 2.0}, Quat{1, 0, 0, 0}}, true}));
    EXPECT_EQ(input_of(heard[1].input), Input(WandInput{1, {{0.0, 1.0, 1.0}, Quat{1, 0, 0, 0}}, false}));
    EXPECT_EQ(input_of(heard[2].input), Input(WandClick{0, 2, true}));
    EXPECT_EQ(input_of(heard[3].input), Input(WandStick{0, {-0.5, 1.0}}));
    EXPECT_GE(heard[0].time_ns, before_ns);
    EXPECT_GE(heard[3].time_ns, heard[0].time_ns);
    EXPECT_LE(heard[3].time_ns, clock.now_ns());
}

TEST(UdpTracker, PassesOverNonsenseAndSaysSoOnce) {
    MonotonicClock clock;
    const auto port = open_port(clock);
    const Sender sender(port->port());
    sender.send("haed 0 0 0 0 0 0 1\nhead nan 0 0 0 0 0 1\nhead 0 0 0 0 0 0 0\ncommand quit\n" +
                std::string(300, '\x80') + "\nhead 1 2 3");
    sender.send(std::string(5000, 'x'));
    sender.send("head 0 1.6 2 0 0 0 1");
    const auto heard = heard_by(*port, 1);
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_GE(port->refused(), 6u);
    const auto said = port->take_messages();
    ASSERT_FALSE(said.empty());
    EXPECT_NE(said[0].find("head"), std::string::npos) << "the nearest word: " << said[0];
}

// The numbers of a line that was cut off are others than were sent.
TEST(UdpTracker, TakesNoSampleOfALineThatALongDatagramCutsOff) {
    MonotonicClock clock;
    const auto port = open_port(clock);
    const Sender sender(port->port());
    const std::string first = "head 0 1.6 2 0 0 0 1\n", left = "head 0 1.6 1 0 0.7 0 0.7";
    sender.send(first + std::string(4096 - first.size() - left.size(), '\n') + left + "5\n");
    sender.send("head 0 1.6 3 0 0 0 1");
    const auto heard = heard_by(*port, 2);
    ASSERT_EQ(heard.size(), 2u);
    EXPECT_EQ(input_of(heard[0].input), Input(HeadInput{{{0.0, 1.6, 2.0}, Quat{1, 0, 0, 0}}, true}));
    EXPECT_EQ(input_of(heard[1].input), Input(HeadInput{{{0.0, 1.6, 3.0}, Quat{1, 0, 0, 0}}, true}));
    EXPECT_EQ(port->refused(), 1u);
    const auto said = port->take_messages();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_NE(said[0].find("4096"), std::string::npos) << said[0];
}

TEST(UdpTracker, NamesWhatItCannotListenTo) {
    MonotonicClock clock;
    for (const char* where : {"", "5005", "udp:", "udp:x", "udp:70000", "udp:1.2.3:80", "udp:300.1.1.1:80", "tcp:80"}) {
        const auto port = devices::open_tracker(where, {clock, {}, parse_tracker_line});
        ASSERT_FALSE(port) << where;
        EXPECT_NE(port.error().line().find(std::string("tracker ") + where), std::string::npos);
        EXPECT_NE(port.error().line().find("udp:"), std::string::npos);
    }
    const auto first = open_port(clock);
    const auto second = UdpTracker::open("udp:" + std::to_string(first->port()), {clock, {}, parse_tracker_line});
    ASSERT_FALSE(second) << "the port is taken";
}

TEST(UdpTracker, KeepsABoundedNumberOfSamplesThatNobodyTakesAndCountsTheRest) {
    MonotonicClock clock;
    std::atomic<int> datagrams = 0;
    auto opened = UdpTracker::open("udp:0", {clock, [&] { ++datagrams; }, parse_tracker_line});
    ASSERT_TRUE(opened) << opened.error().line();
    UdpTracker& port = **opened;
    const Sender sender(port.port());
    constexpr int kDatagrams = 80, kLines = 150;
    std::string lines;
    for (int i = 0; i < kLines; ++i) lines += "head 0 1.6 2 0 0 0 1\n";
    for (int sent = 1; sent <= kDatagrams; ++sent) {
        sender.send(lines);
        for (int i = 0; i < 30'000 && datagrams < sent; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ASSERT_EQ(datagrams, sent);
    }
    const std::size_t kept = port.take().size();
    EXPECT_LT(kept, std::size_t{kDatagrams} * kLines / 2);
    EXPECT_GE(kept, 1000u) << "a second of a fast tracker";
    EXPECT_EQ(kept + port.refused(), std::size_t{kDatagrams} * kLines);
    sender.send("head 0 1.6 2 0 0 0 1");
    EXPECT_EQ(heard_by(port, 1).size(), 1u) << "there is room again";
}

TEST(UdpTracker, SaysWhatItRefusesAtMostOnceASecond) {
    struct SetClock final : Clock {  // the port reads it on a thread of its own
        std::atomic<Nanoseconds> now = 0;
        Nanoseconds now_ns() noexcept override { return now; }
        void sleep_until(Nanoseconds deadline_ns) noexcept override { now = deadline_ns; }
    };
    SetClock clock;
    std::atomic<int> datagrams = 0;
    auto opened = UdpTracker::open("udp:0", {clock, [&] { ++datagrams; }, parse_tracker_line});
    ASSERT_TRUE(opened) << opened.error().line();
    const Sender sender((*opened)->port());
    int sent = 0;
    const auto send_nonsense = [&] {
        sender.send("haed 0 0 0 0 0 0 1");
        ++sent;
        for (int i = 0; i < 30'000 && datagrams < sent; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ASSERT_EQ(datagrams, sent);
    };
    for (int i = 0; i < 5; ++i) send_nonsense();
    EXPECT_EQ((*opened)->take_messages().size(), 1u);
    clock.sleep_until(kNanosecondsPerSecond);
    for (int i = 0; i < 5; ++i) send_nonsense();
    EXPECT_EQ((*opened)->take_messages().size(), 1u);
    clock.sleep_until(kNanosecondsPerSecond * 8 / 5);
    send_nonsense();
    EXPECT_TRUE((*opened)->take_messages().empty());
    clock.sleep_until(kNanosecondsPerSecond * 11 / 5);
    send_nonsense();
    EXPECT_EQ((*opened)->take_messages().size(), 1u) << "a sender that never pauses is told of again";
    EXPECT_EQ((*opened)->refused(), 12u);
}

TEST(UdpTracker, TellsEachOfSeveralBadLinesAndNotTheFirstAlone) {
    MonotonicClock clock;
    const auto port = open_port(clock);
    const Sender sender(port->port());
    sender.send("haed 0 0 0 0 0 0 1\nhead nan 0 0 0 0 0 1\ncommand quit\nhaed 0 0 0 0 0 0 1\nhead 0 1.6 2 0 0 0 1");
    ASSERT_EQ(heard_by(*port, 1).size(), 1u);
    EXPECT_EQ(port->refused(), 4u);
    const auto said = port->take_messages();
    EXPECT_EQ(said.size(), 3u) << "the same line again says nothing new";
    EXPECT_EQ(std::set<std::string>(said.begin(), said.end()).size(), said.size());
}

TEST(FirstWordWatch, TellsOnceOfATrackerThatNeverSpeaks) {
    FirstWordWatch silent("udp:5005");
    const Nanoseconds begun_ns = 7'000'000'000, late_ns = begun_ns + FirstWordWatch::kPatience_ns;
    EXPECT_FALSE(silent.look(false, begun_ns));
    EXPECT_FALSE(silent.look(false, late_ns - 1));
    const auto told = silent.look(false, late_ns);
    ASSERT_TRUE(told);
    EXPECT_TRUE(told->starts_with("tracker udp:5005: nothing has come from it yet")) << *told;
    EXPECT_FALSE(silent.look(false, 2 * late_ns)) << "once";
    EXPECT_EQ(silent.look(true, 2 * late_ns), "tracker udp:5005: is heard now");
    EXPECT_FALSE(silent.look(true, 3 * late_ns));
    EXPECT_FALSE(silent.look(false, 4 * late_ns)) << "later silence is the head's watch to tell of";

    FirstWordWatch well("udp:5005");
    EXPECT_FALSE(well.look(true, begun_ns));
    EXPECT_FALSE(well.look(false, late_ns));
}

}  // namespace burin::session
