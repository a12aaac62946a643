// SPDX-License-Identifier: MIT
#include "gpu/commands.hpp"

#include "base/try.hpp"

#include <algorithm>
#include <cstring>

namespace burin::gpu {

namespace {

constexpr std::uint64_t kStagingChunk_bytes = 1 << 20;
constexpr std::uint32_t kSetsPerPool = 256;
constexpr std::uint32_t kBuffersPerPool = 8 * kSetsPerPool;

bool inside(const Buffer& buffer, std::uint64_t offset_bytes, std::uint64_t size_bytes) {
    return offset_bytes <= buffer.size_bytes() && size_bytes <= buffer.size_bytes() - offset_bytes;
}

bool same(const VkDescriptorBufferInfo& a, const VkDescriptorBufferInfo& b) {
    return a.buffer == b.buffer && a.offset == b.offset && a.range == b.range;
}

VkMemoryBarrier everything_barrier() {
    auto barrier = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    return barrier;
}

}  // namespace

// ---- Submission

Submission& Submission::operator=(Submission&& other) noexcept {
    if (this != &other) {
        release();
        core_ = std::move(other.core_);
        set_ = std::move(other.set_);
        serial_ = other.serial_;
    }
    return *this;
}

void Submission::release() {
    if (!core_) return;
    core_->retire(std::move(set_), serial_);
    core_.reset();
}

Result<void> Submission::wait() { return core_->wait_for(serial_); }

bool Submission::done() const { return core_->completed() >= serial_; }

bool Submission::done_within(std::uint64_t most_ns) const { return core_->completed_within(serial_, most_ns); }

std::optional<double> Submission::seconds_between(Stamp earlier, Stamp later) const {
    if (set_.stamps == VK_NULL_HANDLE) return std::nullopt;
    std::uint64_t ticks[2] = {0, 0};
    const std::uint32_t indices[2] = {earlier.index, later.index};
    for (int i = 0; i < 2; ++i) {
        const VkResult r = core_->vk.vkGetQueryPoolResults(core_->device, set_.stamps, indices[i], 1, sizeof(ticks[i]),
                                                           &ticks[i], sizeof(ticks[i]), VK_QUERY_RESULT_64_BIT);
        if (r != VK_SUCCESS) return std::nullopt;
    }
    return static_cast<double>(ticks[1] - ticks[0]) * core_->seconds_per_stamp;
}

// ---- Commands

Result<Commands> Commands::begin(Device& device) {
    BURIN_TRY(set, device.core()->take_command_set());
    Commands commands(device.core(), std::move(set));
    auto info = structure<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    Core& core = *commands.core_;
    if (const VkResult r = core.vk.vkBeginCommandBuffer(commands.raw(), &info); r != VK_SUCCESS) {
        return vulkan_failure(core.info.name, "recording could not begin", r);
    }
    commands.barrier();  // orders this work after all writes of earlier submissions
    return commands;
}

Commands::~Commands() {
    if (core_) core_->retire(std::move(set_), core_->submitted);
}

bool Commands::bind(const ComputePipeline& pipeline, std::span<const BufferRange> buffers,
                    std::span<const std::byte> push_constants) {
    const bool matches = pipeline && buffers.size() == pipeline.storage_buffers() &&
                         push_constants.size() == pipeline.push_constant_bytes();
    BURIN_CHECK(matches);
    if (!matches) {
        keep({"buffers or push constants do not match the pipeline", "dispatch", ""});
        return false;
    }
    if (bound_pipeline_ != pipeline.raw()) {
        core_->vk.vkCmdBindPipeline(raw(), VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.raw());
    }
    if (!buffers.empty()) {
        const VkDescriptorSet set = descriptor_set(pipeline, buffers);
        if (first_error_) return false;
        if (set != VK_NULL_HANDLE) {
            core_->vk.vkCmdBindDescriptorSets(raw(), VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.layout(), 0, 1, &set, 0,
                                              nullptr);
        }
    }
    bound_pipeline_ = pipeline.raw();
    if (!push_constants.empty()) {
        core_->vk.vkCmdPushConstants(raw(), pipeline.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                                     static_cast<std::uint32_t>(push_constants.size()), push_constants.data());
    }
    return true;
}

// Returns the set to bind; null when the one bound already holds these buffers.
VkDescriptorSet Commands::descriptor_set(const ComputePipeline& pipeline, std::span<const BufferRange> buffers) {
    std::vector<VkDescriptorBufferInfo> infos;
    infos.reserve(buffers.size());
    for (const BufferRange& range : buffers) {
        BURIN_CHECK(range.buffer != nullptr && range.offset_bytes < range.buffer->size_bytes());
        infos.push_back({range.buffer->raw(), range.offset_bytes, range.size_bytes});
    }
    if (bound_pipeline_ == pipeline.raw() && std::ranges::equal(infos, bound_buffers_, same)) return VK_NULL_HANDLE;
    const VkDescriptorSet set = allocate_set(pipeline.set_layout());
    if (set == VK_NULL_HANDLE) return set;
    bound_buffers_ = std::move(infos);
    auto write = structure<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.dstSet = set;
    write.descriptorCount = static_cast<std::uint32_t>(bound_buffers_.size());
    write.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    write.pBufferInfo = bound_buffers_.data();  // consecutive bindings of one descriptor each: one write fills them all
    core_->vk.vkUpdateDescriptorSets(core_->device, 1, &write, 0, nullptr);
    return set;
}

VkDescriptorSet Commands::allocate_set(VkDescriptorSetLayout layout) {
    Core& c = *core_;
    for (;; ++pool_in_use_) {
        const bool fresh = pool_in_use_ == set_.descriptor_pools.size();
        if (fresh) {
            const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, kBuffersPerPool};
            auto info = structure<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
            info.maxSets = kSetsPerPool;
            info.poolSizeCount = 1;
            info.pPoolSizes = &size;
            VkDescriptorPool pool = VK_NULL_HANDLE;
            if (const VkResult r = c.vk.vkCreateDescriptorPool(c.device, &info, nullptr, &pool); r != VK_SUCCESS) {
                keep(vulkan_failure(c.info.name, "no descriptor pool", r).error());
                return VK_NULL_HANDLE;
            }
            set_.descriptor_pools.push_back(pool);
        }
        auto info = structure<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
        info.descriptorPool = set_.descriptor_pools[pool_in_use_];
        info.descriptorSetCount = 1;
        info.pSetLayouts = &layout;
        VkDescriptorSet set = VK_NULL_HANDLE;
        const VkResult r = c.vk.vkAllocateDescriptorSets(c.device, &info, &set);
        if (r == VK_SUCCESS) return set;
        const bool full = r == VK_ERROR_OUT_OF_POOL_MEMORY || r == VK_ERROR_FRAGMENTED_POOL;
        if (fresh || !full) {
            keep(vulkan_failure(c.info.name, "no descriptor set", r).error());
            return VK_NULL_HANDLE;
        }
    }
}

