// SPDX-License-Identifier: MIT
#include "gpu/core.hpp"

#include <algorithm>
#include <cstdint>
#include <mutex>

#include "gpu/commands.hpp"

namespace burin::gpu {

namespace {
// Long enough for the slowest dispatch of a software device; a longer wait means that the GPU hangs.
constexpr std::uint64_t kWaitLimit_ns = 120'000'000'000;
constexpr std::size_t kKeptChunks = 16;  // of staging, in a set of commands that is used again

template <typename T>
T handle_of(std::uint64_t bits) {
    return std::bit_cast<T>(bits);
}
}  // namespace

Core::Core(std::shared_ptr<SharedDevice> shared, DeviceQueue& queue)
    : instance(shared->instance),
      physical(shared->physical),
      device(shared->device),
      queue_family(shared->queue_family),
      pipeline_cache(shared->pipeline_cache),
      memory(shared->memory),
      seconds_per_stamp(shared->seconds_per_stamp),
      info(shared->info),
      vk(shared->vk),
      max_allocation_bytes(shared->max_allocation_bytes),
      capabilities(shared->capabilities),
      surface(shared->surface),
      timeline(std::make_shared<Timeline>(shared)),
      shared_(std::move(shared)),
      queue_(queue) {}

Result<std::shared_ptr<Core>> Core::create(std::shared_ptr<SharedDevice> shared, DeviceQueue& queue) {
    const std::shared_ptr<Core> lane(new Core(std::move(shared), queue));
    auto type = structure<VkSemaphoreTypeCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_TYPE_CREATE_INFO);
    type.semaphoreType = VK_SEMAPHORE_TYPE_TIMELINE;
    auto semaphore = structure<VkSemaphoreCreateInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO);
    semaphore.pNext = &type;
    const VkResult r = lane->vk.vkCreateSemaphore(lane->device, &semaphore, nullptr, &lane->timeline->semaphore);
    if (r != VK_SUCCESS) return vulkan_failure(lane->info.name, "no timeline semaphore", r);
    return lane;
}

Result<std::shared_ptr<Core>> Core::another_lane() const {
    if (lost()) return vulkan_failure(info.name, "no further lane", VK_ERROR_DEVICE_LOST);
    return create(shared_, shared_->queues[shared_->queue_count - 1]);
}

Core::~Core() {
    if (timeline->semaphore == VK_NULL_HANDLE) return;
    if (completed() < submitted) {
        // Not for the whole device, whose queues other lanes may be using. A lost device answers at once.
        auto wait = structure<VkSemaphoreWaitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO);
        wait.semaphoreCount = 1;
        wait.pSemaphores = &timeline->semaphore;
        wait.pValues = &submitted;
        vk.vkWaitSemaphores(device, &wait, UINT64_MAX);
    }
    for (const Retired& r : retired_) destroy(r.type, r.handle);
    for (const auto& [serial, set] : retired_sets_) destroy(set);
    for (const CommandSet& set : free_sets_) destroy(set);
}

VkResult Core::submit(VkCommandBuffer commands, std::uint64_t serial, std::span<const Moment> after,
                      const QueueSync& sync) {
    if (lose_at_next_submit) note_loss();
    if (lost()) return VK_ERROR_DEVICE_LOST;
    // Binary semaphores ignore their values.
    std::vector<VkSemaphore> waits, signals{timeline->semaphore};
    std::vector<std::uint64_t> wait_values, signal_values{serial};
    std::vector<VkPipelineStageFlags> stages;
    for (const Moment& moment : after) {
        waits.push_back(moment.timeline->semaphore);
        wait_values.push_back(moment.serial);
        stages.push_back(VK_PIPELINE_STAGE_ALL_COMMANDS_BIT);
    }
    if (sync.wait != VK_NULL_HANDLE) {
        waits.push_back(sync.wait);
        wait_values.push_back(0);
        stages.push_back(VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT);
    }
    if (sync.signal != VK_NULL_HANDLE) {
        signals.push_back(sync.signal);
        signal_values.push_back(0);
    }
    auto values = structure<VkTimelineSemaphoreSubmitInfo>(VK_STRUCTURE_TYPE_TIMELINE_SEMAPHORE_SUBMIT_INFO);
    values.waitSemaphoreValueCount = static_cast<std::uint32_t>(wait_values.size());
    values.pWaitSemaphoreValues = wait_values.data();
    values.signalSemaphoreValueCount = static_cast<std::uint32_t>(signal_values.size());
    values.pSignalSemaphoreValues = signal_values.data();
    auto submission = structure<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submission.pNext = &values;
    submission.commandBufferCount = 1;
    submission.pCommandBuffers = &commands;
    submission.waitSemaphoreCount = static_cast<std::uint32_t>(waits.size());
    submission.pWaitSemaphores = waits.data();
    submission.pWaitDstStageMask = stages.data();
    submission.signalSemaphoreCount = static_cast<std::uint32_t>(signals.size());
    submission.pSignalSemaphores = signals.data();
    const std::lock_guard lock(queue_.mutex);
    const VkResult result = vk.vkQueueSubmit(queue_.raw, 1, &submission, VK_NULL_HANDLE);
    if (result == VK_ERROR_DEVICE_LOST) note_loss();
    return result;
}

