// SPDX-License-Identifier: MIT
#include "devices/trackers/network.hpp"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

namespace burin::devices {
namespace {

constexpr Nanoseconds kVeryLong_ns = 60'000'000'000;

// Listens and takes nobody: who comes when its queue is full is not answered.
class DeafServer {
public:
    DeafServer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in at{};
        at.sin_family = AF_INET;
        at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof(at);
        EXPECT_EQ(::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&at), sizeof(at)), 0);
        EXPECT_EQ(::listen(listener_.get(), 0), 0);
        EXPECT_EQ(::getsockname(listener_.get(), reinterpret_cast<sockaddr*>(&at), &size), 0);
        port_ = ntohs(at.sin_port);
        for (int i = 0; i < 4; ++i) {
            auto one = connect_to({"127.0.0.1", port_}, 200'000'000);
            if (one) waiting_.push_back(std::move(*one));
        }
    }
    [[nodiscard]] std::uint16_t port() const { return port_; }

private:
    OwnedFile listener_;
    std::vector<OwnedFile> waiting_;
    std::uint16_t port_ = 0;
};

}  // namespace

TEST(Network, AConnectionThatIsNotAnsweredEndsWhenItIsToldTo) {
    const DeafServer server;
    EXPECT_EQ(connect_to({"127.0.0.1", server.port()}, 50'000'000).error(), "it does not answer");
    const StopSign stop;
    std::thread gives([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        stop.give();
    });
    EXPECT_EQ(connect_to({"127.0.0.1", server.port()}, kVeryLong_ns, &stop).error(), "it was told to end");
    gives.join();
}

TEST(Network, TheSearchForANameEndsWhenItIsToldTo) {
    const StopSign stop;
    stop.give();
    EXPECT_EQ(connect_to({"localhost", 1}, kVeryLong_ns, &stop).error(), "it was told to end");
    const StopSign other;
    const auto refused = connect_to({"localhost", 1}, kVeryLong_ns, &other);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error(), "it was told to end") << "the name is found, and nobody listens there";
}

}  // namespace burin::devices