void Commands::dispatch(const ComputePipeline& pipeline, std::span<const BufferRange> buffers,
                        std::span<const std::byte> push_constants, Groups groups) {
    if (groups.x == 0 || groups.y == 0 || groups.z == 0) return;
    BURIN_CHECK(std::max({groups.x, groups.y, groups.z}) <= core_->capabilities.max_workgroup_count);
    if (bind(pipeline, buffers, push_constants)) core_->vk.vkCmdDispatch(raw(), groups.x, groups.y, groups.z);
}

void Commands::dispatch_indirect(const ComputePipeline& pipeline, std::span<const BufferRange> buffers,
                                 std::span<const std::byte> push_constants, const Buffer& arguments,
                                 std::uint64_t offset_bytes) {
    BURIN_CHECK(inside(arguments, offset_bytes, sizeof(VkDispatchIndirectCommand)));
    if (bind(pipeline, buffers, push_constants)) {
        core_->vk.vkCmdDispatchIndirect(raw(), arguments.raw(), offset_bytes);
    }
}

void Commands::barrier() {
    const VkMemoryBarrier barrier = everything_barrier();
    core_->vk.vkCmdPipelineBarrier(raw(), VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1,
                                   &barrier, 0, nullptr, 0, nullptr);
}

void Commands::copy(const Buffer& from, std::uint64_t from_offset, const Buffer& to, std::uint64_t to_offset,
                    std::uint64_t size_bytes) {
    BURIN_CHECK(inside(from, from_offset, size_bytes) && inside(to, to_offset, size_bytes));
    if (size_bytes == 0) return;
    if (!from.mapped().empty() && to.mapped().empty()) core_->bytes_to_device += size_bytes;
    if (from.mapped().empty() && !to.mapped().empty()) core_->bytes_to_host += size_bytes;
    const VkBufferCopy region{from_offset, to_offset, size_bytes};
    core_->vk.vkCmdCopyBuffer(raw(), from.raw(), to.raw(), 1, &region);
}