VkResult Core::present(const VkPresentInfoKHR& presentation) {
    if (lost()) return VK_ERROR_DEVICE_LOST;
    const std::lock_guard lock(queue_.mutex);
    return vk.vkQueuePresentKHR(queue_.raw, &presentation);
}

void Core::wait_for_queue() {
    const std::lock_guard lock(queue_.mutex);
    vk.vkQueueWaitIdle(queue_.raw);
}

std::uint64_t Core::completed() {
    std::uint64_t value = 0;
    if (vk.vkGetSemaphoreCounterValue(device, timeline->semaphore, &value) != VK_SUCCESS) return 0;
    return value;
}

// However often the same work is waited for, that counts as one wait.
bool Core::completed_within(std::uint64_t serial, std::uint64_t most_ns) {
    bool done = lost() || completed() >= serial;
    if (!done && most_ns > 0) {
        if (serial > waited) ++waits;
        auto wait = structure<VkSemaphoreWaitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO);
        wait.semaphoreCount = 1;
        wait.pSemaphores = &timeline->semaphore;
        wait.pValues = &serial;
        done = vk.vkWaitSemaphores(device, &wait, most_ns) != VK_TIMEOUT;
        waited = std::max(waited, serial);
    }
    // A wait that comes after it for work that is done does not block.
    if (done) waited = std::max(waited, serial);
    return done;
}

Result<void> Core::wait_for(std::uint64_t serial) {
    if (serial > waited) ++waits;
    waited = std::max(waited, serial);
    auto wait = structure<VkSemaphoreWaitInfo>(VK_STRUCTURE_TYPE_SEMAPHORE_WAIT_INFO);
    wait.semaphoreCount = 1;
    wait.pSemaphores = &timeline->semaphore;
    wait.pValues = &serial;
    const VkResult result = vk.vkWaitSemaphores(device, &wait, kWaitLimit_ns);
    if (result == VK_TIMEOUT) {
        return fail(info.name, "the GPU has not finished within 120 s", "lower the resolution");
    }
    if (result == VK_ERROR_DEVICE_LOST) note_loss();
    if (result != VK_SUCCESS) return vulkan_failure(info.name, "waiting for the GPU failed", result);
    return {};
}

void Core::retire_handle(VkObjectType type, std::uint64_t handle) {
    if (completed() >= submitted) {
        destroy(type, handle);
    } else {
        retired_.push_back({submitted, type, handle});
    }
}

void Core::retire(CommandSet set, std::uint64_t after_serial) {
    retired_sets_.emplace_back(after_serial, std::move(set));
}

void Core::collect() {
    const std::uint64_t done = completed();
    // Destroys in order of retirement, as an object may be retired before the memory it is bound to.
    const auto first_kept = std::ranges::find_if(retired_, [done](const Retired& r) { return r.serial > done; });
    for (auto r = retired_.begin(); r != first_kept; ++r) destroy(r->type, r->handle);
    retired_.erase(retired_.begin(), first_kept);
    std::erase_if(retired_sets_, [&](auto& entry) {
        if (entry.first > done) return false;
        free_sets_.push_back(std::move(entry.second));
        free_sets_.back().waited_for.clear();
        return true;
    });
}

Result<CommandSet> Core::take_command_set() {
    collect();
    if (!free_sets_.empty()) {
        CommandSet set = std::move(free_sets_.back());
        free_sets_.pop_back();
        // What a large surface needed once is not held for ever.
        while (set.staging.size() > kKeptChunks) {
            destroy(set.staging.back());
            set.staging.pop_back();
        }
        vk.vkResetCommandPool(device, set.pool, 0);
        for (VkDescriptorPool pool : set.descriptor_pools) vk.vkResetDescriptorPool(device, pool, 0);
        return set;
    }
    CommandSet set;
    auto pool = structure<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    pool.queueFamilyIndex = queue_family;
    if (const VkResult r = vk.vkCreateCommandPool(device, &pool, nullptr, &set.pool); r != VK_SUCCESS) {
        return vulkan_failure(info.name, "no command pool", r);
    }
    auto buffer = structure<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    buffer.commandPool = set.pool;
    buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffer.commandBufferCount = 1;
    if (const VkResult r = vk.vkAllocateCommandBuffers(device, &buffer, &set.commands); r != VK_SUCCESS) {
        destroy(set);
        return vulkan_failure(info.name, "no command buffer", r);
    }
    return set;
}

