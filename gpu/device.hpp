// SPDX-License-Identifier: MIT
// The Vulkan device on which the compute engine and the renderer are built. Touches no window system unless the caller
// names a window system's extensions (DeviceOptions::instance_extensions).
//
// Data flow: list_devices() lists the machine's devices; Device::create() picks one and opens it; buffers, images and
// pipelines are created on it; work is recorded into Commands (commands.hpp), submitted, and waited for.
//
// Lanes: a Device is a handle of one lane of an opened device, and copies of it are handles of the same lane. lane()
// opens another one. All lanes have the device's features, limits and loss in common; each has its own submissions, in
// their own order, its own counts (asked()), and its own objects: what is created with one lane is used in its commands
// alone and destroyed in it. Work of one lane begins without regard to that of another, unless it waits for it
// (Commands::wait_for).
// Lifetime: every object keeps its lane alive, and so the device; the order of destruction is free. A destroyed object
// that the GPU may still be using is freed when the submissions that its lane has made so far are done (deferred
// destruction).
// Thread: a lane and all its objects belong to one thread at a time, different lanes of a device to different threads
// at once. A session opens one device: one thread draws with its first lane, another carves with a second, which has a
// queue of its own where the device offers two. Different devices may be opened (30-75 ms with a software driver) and
// used by different threads at once.
// Failure: no loader, no driver, no device, out of memory: Error, with the remedy. Wrong use: BURIN_CHECK.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace burin::gpu {

class Core;  // core.hpp; only files that record Vulkan commands of their own need it

enum class DeviceKind { discrete, integrated, virtual_machine, software, other };

// One Vulkan device as `burin --version` lists it.
struct DeviceInfo {
    unsigned index = 0;  // for DeviceOptions::index
    std::string name;    // "llvmpipe (LLVM 15.0.6, 256 bits)"
    DeviceKind kind = DeviceKind::other;
    std::string driver;    // "llvmpipe Mesa 22.3.6"
    std::string api;       // "1.3.230"
    std::string unusable;  // empty, or the reason why Burin cannot use it

    [[nodiscard]] bool is_software() const { return kind == DeviceKind::software; }
    [[nodiscard]] std::string line() const;  // "0: name (software, driver, Vulkan 1.3.230)"
};

// Features and limits of the opened device. Every feature listed as true has been enabled.
struct Capabilities {
    bool shader_int64 = false;
    bool shader_float64 = false;
    bool shader_int16 = false;
    bool shader_int8 = false;
    bool storage_16bit = false;         // 16-bit members in storage buffers
    bool storage_8bit = false;          // 8-bit members in storage buffers
    bool buffer_int64_atomics = false;  // atomicAdd etc. on uint64_t in storage buffers
    bool scalar_block_layout = false;   // GL_EXT_scalar_block_layout
    bool buffer_address = false;        // shaders reach buffers by address (GL_EXT_buffer_reference)
    bool sampler_anisotropy = false;
    bool timestamps = false;
    bool swapchain = false;        // can present to windows; only when instance_extensions asked for surfaces
    bool display_control = false;  // can count a display's refreshes (VK_EXT_display_control)
    bool present_wait = false;    // reports when an image is on the display (VK_KHR_present_id and VK_KHR_present_wait)
    bool unified_memory = false;  // device_storage buffers are mapped: Buffer::mapped() is not empty
    bool display_stereo = false;  // supports a display's own stereo (VK_NV_display_stereo)
    std::uint32_t subgroup_size = 0;
    std::uint32_t msaa_samples = 1;  // 4 where colour and depth both allow it
    std::uint64_t max_storage_buffer_bytes = 0;
    std::uint64_t storage_offset_alignment = 1;  // BufferRange::offset_bytes must be a multiple of it
    std::uint32_t max_push_constant_bytes = 0;
    std::uint32_t max_workgroup_invocations = 0;
    std::uint32_t max_workgroup_count = 0;  // the smallest of the three axes
    std::uint32_t max_image_size = 0;       // width and height of a 2D image
};

// Counts the work of a lane since it was opened, and its memory. Nothing is copied where the host sees that.
struct WorkAsked {
    std::uint64_t submissions = 0;
    std::uint64_t blocking_waits = 0;  // for work that no wait before had covered
    std::uint64_t bytes_to_device = 0, bytes_to_host = 0;
    std::uint64_t most_memory_bytes = 0;  // of the device's own memory, held by the lane at once
    std::uint64_t bytes_written_to_host = 0;      // by shaders, into the host's memory, without a copy
};

enum class Prefer { hardware, software };  // a preference: where there is only the other kind, it is taken

struct DeviceOptions {
    Prefer prefer = Prefer::hardware;
    std::optional<unsigned> index = {};  // exactly this device of list_devices()
    // Runs the Khronos validation layer with synchronisation validation; an Error where it is not installed.
    // BURIN_VULKAN_VALIDATION=1 turns it on too.
    bool validation = false;
    // Required instance extensions, such as those of required_extensions(); an Error names a missing one. With
    // VK_KHR_surface among them the swapchain extension is enabled where the device has it.
    std::vector<std::string> instance_extensions = {};
    // Extensions enabled where they exist, such as direct_display_optional_extensions().
    std::vector<std::string> optional_instance_extensions = {};
};

// Lists every Vulkan device of this machine, usable or not; an Error when there is no loader or no driver. Cost: 30-75
// ms.
[[nodiscard]] Result<std::vector<DeviceInfo>> list_devices();

class Device {
public:
    // Opens a device, and its first lane.
    [[nodiscard]] static Result<Device> create(const DeviceOptions& options = {});
    // Opens another lane of the same device, for this thread or another. Any thread, while this handle is there. Fails
    // on a device that is lost, or has no memory left.
    [[nodiscard]] Result<Device> lane() const;

    [[nodiscard]] const DeviceInfo& info() const;
    [[nodiscard]] const Capabilities& capabilities() const;
    [[nodiscard]] const std::shared_ptr<Core>& core() const { return core_; }

    [[nodiscard]] WorkAsked asked() const;  // of this lane
    // Returns how much of the device's own memory all of its lanes hold. Any thread.
    [[nodiscard]] std::uint64_t memory_bytes() const;

    // Waits for everything that the lane has submitted, and frees objects whose destruction was deferred.
    Result<void> wait_idle();
    // Tells whether the driver has reported the GPU as lost, to any lane: all objects of this device are then useless,
    // and a new Device must be opened. Any thread.
    [[nodiscard]] bool lost() const;

    explicit Device(std::shared_ptr<Core> core) : core_(std::move(core)) {}  // another handle of a lane

private:
    std::shared_ptr<Core> core_;
};

// Returns the number of warnings and errors that the validation layer has reported since the start of the process, over
// all devices. Tests assert that it stays 0; each message also goes to standard error. Any thread.
[[nodiscard]] std::uint64_t validation_messages() noexcept;

}  // namespace burin::gpu
