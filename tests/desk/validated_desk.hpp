// SPDX-License-Identifier: MIT
// Tests of desks that open Vulkan devices by themselves: the validation layer watches each of them.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>

#include "gpu/device.hpp"

namespace burin::session {

class ValidatedDesk : public testing::Test {
protected:
    void SetUp() override {
        const auto devices = gpu::list_devices();
        if (!devices) GTEST_SKIP() << "no Vulkan device: " << devices.error().line();
        setenv("BURIN_VULKAN_VALIDATION", "1", 1);
        messages_before_ = gpu::validation_messages();
    }
    void TearDown() override {
        unsetenv("BURIN_VULKAN_VALIDATION");
        EXPECT_EQ(gpu::validation_messages(), messages_before_) << "the validation layer complained";
    }

private:
    std::uint64_t messages_before_ = 0;
};

}  // namespace burin::session