int Core::memory_type(std::uint32_t allowed_bits, VkMemoryPropertyFlags required,
                      VkMemoryPropertyFlags preferred) const {
    int best = -1, best_score = -1;
    for (std::uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[i].propertyFlags;
        if ((allowed_bits & (1u << i)) == 0 || (flags & required) != required) continue;
        const int score = std::popcount(flags & preferred);
        if (score > best_score) {
            best = static_cast<int>(i);
            best_score = score;
        }
    }
    return best;
}

VkResult Core::allocate(const VkMemoryAllocateInfo& wanted, VkDeviceMemory& to) {
    ++allocations;
    const VkResult result = vk.vkAllocateMemory(device, &wanted, nullptr, &to);
    const bool is_own =
        (memory.memoryTypes[wanted.memoryTypeIndex].propertyFlags & VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT) != 0;
    if (result != VK_SUCCESS || !is_own) return result;
    own_pieces_.emplace(to, wanted.allocationSize);
    own_bytes += wanted.allocationSize;
    most_own_bytes = std::max(most_own_bytes, own_bytes);
    shared_->note_allocated(wanted.allocationSize);
    return result;
}

void Core::free(VkDeviceMemory piece) {
    if (const auto own = own_pieces_.find(piece); own != own_pieces_.end()) {
        own_bytes -= own->second;
        shared_->note_freed(own->second);
        own_pieces_.erase(own);
    }
    vk.vkFreeMemory(device, piece, nullptr);
}

void Core::destroy(const CommandSet& set) {
    for (VkDescriptorPool pool : set.descriptor_pools) vk.vkDestroyDescriptorPool(device, pool, nullptr);
    for (const StagingChunk& chunk : set.staging) destroy(chunk);
    vk.vkDestroyQueryPool(device, set.stamps, nullptr);
    vk.vkDestroyCommandPool(device, set.pool, nullptr);  // frees its command buffer too
}

void Core::destroy(const StagingChunk& chunk) {
    vk.vkDestroyBuffer(device, chunk.buffer, nullptr);
    free(chunk.memory);
}

void Core::destroy(VkObjectType type, std::uint64_t bits) {
    switch (type) {
        case VK_OBJECT_TYPE_BUFFER: return vk.vkDestroyBuffer(device, handle_of<VkBuffer>(bits), nullptr);
        case VK_OBJECT_TYPE_IMAGE: return vk.vkDestroyImage(device, handle_of<VkImage>(bits), nullptr);
        case VK_OBJECT_TYPE_IMAGE_VIEW: return vk.vkDestroyImageView(device, handle_of<VkImageView>(bits), nullptr);
        case VK_OBJECT_TYPE_DEVICE_MEMORY: return free(handle_of<VkDeviceMemory>(bits));
        case VK_OBJECT_TYPE_PIPELINE: return vk.vkDestroyPipeline(device, handle_of<VkPipeline>(bits), nullptr);
        case VK_OBJECT_TYPE_PIPELINE_LAYOUT:
            return vk.vkDestroyPipelineLayout(device, handle_of<VkPipelineLayout>(bits), nullptr);
        case VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT:
            return vk.vkDestroyDescriptorSetLayout(device, handle_of<VkDescriptorSetLayout>(bits), nullptr);
        case VK_OBJECT_TYPE_DESCRIPTOR_POOL:
            return vk.vkDestroyDescriptorPool(device, handle_of<VkDescriptorPool>(bits), nullptr);
        case VK_OBJECT_TYPE_SHADER_MODULE:
            return vk.vkDestroyShaderModule(device, handle_of<VkShaderModule>(bits), nullptr);
        case VK_OBJECT_TYPE_RENDER_PASS: return vk.vkDestroyRenderPass(device, handle_of<VkRenderPass>(bits), nullptr);
        case VK_OBJECT_TYPE_FRAMEBUFFER:
            return vk.vkDestroyFramebuffer(device, handle_of<VkFramebuffer>(bits), nullptr);
        case VK_OBJECT_TYPE_SEMAPHORE: return vk.vkDestroySemaphore(device, handle_of<VkSemaphore>(bits), nullptr);
        case VK_OBJECT_TYPE_SURFACE_KHR: return surface.destroy(instance, handle_of<VkSurfaceKHR>(bits), nullptr);
        case VK_OBJECT_TYPE_SAMPLER: return vk.vkDestroySampler(device, handle_of<VkSampler>(bits), nullptr);
        default: BURIN_CHECK(false && "an object type that destroy() does not know");
    }
}

}  // namespace burin::gpu
