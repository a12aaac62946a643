// SPDX-License-Identifier: MIT
// The internals of a Device: one lane of an opened device, shared by the objects made in it. A lane has the timeline of
// its submissions, the objects to destroy once the GPU no longer uses them, the command sets to use again, and what it
// was asked for; the rest it shares with the device's other lanes (shared_device.hpp). For gpu/ and for code that
// records Vulkan commands of its own (renderer/). Threads: as Device.
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "gpu/device.hpp"
#include "gpu/shared_device.hpp"
#include "gpu/vulkan.hpp"

namespace burin::gpu {

// Memory that the CPU writes and the GPU copies from; its creation costs a driver of a card 0.1 ms and more.
struct StagingChunk {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::span<std::byte> mapped;
};

struct Moment;     // commands.hpp
struct QueueSync;  // commands.hpp

// The Vulkan objects one submission is recorded with; reused by a later submission.
struct CommandSet {
    VkCommandPool pool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkQueryPool stamps = VK_NULL_HANDLE;  // created by the first stamp()
    std::vector<VkDescriptorPool> descriptor_pools;
    std::vector<StagingChunk> staging;                        // all of the usual size (Commands::upload)
    std::vector<std::shared_ptr<const Timeline>> waited_for;  // of other lanes
};

class Core {
public:
    // Opens a lane that submits to this queue of the device.
    [[nodiscard]] static Result<std::shared_ptr<Core>> create(std::shared_ptr<SharedDevice> shared, DeviceQueue& queue);
    ~Core();  // waits for what the lane has submitted
    Core(const Core&) = delete;
    Core& operator=(const Core&) = delete;

    // Of the device, for all of its lanes.
    [[nodiscard]] SharedDevice& shared() const { return *shared_; }
    [[nodiscard]] Result<std::shared_ptr<Core>> another_lane() const;
    const VkInstance instance;
    const VkPhysicalDevice physical;
    const VkDevice device;
    const std::uint32_t queue_family;
    const VkPipelineCache pipeline_cache;
    const VkPhysicalDeviceMemoryProperties& memory;
    const double seconds_per_stamp;
    const DeviceInfo& info;
    // Changed by tests alone, while the device has one lane.
    VolkDeviceTable& vk;
    std::uint64_t& max_allocation_bytes;
    Capabilities& capabilities;
    SurfaceFunctions& surface;

    // Each submission of the lane signals the next number.
    const std::shared_ptr<Timeline> timeline;
    std::uint64_t submitted = 0;
    // `waits` counts waits of the host for a submission newer than all that it had waited for; `waited` is the newest
    // of these.
    std::uint64_t waits = 0, waited = 0;
    // Copied between buffers that the host sees and those that it does not.
    std::uint64_t bytes_to_device = 0, bytes_to_host = 0;
    // Written by shaders into the host's memory (BufferUse::host_storage), as whoever reads it says.
    std::uint64_t bytes_written_to_host = 0;
    void count_written_to_host(std::uint64_t bytes) {
        if (!capabilities.unified_memory) bytes_written_to_host += bytes;
    }
    // For tests: how many pieces of memory were asked of the driver.
    std::uint64_t allocations = 0;
    // Of the device's own memory: held now by the lane's objects, and at most so far.
    std::uint64_t own_bytes = 0, most_own_bytes = 0;
    // All memory of buffers and images comes from here, and goes back through retire() or destruction.
    [[nodiscard]] VkResult allocate(const VkMemoryAllocateInfo& info, VkDeviceMemory& to);
    // Set by the first submission, wait or presentation of any lane that reports the device as lost; nothing works
    // afterwards, in no lane.
    [[nodiscard]] bool lost() const { return shared_->is_lost(); }
    void note_loss() { shared_->note_loss(); }
    // For tests: makes the lane's next submission fail as if the GPU were gone, or the next acquisition of an image as
    // if the window's surface were gone.
    bool lose_at_next_submit = false;
    bool lose_surface_at_next_acquire = false;
    // Calls of the lane's queue, one thread at a time.
    [[nodiscard]] VkResult submit(VkCommandBuffer commands, std::uint64_t serial, std::span<const Moment> after,
                                  const QueueSync& sync);
    [[nodiscard]] VkResult present(const VkPresentInfoKHR& info);
    // Waits for all that was submitted to the queue, presentations too, and by other lanes where they share it.
    void wait_for_queue();
    [[nodiscard]] std::uint64_t completed();
    [[nodiscard]] Result<void> wait_for(std::uint64_t serial);
    // Waits no longer than this; a failure is for wait_for to tell.
    [[nodiscard]] bool completed_within(std::uint64_t serial, std::uint64_t most_ns);

