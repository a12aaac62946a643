// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <string>

#include "gpu/buffer.hpp"
#include "gpu/commands.hpp"
#include "tests/gpu/test_device.hpp"

namespace burin::gpu {

namespace {
// Points the loader at no driver for as long as it lives.
class NoDriver {
public:
    NoDriver() {
        setenv("VK_ICD_FILENAMES", "/nonexistent/driver.json", 1);
        setenv("VK_DRIVER_FILES", "/nonexistent/driver.json", 1);
    }
    ~NoDriver() {
        unsetenv("VK_ICD_FILENAMES");
        unsetenv("VK_DRIVER_FILES");
    }
};
}  // namespace

TEST(NoVulkanDriver, IsAnErrorThatNamesTheRemedy) {
    if (std::getenv("VK_ICD_FILENAMES") != nullptr || std::getenv("VK_DRIVER_FILES") != nullptr) {
        GTEST_SKIP() << "the environment names a driver, which this test would have to change";
    }
    const NoDriver no_driver;
    const auto device = Device::create();
    ASSERT_FALSE(device);
    EXPECT_NE(device.error().line().find("mesa-vulkan-drivers"), std::string::npos) << device.error().line();
    EXPECT_EQ(device.error().line().find("--engine"), std::string::npos) << "pictures need a driver with any engine";
    const auto listed = list_devices();
    ASSERT_FALSE(listed);
    EXPECT_NE(listed.error().line().find("mesa-vulkan-drivers"), std::string::npos) << listed.error().line();
}

// The other tests assert that the layer is silent; this one, that it is there at all.
TEST(ValidationLayer, SpeaksWhenVulkanIsMisused) {
    DeviceOptions options;
    options.validation = true;
    auto device = Device::create(options);
    if (!device) GTEST_SKIP() << "no Vulkan device: " << device.error().line();
    const std::uint64_t before = validation_messages();
    const auto empty = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);  // size and usage 0
    VkBuffer raw = VK_NULL_HANDLE;
    const Core& core = *device->core();
    if (core.vk.vkCreateBuffer(core.device, &empty, nullptr, &raw) == VK_SUCCESS) {
        core.vk.vkDestroyBuffer(core.device, raw, nullptr);
    }
    EXPECT_GT(validation_messages(), before);
}

// Two writes to one buffer, first with a barrier between them and then without.
TEST(ValidationLayer, SpeaksWhenABarrierIsMissing) {
    DeviceOptions options;
    options.validation = true;
    auto device = Device::create(options);
    if (!device) GTEST_SKIP() << "no Vulkan device: " << device.error().line();
    const auto buffer = Buffer::create(*device, BufferUse::device_storage, 64, "written twice");
    ASSERT_TRUE(buffer);
    const auto messages_of_two_writes = [&](bool with_barrier) -> std::uint64_t {
        const std::uint64_t before = validation_messages();
        auto commands = Commands::begin(*device);
        EXPECT_TRUE(commands);
        if (!commands) return 0;
        commands->fill(*buffer, 0, 64, 1);
        if (with_barrier) commands->barrier();
        commands->fill(*buffer, 0, 64, 2);
        auto submission = std::move(*commands).submit();
        EXPECT_TRUE(submission && submission->wait());
        return validation_messages() - before;
    };
    EXPECT_EQ(messages_of_two_writes(true), 0u);
    EXPECT_GT(messages_of_two_writes(false), 0u);
}

using DeviceGpu = DeviceTest;

TEST_F(DeviceGpu, IsOneOfTheListedDevices) {
    const auto listed = list_devices();
    ASSERT_TRUE(listed) << listed.error().line();
    ASSERT_LT(device().info().index, listed->size());
    EXPECT_EQ((*listed)[device().info().index].name, device().info().name);
    EXPECT_NE(device().info().line().find(device().info().api), std::string::npos);
}

TEST_F(DeviceGpu, HasTheLimitsThatVulkanGuarantees) {
    const Capabilities& c = device().capabilities();
    EXPECT_GE(c.max_storage_buffer_bytes, 1u << 27);
    EXPECT_GE(c.max_push_constant_bytes, 128u);
    EXPECT_GE(c.max_workgroup_invocations, 128u);
    EXPECT_GE(c.max_workgroup_count, 65535u);
    EXPECT_EQ(c.msaa_samples, 4u);
    EXPECT_GE(c.subgroup_size, 1u);
}

TEST_F(DeviceGpu, RefusesAnIndexThatDoesNotExist) {
    DeviceOptions options;
    options.index = 1000;
    const auto refused = Device::create(options);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().line().find("1000"), std::string::npos) << refused.error().line();
}

TEST_F(DeviceGpu, PrefersTheKindAskedForWhereItExists) {
    const auto listed = list_devices();
    ASSERT_TRUE(listed);
    bool any_software = false, any_hardware = false;
    for (const DeviceInfo& info : *listed) {
        if (!info.unusable.empty()) continue;
        (info.is_software() ? any_software : any_hardware) = true;
    }
    DeviceOptions options;
    options.prefer = Prefer::software;
    const auto software = Device::create(options);
    ASSERT_TRUE(software);
    EXPECT_EQ(software->info().is_software(), any_software);
    EXPECT_EQ(device().info().is_software(), !any_hardware);
}

TEST_F(DeviceGpu, RefusesAStorageBufferBeyondTheLimitWithoutAllocating) {
    const std::uint64_t too_much = device().capabilities().max_storage_buffer_bytes + 1;
    const auto buffer = Buffer::create(device(), BufferUse::device_storage, too_much, "rays");
    ASSERT_FALSE(buffer);
    EXPECT_NE(buffer.error().line().find("rays"), std::string::npos) << buffer.error().line();
    const auto claimed = Buffer::create(device(), BufferUse::upload, std::uint64_t{1} << 60, "claimed");
    EXPECT_FALSE(claimed);
}

TEST_F(DeviceGpu, RefusesAnEmptyBuffer) {
    EXPECT_FALSE(Buffer::create(device(), BufferUse::device_storage, 0, "nothing"));
}

TEST_F(DeviceGpu, OutlivesItsDeviceHandle) {
    std::optional<Buffer> buffer;
    {
        auto second = Device::create({.prefer = Prefer::software, .index = {}, .validation = true});
        ASSERT_TRUE(second);
        auto created = Buffer::create(*second, BufferUse::upload, 64, "survivor");
        ASSERT_TRUE(created);
        buffer = std::move(*created);
    }
    buffer->mapped()[63] = std::byte{7};
    EXPECT_EQ(buffer->mapped()[63], std::byte{7});
}

}  // namespace burin::gpu