void Commands::fill(const Buffer& buffer, std::uint64_t offset_bytes, std::uint64_t size_bytes, std::uint32_t word) {
    BURIN_CHECK(inside(buffer, offset_bytes, size_bytes) && offset_bytes % 4 == 0 && size_bytes % 4 == 0);
    if (size_bytes == 0) return;
    core_->vk.vkCmdFillBuffer(raw(), buffer.raw(), offset_bytes, size_bytes, word);
}

Commands::Staged Commands::stage(std::uint64_t size_bytes) {
    Device device(core_);
    const std::uint64_t chunk_bytes = std::min<std::uint64_t>(kStagingChunk_bytes, core_->max_allocation_bytes);
    if (size_bytes > chunk_bytes) {
        auto large = Buffer::create(device, BufferUse::upload, size_bytes, "staging");
        if (!large) {
            keep(large.error());
            return {};
        }
        large_.push_back(std::move(*large));
        return {large_.back().raw(), 0, large_.back().mapped().data()};
    }
    if (chunks_in_use_ == 0 || chunk_bytes - staging_used_ < size_bytes) {
        if (chunks_in_use_ == set_.staging.size()) {
            auto chunk = Buffer::create(device, BufferUse::upload, chunk_bytes, "staging");
            if (!chunk) {
                keep(chunk.error());
                return {};
            }
            set_.staging.push_back(std::move(*chunk).give_up());
        }
        ++chunks_in_use_;
        staging_used_ = 0;
    }
    const StagingChunk& chunk = set_.staging[chunks_in_use_ - 1];
    constexpr std::uint64_t kAlignment = 16;
    const std::uint64_t offset = staging_used_;
    staging_used_ = std::min(chunk_bytes, (offset + size_bytes + kAlignment - 1) / kAlignment * kAlignment);
    return {chunk.buffer, offset, chunk.mapped.data() + offset};
}

void Commands::upload(const Buffer& to, std::uint64_t offset_bytes, std::span<const std::byte> bytes) {
    BURIN_CHECK(inside(to, offset_bytes, bytes.size()));
    if (bytes.empty() || first_error_) return;
    const Staged staged = stage(bytes.size());
    if (staged.at == nullptr) return;
    std::memcpy(staged.at, bytes.data(), bytes.size());
    if (to.mapped().empty()) core_->bytes_to_device += bytes.size();
    const VkBufferCopy region{staged.offset_bytes, offset_bytes, bytes.size()};
    core_->vk.vkCmdCopyBuffer(raw(), staged.buffer, to.raw(), 1, &region);
}