    // Destroys the object when everything submitted so far is done.
    template <typename Handle>
    void retire(VkObjectType type, Handle handle) {
        if (handle != VK_NULL_HANDLE) retire_handle(type, std::bit_cast<std::uint64_t>(handle));
    }
    void retire(CommandSet set, std::uint64_t after_serial);
    void collect();  // destroys retired objects no longer in use; called by each Commands::begin

    [[nodiscard]] Result<CommandSet> take_command_set();

    // Returns the index of the memory type that has all of `required` and most of `preferred`; -1 when there is none.
    [[nodiscard]] int memory_type(std::uint32_t allowed_bits, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags preferred) const;

private:
    Core(std::shared_ptr<SharedDevice> shared, DeviceQueue& queue);
    struct Retired {
        std::uint64_t serial;
        VkObjectType type;
        std::uint64_t handle;
    };
    void retire_handle(VkObjectType type, std::uint64_t handle);
    void destroy(VkObjectType type, std::uint64_t handle);
    void destroy(const CommandSet& set);
    void destroy(const StagingChunk& chunk);
    void free(VkDeviceMemory piece);

    std::shared_ptr<SharedDevice> shared_;
    DeviceQueue& queue_;
    std::unordered_map<VkDeviceMemory, std::uint64_t> own_pieces_;  // bytes of each piece of the device's own memory
    std::vector<Retired> retired_;
    std::vector<std::pair<std::uint64_t, CommandSet>> retired_sets_;
    std::vector<CommandSet> free_sets_;
};

// A move-only owner of one Vulkan object.
template <typename T, VkObjectType Type>
class Handle {
public:
    Handle() = default;
    Handle(std::shared_ptr<Core> core, T object) : core_(std::move(core)), object_(object) {}
    ~Handle() { release(); }
    Handle(Handle&& other) noexcept : core_(std::move(other.core_)), object_(other.object_) {
        other.object_ = VK_NULL_HANDLE;
    }
    Handle& operator=(Handle&& other) noexcept {
        if (this != &other) {
            release();
            core_ = std::move(other.core_);
            object_ = other.object_;
            other.object_ = VK_NULL_HANDLE;
        }
        return *this;
    }

    [[nodiscard]] T raw() const { return object_; }
    [[nodiscard]] const T* pointer() const { return &object_; }
    explicit operator bool() const { return object_ != VK_NULL_HANDLE; }
    // Gives the object up to the caller, who destroys it.
    [[nodiscard]] T give_up() {
        core_.reset();
        return std::exchange(object_, VK_NULL_HANDLE);
    }

private:
    void release() {
        if (core_) core_->retire(Type, object_);
        core_.reset();
    }
    std::shared_ptr<Core> core_;
    T object_ = VK_NULL_HANDLE;
};

using PipelineHandle = Handle<VkPipeline, VK_OBJECT_TYPE_PIPELINE>;
using PipelineLayoutHandle = Handle<VkPipelineLayout, VK_OBJECT_TYPE_PIPELINE_LAYOUT>;
using SetLayoutHandle = Handle<VkDescriptorSetLayout, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT>;
using DescriptorPoolHandle = Handle<VkDescriptorPool, VK_OBJECT_TYPE_DESCRIPTOR_POOL>;
using ShaderHandle = Handle<VkShaderModule, VK_OBJECT_TYPE_SHADER_MODULE>;
using RenderPassHandle = Handle<VkRenderPass, VK_OBJECT_TYPE_RENDER_PASS>;
using FramebufferHandle = Handle<VkFramebuffer, VK_OBJECT_TYPE_FRAMEBUFFER>;
using SamplerHandle = Handle<VkSampler, VK_OBJECT_TYPE_SAMPLER>;
using ImageHandle = Handle<VkImage, VK_OBJECT_TYPE_IMAGE>;
using ImageViewHandle = Handle<VkImageView, VK_OBJECT_TYPE_IMAGE_VIEW>;
using SemaphoreHandle = Handle<VkSemaphore, VK_OBJECT_TYPE_SEMAPHORE>;
using SurfaceHandle = Handle<VkSurfaceKHR, VK_OBJECT_TYPE_SURFACE_KHR>;
using BufferHandle = Handle<VkBuffer, VK_OBJECT_TYPE_BUFFER>;
using MemoryHandle = Handle<VkDeviceMemory, VK_OBJECT_TYPE_DEVICE_MEMORY>;

}  // namespace burin::gpu
