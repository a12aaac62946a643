// SPDX-License-Identifier: MIT
// Recording and submitting GPU work.
//
//   auto commands = Commands::begin(device);            // Result<Commands>
//   commands->upload(positions, 0, bytes);                   // through staging memory that is used again
//   commands->barrier();
//   commands->dispatch(cut, {rays, strokes}, gpu::bytes_of(parameters), {groups, 1, 1});
//   commands->barrier();
//   commands->copy(rays, 0, readback, 0, rays.size_bytes());
//   auto submission = std::move(*commands).submit();         // Result<Submission>
//   auto done = submission->wait();                          // then readback.mapped() holds the result
//
// No ordering is implicit: a barrier() belongs between two commands of which the second reads or overwrites what the
// first wrote. Each submission starts after those before it in its lane have finished all their writes, and the CPU's
// writes to mapped buffers before submit() are visible to it; its own writes are visible to the CPU after wait().
// Between lanes there is no order but what wait_for() makes: a submission of one lane that reads a buffer which another
// lane's submission writes waits for the Moment of that one, and then sees its writes. The buffer's lane must neither
// write nor destroy it until the reader is done.
// Failure: recording functions return nothing; the first failure among them (memory for staging or descriptors) is kept
// and returned by submit(), which then submits nothing. Using buffers beyond their end breaks a contract (BURIN_CHECK).
// Lifetime: pipelines and buffers named in a command must live until submit(); after that they may be destroyed at any
// time.
// Thread: as Device. Cost: 10-30 us a submission, below 1 us a dispatch on the CPU side.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gpu/buffer.hpp"
#include "gpu/pipelines.hpp"

namespace burin::gpu {

struct Groups {
    std::uint32_t x = 1, y = 1, z = 1;  // each at most capabilities().max_workgroup_count
};

struct Stamp {
    std::uint32_t index = 0;
};

// Binary semaphores around one submission, as a window system asks for them (gpu/swapchain.hpp). Null: none.
struct QueueSync {
    VkSemaphore wait = VK_NULL_HANDLE;    // before the submission writes a colour attachment
    VkSemaphore signal = VK_NULL_HANDLE;  // when all of it is done
};

// The end of a submission, for the commands of another lane of the device that go on from there (Commands::wait_for). A
// plain value, which may be handed to another thread. It keeps the timeline and nothing else of its lane.
struct Moment {
    std::shared_ptr<const Timeline> timeline;
    std::uint64_t serial = 0;
};

// Work handed to the GPU. Destroying the Submission does not wait; its resources are reused when the GPU no longer uses
// them.
class Submission {
public:
    Submission(Submission&&) noexcept = default;
    Submission& operator=(Submission&& other) noexcept;
    ~Submission() { release(); }

    // Blocks until the work is done; returns an Error after 120 s or when the device is lost.
    [[nodiscard]] Result<void> wait();
    [[nodiscard]] bool done() const;
    // Waits until the work is done, but no longer than this; returns whether it is. A lost device is done with it.
    [[nodiscard]] bool done_within(std::uint64_t most_ns) const;
    [[nodiscard]] Moment moment() const { return {core_->timeline, serial_}; }
    // Returns the GPU time between two stamps, after wait(); nothing where capabilities().timestamps is false.
    [[nodiscard]] std::optional<double> seconds_between(Stamp earlier, Stamp later) const;

private:
    friend class Commands;
    Submission(std::shared_ptr<Core> core, CommandSet set, std::uint64_t serial)
        : core_(std::move(core)), set_(std::move(set)), serial_(serial) {}
    void release();

    std::shared_ptr<Core> core_;
    CommandSet set_;
    std::uint64_t serial_ = 0;
};

class Commands {
public:
    static constexpr std::uint32_t kMaxStamps = 64;

    [[nodiscard]] static Result<Commands> begin(Device& device);
    Commands(Commands&&) noexcept = default;
    Commands& operator=(Commands&&) = delete;
    ~Commands();  // discards the commands if they were not submitted

