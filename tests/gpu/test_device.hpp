// SPDX-License-Identifier: MIT
// The device of the GPU tests: the validation layer is on where it is installed, and a test that made it speak fails.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "gpu/device.hpp"

namespace burin::gpu {

// Without any Vulkan driver the tests are skipped: the program must then run with --engine cpu, which others test.
class DeviceTest : public testing::Test {
protected:
    void SetUp() override {
        messages_before_ = validation_messages();
        DeviceOptions options;
        options.validation = true;
        auto created = Device::create(options);
        if (!created) GTEST_SKIP() << "no Vulkan device: " << created.error().line();
        device_.emplace(std::move(*created));
    }
    void TearDown() override {
        device_.reset();  // leaked objects are reported now
        EXPECT_EQ(validation_messages(), messages_before_) << "the validation layer complained";
    }
    Device& device() { return *device_; }

private:
    std::optional<Device> device_;
    std::uint64_t messages_before_ = 0;
};

}  // namespace burin::gpu
