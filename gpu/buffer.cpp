// SPDX-License-Identifier: MIT
#include "gpu/buffer.hpp"

namespace burin::gpu {

namespace {

struct Needs {
    VkBufferUsageFlags usage = 0;
    VkMemoryPropertyFlags required = 0;
    VkMemoryPropertyFlags preferred = 0;
    bool storage = false;
    bool addressed = false;
};

Needs needs_of(BufferUse use, bool unified_memory) {
    constexpr VkMemoryPropertyFlags kSeen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    constexpr VkBufferUsageFlags kCopied = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    constexpr VkBufferUsageFlags kStorage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | kCopied;
    // With unified memory all of it is equally fast, so the CPU may see it too.
    const VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT | (unified_memory ? kSeen : 0u);
    switch (use) {
        case BufferUse::device_storage: return {kStorage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, 0, local, true};
        case BufferUse::addressed:
            return {kStorage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT |
                        VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                    0, local, false, true};
        case BufferUse::vertex: return {kStorage | VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, 0, local, true};
        case BufferUse::index: return {kStorage | VK_BUFFER_USAGE_INDEX_BUFFER_BIT, 0, local, true};
        case BufferUse::upload: return {VK_BUFFER_USAGE_TRANSFER_SRC_BIT, kSeen, 0, false};
        case BufferUse::readback:
            return {VK_BUFFER_USAGE_TRANSFER_DST_BIT, kSeen, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, false};
        case BufferUse::host_storage: return {kStorage, kSeen, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, true};
        case BufferUse::uniform:
            return {VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | kCopied, kSeen, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, false};
    }
    return {};
}

std::string mebibytes(std::uint64_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB"; }

}  // namespace

Result<Buffer> Buffer::create(Device& device, BufferUse use, std::uint64_t size_bytes, const std::string& name) {
    const std::shared_ptr<Core>& core = device.core();
    const std::string where = "GPU buffer '" + name + "'";
    const Needs needs = needs_of(use, core->capabilities.unified_memory);
    if (size_bytes == 0) return fail(where, "a size of 0 was asked for");
    if (needs.storage && size_bytes > core->capabilities.max_storage_buffer_bytes) {
        return fail(where,
                    mebibytes(size_bytes) + " were asked for, but " + core->info.name + " allows " +
                        mebibytes(core->capabilities.max_storage_buffer_bytes) + " in one buffer",
                    "lower the resolution");
    }
    if (needs.addressed && !core->capabilities.buffer_address) {
        return fail(where, core->info.name + " does not let shaders reach buffers by address", "update the GPU driver");
    }
    if (size_bytes > core->max_allocation_bytes) {
        return fail(where, mebibytes(size_bytes) + " exceed what " + core->info.name + " allocates at once",
                    "lower the resolution");
    }
    auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = size_bytes;
    info.usage = needs.usage;
    VkBuffer raw = VK_NULL_HANDLE;
    if (const VkResult r = core->vk.vkCreateBuffer(core->device, &info, nullptr, &raw); r != VK_SUCCESS) {
        return vulkan_failure(where, "could not be created", r);
    }
    Buffer buffer;
    buffer.buffer_ = BufferHandle(core, raw);
    buffer.size_bytes_ = size_bytes;

    VkMemoryRequirements requirements{};
    core->vk.vkGetBufferMemoryRequirements(core->device, raw, &requirements);
    const int type = core->memory_type(requirements.memoryTypeBits, needs.required, needs.preferred);
    if (type < 0) return fail(where, core->info.name + " has no memory of this kind", "update the GPU driver");
    auto allocate = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    auto flags_info = structure<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
    flags_info.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    if (needs.addressed) allocate.pNext = &flags_info;
    allocate.allocationSize = requirements.size;
    allocate.memoryTypeIndex = static_cast<std::uint32_t>(type);
    VkDeviceMemory memory = VK_NULL_HANDLE;
    if (const VkResult r = core->allocate(allocate, memory); r != VK_SUCCESS) {
        return vulkan_failure(where, mebibytes(size_bytes) + " could not be allocated", r);
    }
    buffer.memory_ = MemoryHandle(core, memory);
    if (const VkResult r = core->vk.vkBindBufferMemory(core->device, raw, memory, 0); r != VK_SUCCESS) {
        return vulkan_failure(where, "could not be bound to its memory", r);
    }
    if (needs.addressed) {
        auto address = structure<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
        address.buffer = raw;
        buffer.address_ = core->vk.vkGetBufferDeviceAddress(core->device, &address);
    }
    constexpr VkMemoryPropertyFlags kSeen = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags flags = core->memory.memoryTypes[type].propertyFlags;
    const bool wants_map = needs.required != 0 || core->capabilities.unified_memory;
    if (wants_map && (flags & kSeen) == kSeen) {
        void* address = nullptr;
        if (const VkResult r = core->vk.vkMapMemory(core->device, memory, 0, VK_WHOLE_SIZE, 0, &address);
            r != VK_SUCCESS) {
            return vulkan_failure(where, "could not be mapped", r);
        }
        buffer.mapped_ = {static_cast<std::byte*>(address), static_cast<std::size_t>(size_bytes)};
    }
    return buffer;
}

StagingChunk Buffer::give_up() && {
    StagingChunk chunk{buffer_.raw(), memory_.raw(), std::exchange(mapped_, {})};
    static_cast<void>(buffer_.give_up());
    static_cast<void>(memory_.give_up());
    size_bytes_ = address_ = 0;
    return chunk;
}

}  // namespace burin::gpu