Stamp Commands::stamp() {
    Core& c = *core_;
    BURIN_CHECK(stamps_ < kMaxStamps);
    if (!c.capabilities.timestamps || stamps_ >= kMaxStamps) return {};
    if (set_.stamps == VK_NULL_HANDLE) {
        auto info = structure<VkQueryPoolCreateInfo>(VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO);
        info.queryType = VK_QUERY_TYPE_TIMESTAMP;
        info.queryCount = kMaxStamps;
        if (const VkResult r = c.vk.vkCreateQueryPool(c.device, &info, nullptr, &set_.stamps); r != VK_SUCCESS) {
            keep(vulkan_failure(c.info.name, "no timestamps", r).error());
            return {};
        }
    }
    c.vk.vkCmdResetQueryPool(raw(), set_.stamps, stamps_, 1);
    c.vk.vkCmdWriteTimestamp(raw(), VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, set_.stamps, stamps_);
    return {stamps_++};
}

Result<Submission> Commands::submit(const QueueSync& sync) && {
    Core& c = *core_;
    // Makes the writes visible to the CPU; the timeline alone makes them visible to the GPU only.
    auto to_host = structure<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    to_host.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    to_host.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    c.vk.vkCmdPipelineBarrier(raw(), VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &to_host, 0,
                              nullptr, 0, nullptr);
    const VkResult ended = c.vk.vkEndCommandBuffer(raw());
    if (first_error_) return std::unexpected(std::move(*first_error_));
    if (ended != VK_SUCCESS) return vulkan_failure(c.info.name, "recording failed", ended);

    const std::uint64_t serial = c.submitted + 1;
    if (const VkResult r = c.submit(set_.commands, serial, moments_, sync); r != VK_SUCCESS) {
        return vulkan_failure(c.info.name, "the work was refused", r);
    }
    c.submitted = serial;
    large_.clear();  // these three are deferred until this submission is done
    kept_.clear();
    kept_objects_.clear();
    for (Moment& moment : moments_) set_.waited_for.push_back(std::move(moment.timeline));
    return Submission(std::move(core_), std::move(set_), serial);
}

// ---- Whole transfers

namespace {

// The most that goes over at once: a solid's store takes up to a gigabyte, which the host need not hold twice.
std::uint64_t piece_bytes(const Device& device) {
    return std::min<std::uint64_t>(std::uint64_t{64} << 20, device.core()->max_allocation_bytes);
}

}  // namespace

Result<void> write(Device& device, const Buffer& to, std::uint64_t offset_bytes, std::span<const std::byte> bytes) {
    const std::uint64_t most = piece_bytes(device);
    for (std::uint64_t done = 0; done < bytes.size(); done += most) {
        BURIN_TRY(commands, Commands::begin(device));
        commands.upload(to, offset_bytes + done, bytes.subspan(done, std::min(most, bytes.size() - done)));
        BURIN_TRY(submission, std::move(commands).submit());
        BURIN_TRY_DO(submission.wait());
    }
    return {};
}

Result<std::vector<std::byte>> read(Device& device, const Buffer& from, std::uint64_t offset_bytes,
                                    std::uint64_t size_bytes) {
    std::vector<std::byte> all;
    if (size_bytes == 0) return all;
    const std::uint64_t most = std::min(piece_bytes(device), size_bytes);
    BURIN_TRY(readback, Buffer::create(device, BufferUse::readback, most, "readback"));
    all.resize(size_bytes);
    for (std::uint64_t done = 0; done < size_bytes; done += most) {
        const std::uint64_t piece = std::min(most, size_bytes - done);
        BURIN_TRY(commands, Commands::begin(device));
        commands.copy(from, offset_bytes + done, readback, 0, piece);
        BURIN_TRY(submission, std::move(commands).submit());
        BURIN_TRY_DO(submission.wait());
        std::memcpy(all.data() + done, readback.mapped().data(), piece);
    }
    return all;
}

}  // namespace burin::gpu