    // Dispatches a compute shader. Requires as many buffers as the pipeline has bindings, and exactly its push
    // constants. A dispatch of zero groups does nothing.
    void dispatch(const ComputePipeline& pipeline, std::initializer_list<BufferRange> buffers,
                  std::span<const std::byte> push_constants, Groups groups) {
        dispatch(pipeline, std::span(buffers.begin(), buffers.size()), push_constants, groups);
    }
    void dispatch(const ComputePipeline& pipeline, std::span<const BufferRange> buffers,
                  std::span<const std::byte> push_constants, Groups groups);
    // Dispatches with the three group counts that the GPU reads from `arguments` (a device_storage buffer) on
    // execution.
    void dispatch_indirect(const ComputePipeline& pipeline, std::span<const BufferRange> buffers,
                           std::span<const std::byte> push_constants, const Buffer& arguments,
                           std::uint64_t offset_bytes);
    // Makes all earlier writes, of any kind, visible to all later reads and writes.
    void barrier();
    void copy(const Buffer& from, std::uint64_t from_offset, const Buffer& to, std::uint64_t to_offset,
              std::uint64_t size_bytes);
    // Fills with a 32-bit word; offset and size are multiples of 4.
    void fill(const Buffer& buffer, std::uint64_t offset_bytes, std::uint64_t size_bytes, std::uint32_t word);
    void upload(const Buffer& to, std::uint64_t offset_bytes, std::span<const std::byte> bytes);
    // Keeps the buffer alive until this work is done; for one that is replaced while recording.
    void keep_alive(Buffer buffer) { kept_.push_back(std::move(buffer)); }
    // Keeps any other object made for this work alone (a framebuffer, a descriptor pool) alive until it is done.
    template <typename T, VkObjectType Type>
    void keep_alive(Handle<T, Type> object) {
        kept_objects_.push_back(std::make_shared<Handle<T, Type>>(std::move(object)));
    }
    // Has all of this work begin after a moment of another lane of the device, without a wait of the CPU.
    void wait_for(Moment moment) { moments_.push_back(std::move(moment)); }
    // Records the GPU's time when all commands before it are done. At most kMaxStamps in one Commands.
    Stamp stamp();

    // Submits the work. After VK_ERROR_DEVICE_LOST device().core()->lost is set and every later submission fails too.
    [[nodiscard]] Result<Submission> submit(const QueueSync& sync = {}) &&;

    // Returns the command buffer, for code that records Vulkan commands of its own.
    [[nodiscard]] VkCommandBuffer raw() const { return set_.commands; }

private:
    Commands(std::shared_ptr<Core> core, CommandSet set) : core_(std::move(core)), set_(std::move(set)) {}
    // Room for bytes that the CPU writes and this work copies from; null where there is none (first_error_).
    struct Staged {
        VkBuffer buffer = VK_NULL_HANDLE;
        std::uint64_t offset_bytes = 0;
        std::byte* at = nullptr;
    };
    [[nodiscard]] Staged stage(std::uint64_t size_bytes);
    [[nodiscard]] bool bind(const ComputePipeline& pipeline, std::span<const BufferRange> buffers,
                            std::span<const std::byte> push_constants);
    [[nodiscard]] VkDescriptorSet descriptor_set(const ComputePipeline& pipeline, std::span<const BufferRange> buffers);
    [[nodiscard]] VkDescriptorSet allocate_set(VkDescriptorSetLayout layout);
    void keep(Error error) {
        if (!first_error_) first_error_ = std::move(error);
    }

    std::shared_ptr<Core> core_;  // empty once moved from or submitted
    CommandSet set_;
    std::vector<Buffer> large_;  // staging of more than a chunk
    std::vector<Buffer> kept_;
    std::vector<std::shared_ptr<void>> kept_objects_;
    std::vector<Moment> moments_;     // after which this work begins
    std::size_t chunks_in_use_ = 0;   // of set_.staging
    std::uint64_t staging_used_ = 0;  // bytes of the last of them
    std::size_t pool_in_use_ = 0;     // index into set_.descriptor_pools
    std::uint32_t stamps_ = 0;
    std::optional<Error> first_error_;
    // The descriptor set bound last: following dispatches with the same buffers reuse it.
    VkPipeline bound_pipeline_ = VK_NULL_HANDLE;
    std::vector<VkDescriptorBufferInfo> bound_buffers_;
};

// Upload and wait; read back and wait. For tests, start-up and shutdown; a frame or an update records its own commands.
[[nodiscard]] Result<void> write(Device& device, const Buffer& to, std::uint64_t offset_bytes,
                                 std::span<const std::byte> bytes);
[[nodiscard]] Result<std::vector<std::byte>> read(Device& device, const Buffer& from, std::uint64_t offset_bytes,
                                                  std::uint64_t size_bytes);

}  // namespace burin::gpu
