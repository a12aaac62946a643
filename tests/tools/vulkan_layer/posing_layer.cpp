// SPDX-License-Identifier: MIT
// A Vulkan layer for tests: it makes the software device pose as a card, or as one that lacks something, has little
// memory or is lost, and counts what a program asks of each device. Loaded by the Vulkan loader where the environment
// names it (tests/support/posing_device.hpp):
//   BURIN_POSE_CARD=1             a discrete device: memory type 0 is its own and cannot be mapped, type 1 the host's
//   BURIN_POSE_QUEUES=2           a device with two queues in each family, which are both its only one
//   BURIN_POSE_HIDE=WORD,...      float64, int64, address, scalar: features that it does not have
//   BURIN_POSE_DEVICE_BYTES=N     most memory of its own held at once; beyond, VK_ERROR_OUT_OF_DEVICE_MEMORY
//   BURIN_POSE_HOST_BYTES=N       the same for the host's, VK_ERROR_OUT_OF_HOST_MEMORY
//   BURIN_POSE_LOSE_SUBMIT=N      the Nth submission that dispatches a shader is lost, and all that comes after
//   BURIN_POSE_LOSE_WAIT=N        the Nth wait of a device that has dispatched one, likewise
//   BURIN_POSE_LOSE_DEVICES=N     only the first N devices that are opened are lost; without it all of them
//   BURIN_POSE_COUNTS=FILE        a line of JSON for each device, as it is destroyed
// Threads: any; one lock.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

namespace {

std::uint64_t number_in(const char* name) {
    const char* text = std::getenv(name);
    return text != nullptr && *text != '\0' ? std::strtoull(text, nullptr, 10) : 0;
}

bool is_hidden(const char* feature) {
    const char* text = std::getenv("BURIN_POSE_HIDE");
    return text != nullptr && ("," + std::string(text) + ",").contains("," + std::string(feature) + ",");
}

const bool kPosesAsCard = number_in("BURIN_POSE_CARD") != 0;
const auto kPosedQueues = static_cast<std::uint32_t>(number_in("BURIN_POSE_QUEUES"));  // 0: as many as there are

struct Allocation {
    bool is_devices = true;
    VkDeviceSize bytes = 0;
};

// What a device was asked for, and whether it is lost. Its functions are those of the next layer.
struct DeviceState {
    PFN_vkGetDeviceProcAddr get = nullptr;
    std::map<std::string_view, PFN_vkVoidFunction> next;
    std::unordered_map<VkDeviceMemory, Allocation> memory;
    std::unordered_map<VkBuffer, bool> is_devices_buffer;
    struct Recorded {
        std::uint64_t dispatches = 0, to_device_bytes = 0, to_host_bytes = 0;
    };
    std::unordered_map<VkCommandBuffer, Recorded> recorded;
    VkDevice device = VK_NULL_HANDLE;
    std::uint64_t submissions = 0, dispatching = 0, dispatches = 0, waits = 0, blocking = 0;
    std::uint64_t second_queue = 0;  // how often it was asked for
    std::uint64_t to_device_bytes = 0, to_host_bytes = 0;
    VkDeviceSize devices_bytes = 0, hosts_bytes = 0, most_devices_bytes = 0;
    bool is_lost = false;
    bool may_be_lost = true;
};

std::recursive_mutex g_mutex;
PFN_vkGetInstanceProcAddr g_next_of_instance = nullptr;
VkInstance g_instance = VK_NULL_HANDLE;
// Asked for as the instance is made: asked later, another layer in between may answer with this one's own.
std::map<std::string_view, PFN_vkVoidFunction> g_next_in_instance;
std::map<void*, std::unique_ptr<DeviceState>> g_devices;  // by the loader's dispatch table
std::uint64_t g_opened = 0;                               // devices so far

// Device, queue and command buffer begin with a pointer to the table of their device.
template <typename Handle>
DeviceState& state_of(Handle handle) {
    return *g_devices.at(*reinterpret_cast<void**>(handle));
}

template <typename Function>
Function next_in(DeviceState& state, VkDevice device, const char* name) {
    PFN_vkVoidFunction& known = state.next[name];
    if (known == nullptr && device != VK_NULL_HANDLE) known = state.get(device, name);
    return reinterpret_cast<Function>(known);
}

template <typename Function>
Function next_in_instance(const char* name) {
    return reinterpret_cast<Function>(g_next_in_instance.at(name));
}

using Lock = std::lock_guard<std::recursive_mutex>;

// What is under way is finished first, so that nothing is freed under the device's hands.
VkResult lose(DeviceState& state) {
    state.is_lost = true;
    next_in<PFN_vkDeviceWaitIdle>(state, state.device, "vkDeviceWaitIdle")(state.device);
    return VK_ERROR_DEVICE_LOST;
}

// ---- Instance and what a device says of itself

VKAPI_ATTR VkResult VKAPI_CALL create_instance(const VkInstanceCreateInfo* info, const VkAllocationCallbacks* allocator,
                                               VkInstance* instance) {
    auto* link = const_cast<VkLayerInstanceCreateInfo*>(static_cast<const VkLayerInstanceCreateInfo*>(info->pNext));
    while (link != nullptr &&
           !(link->sType == VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO && link->function == VK_LAYER_LINK_INFO))
        link = const_cast<VkLayerInstanceCreateInfo*>(static_cast<const VkLayerInstanceCreateInfo*>(link->pNext));
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr next = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateInstance>(next(VK_NULL_HANDLE, "vkCreateInstance"));
    const VkResult result = create(info, allocator, instance);
    const Lock lock(g_mutex);
    if (result != VK_SUCCESS) return result;
    g_next_of_instance = next;
    g_instance = *instance;
    for (const char* name :
         {"vkGetPhysicalDeviceProperties", "vkGetPhysicalDeviceProperties2", "vkGetPhysicalDeviceFeatures2",
          "vkGetPhysicalDeviceMemoryProperties", "vkGetPhysicalDeviceQueueFamilyProperties"})
        g_next_in_instance[name] = next(*instance, name);
    return result;
}

VKAPI_ATTR void VKAPI_CALL get_properties(VkPhysicalDevice device, VkPhysicalDeviceProperties* properties) {
    next_in_instance<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties")(device, properties);
    if (kPosesAsCard) properties->deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
}

VKAPI_ATTR void VKAPI_CALL get_properties_2(VkPhysicalDevice device, VkPhysicalDeviceProperties2* properties) {
    next_in_instance<PFN_vkGetPhysicalDeviceProperties2>("vkGetPhysicalDeviceProperties2")(device, properties);
    if (kPosesAsCard) properties->properties.deviceType = VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU;
}

VKAPI_ATTR void VKAPI_CALL get_features_2(VkPhysicalDevice device, VkPhysicalDeviceFeatures2* features) {
    next_in_instance<PFN_vkGetPhysicalDeviceFeatures2>("vkGetPhysicalDeviceFeatures2")(device, features);
    if (is_hidden("float64")) features->features.shaderFloat64 = VK_FALSE;
    if (is_hidden("int64")) features->features.shaderInt64 = VK_FALSE;
    for (auto* more = static_cast<VkBaseOutStructure*>(features->pNext); more != nullptr; more = more->pNext) {
        if (more->sType != VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES) continue;
        auto* newer = reinterpret_cast<VkPhysicalDeviceVulkan12Features*>(more);
        if (is_hidden("address")) newer->bufferDeviceAddress = VK_FALSE;
        if (is_hidden("scalar")) newer->scalarBlockLayout = VK_FALSE;
    }
}

VKAPI_ATTR void VKAPI_CALL get_queue_families(VkPhysicalDevice device, std::uint32_t* count,
                                              VkQueueFamilyProperties* families) {
    next_in_instance<PFN_vkGetPhysicalDeviceQueueFamilyProperties>("vkGetPhysicalDeviceQueueFamilyProperties")(
        device, count, families);
    for (std::uint32_t i = 0; kPosedQueues > 0 && families != nullptr && i < *count; ++i)
        families[i].queueCount = kPosedQueues;
}

VKAPI_ATTR void VKAPI_CALL get_memory_properties(VkPhysicalDevice device,
                                                 VkPhysicalDeviceMemoryProperties* properties) {
    next_in_instance<PFN_vkGetPhysicalDeviceMemoryProperties>("vkGetPhysicalDeviceMemoryProperties")(device,
                                                                                                     properties);
    if (!kPosesAsCard) return;
    const VkDeviceSize all = properties->memoryHeaps[0].size;
    const std::uint64_t limit = number_in("BURIN_POSE_DEVICE_BYTES");
    *properties = {};
    properties->memoryHeapCount = properties->memoryTypeCount = 2;
    properties->memoryHeaps[0] = {limit > 0 ? limit : all, VK_MEMORY_HEAP_DEVICE_LOCAL_BIT};
    properties->memoryHeaps[1] = {all, 0};
    properties->memoryTypes[0] = {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
    properties->memoryTypes[1] = {
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT | VK_MEMORY_PROPERTY_HOST_CACHED_BIT,
        1};
}

// ---- Device

VKAPI_ATTR VkResult VKAPI_CALL create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo* info,
                                             const VkAllocationCallbacks* allocator, VkDevice* device) {
    auto* link = const_cast<VkLayerDeviceCreateInfo*>(static_cast<const VkLayerDeviceCreateInfo*>(info->pNext));
    while (link != nullptr &&
           !(link->sType == VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO && link->function == VK_LAYER_LINK_INFO))
        link = const_cast<VkLayerDeviceCreateInfo*>(static_cast<const VkLayerDeviceCreateInfo*>(link->pNext));
    if (link == nullptr) return VK_ERROR_INITIALIZATION_FAILED;
    const PFN_vkGetInstanceProcAddr of_instance = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
    const PFN_vkGetDeviceProcAddr of_device = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
    link->u.pLayerInfo = link->u.pLayerInfo->pNext;
    const auto create = reinterpret_cast<PFN_vkCreateDevice>(of_instance(g_instance, "vkCreateDevice"));
    VkDeviceQueueCreateInfo queue = *info->pQueueCreateInfos;
    VkDeviceCreateInfo asked = *info;
    if (kPosedQueues > 0) queue.queueCount = 1;
    asked.pQueueCreateInfos = &queue;  // of one family, as Burin asks
    const VkResult result = create(physical, &asked, allocator, device);
    if (result != VK_SUCCESS) return result;
    const Lock lock(g_mutex);
    auto state = std::make_unique<DeviceState>();
    state->get = of_device;
    state->device = *device;
    const std::uint64_t to_lose = number_in("BURIN_POSE_LOSE_DEVICES");
    state->may_be_lost = ++g_opened <= to_lose || to_lose == 0;
    for (const char* name : {"vkQueueSubmit", "vkQueueWaitIdle", "vkBeginCommandBuffer", "vkCmdDispatch",
                             "vkCmdDispatchIndirect", "vkCmdCopyBuffer"})
        state->next[name] = of_device(*device, name);
    g_devices[*reinterpret_cast<void**>(*device)] = std::move(state);
    return result;
}

VKAPI_ATTR void VKAPI_CALL destroy_device(VkDevice device, const VkAllocationCallbacks* allocator) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(device);
    const auto destroy = next_in<PFN_vkDestroyDevice>(state, device, "vkDestroyDevice");
    void* const table = *reinterpret_cast<void**>(device);
    if (const char* path = std::getenv("BURIN_POSE_COUNTS"); path != nullptr) {
        if (std::FILE* file = std::fopen(path, "a"); file != nullptr) {
            std::fprintf(
                file,
                "{\"submissions\": %ju, \"dispatching_submissions\": %ju, \"dispatches\": %ju, \"waits\": %ju, "
                "\"blocking_waits\": %ju, \"bytes_to_device\": %ju, \"bytes_to_host\": %ju, "
                "\"most_device_bytes\": %ju, \"queues\": %ju, \"lost\": %s}\n",
                std::uintmax_t{state.submissions}, std::uintmax_t{state.dispatching}, std::uintmax_t{state.dispatches},
                std::uintmax_t{state.waits}, std::uintmax_t{state.blocking}, std::uintmax_t{state.to_device_bytes},
                std::uintmax_t{state.to_host_bytes}, std::uintmax_t{state.most_devices_bytes},
                std::uintmax_t{1 + state.second_queue}, state.is_lost ? "true" : "false");
            std::fclose(file);
        }
    }
    g_devices.erase(table);
    destroy(device, allocator);
}

VKAPI_ATTR void VKAPI_CALL get_queue(VkDevice device, std::uint32_t family, std::uint32_t index, VkQueue* queue) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(device);
    if (index > 0) ++state.second_queue;
    next_in<PFN_vkGetDeviceQueue>(state, device, "vkGetDeviceQueue")(device, family, kPosedQueues > 0 ? 0 : index,
                                                                     queue);
}

VKAPI_ATTR VkResult VKAPI_CALL allocate_memory(VkDevice device, const VkMemoryAllocateInfo* info,
                                               const VkAllocationCallbacks* allocator, VkDeviceMemory* memory) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(device);
    VkMemoryAllocateInfo asked = *info;
    const bool is_devices = !kPosesAsCard || info->memoryTypeIndex == 0;
    if (kPosesAsCard) asked.memoryTypeIndex = 0;  // the software device has but this one
    const std::uint64_t limit = number_in(is_devices ? "BURIN_POSE_DEVICE_BYTES" : "BURIN_POSE_HOST_BYTES");
    VkDeviceSize& held = is_devices ? state.devices_bytes : state.hosts_bytes;
    if (limit > 0 && held + info->allocationSize > limit)
        return is_devices ? VK_ERROR_OUT_OF_DEVICE_MEMORY : VK_ERROR_OUT_OF_HOST_MEMORY;
    const VkResult result =
        next_in<PFN_vkAllocateMemory>(state, device, "vkAllocateMemory")(device, &asked, allocator, memory);
    if (result != VK_SUCCESS) return result;
    held += info->allocationSize;
    state.memory[*memory] = {is_devices, info->allocationSize};
    state.most_devices_bytes =
        state.most_devices_bytes > state.devices_bytes ? state.most_devices_bytes : state.devices_bytes;
    return result;
}

VKAPI_ATTR void VKAPI_CALL free_memory(VkDevice device, VkDeviceMemory memory, const VkAllocationCallbacks* allocator) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(device);
    if (const auto at = state.memory.find(memory); at != state.memory.end()) {
        (at->second.is_devices ? state.devices_bytes : state.hosts_bytes) -= at->second.bytes;
        state.memory.erase(at);
    }
    next_in<PFN_vkFreeMemory>(state, device, "vkFreeMemory")(device, memory, allocator);
}

VKAPI_ATTR void VKAPI_CALL get_buffer_requirements(VkDevice device, VkBuffer buffer, VkMemoryRequirements* needs) {
    const Lock lock(g_mutex);
    next_in<PFN_vkGetBufferMemoryRequirements>(state_of(device), device, "vkGetBufferMemoryRequirements")(
        device, buffer, needs);
    if (kPosesAsCard) needs->memoryTypeBits = 3;
}

VKAPI_ATTR void VKAPI_CALL get_image_requirements(VkDevice device, VkImage image, VkMemoryRequirements* needs) {
    const Lock lock(g_mutex);
    next_in<PFN_vkGetImageMemoryRequirements>(state_of(device), device, "vkGetImageMemoryRequirements")(device, image,
                                                                                                        needs);
    if (kPosesAsCard) needs->memoryTypeBits = 3;
}

VKAPI_ATTR VkResult VKAPI_CALL bind_buffer(VkDevice device, VkBuffer buffer, VkDeviceMemory memory,
                                           VkDeviceSize offset) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(device);
    state.is_devices_buffer[buffer] = state.memory[memory].is_devices;
    return next_in<PFN_vkBindBufferMemory>(state, device, "vkBindBufferMemory")(device, buffer, memory, offset);
}

// ---- Commands

VKAPI_ATTR VkResult VKAPI_CALL begin_commands(VkCommandBuffer commands, const VkCommandBufferBeginInfo* info) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(commands);
    state.recorded[commands] = {};
    return next_in<PFN_vkBeginCommandBuffer>(state, VK_NULL_HANDLE, "vkBeginCommandBuffer")(commands, info);
}

VKAPI_ATTR void VKAPI_CALL dispatch(VkCommandBuffer commands, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(commands);
    ++state.recorded[commands].dispatches;
    next_in<PFN_vkCmdDispatch>(state, VK_NULL_HANDLE, "vkCmdDispatch")(commands, x, y, z);
}

VKAPI_ATTR void VKAPI_CALL dispatch_indirect(VkCommandBuffer commands, VkBuffer groups, VkDeviceSize offset) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(commands);
    ++state.recorded[commands].dispatches;
    next_in<PFN_vkCmdDispatchIndirect>(state, VK_NULL_HANDLE, "vkCmdDispatchIndirect")(commands, groups, offset);
}

VKAPI_ATTR void VKAPI_CALL copy_buffer(VkCommandBuffer commands, VkBuffer from, VkBuffer to, std::uint32_t count,
                                       const VkBufferCopy* regions) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(commands);
    DeviceState::Recorded& recorded = state.recorded[commands];
    const bool from_device = state.is_devices_buffer[from], to_device = state.is_devices_buffer[to];
    for (std::uint32_t i = 0; i < count; ++i) {
        if (from_device && !to_device) recorded.to_host_bytes += regions[i].size;
        if (!from_device && to_device) recorded.to_device_bytes += regions[i].size;
    }
    next_in<PFN_vkCmdCopyBuffer>(state, VK_NULL_HANDLE, "vkCmdCopyBuffer")(commands, from, to, count, regions);
}

VKAPI_ATTR VkResult VKAPI_CALL queue_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo* submits,
                                            VkFence fence) {
    const Lock lock(g_mutex);
    DeviceState& state = state_of(queue);
    if (state.is_lost) return VK_ERROR_DEVICE_LOST;
    ++state.submissions;
    std::uint64_t dispatches = 0;
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t k = 0; k < submits[i].commandBufferCount; ++k) {
            const DeviceState::Recorded& recorded = state.recorded[submits[i].pCommandBuffers[k]];
            dispatches += recorded.dispatches;
            state.to_device_bytes += recorded.to_device_bytes;
            state.to_host_bytes += recorded.to_host_bytes;
        }
    state.dispatches += dispatches;
    if (dispatches > 0) ++state.dispatching;
    const std::uint64_t lost_at = number_in("BURIN_POSE_LOSE_SUBMIT");
    if (lost_at > 0 && state.may_be_lost && state.dispatching >= lost_at) return lose(state);
    return next_in<PFN_vkQueueSubmit>(state, VK_NULL_HANDLE, "vkQueueSubmit")(queue, count, submits, fence);
}

VKAPI_ATTR VkResult VKAPI_CALL queue_wait_idle(VkQueue queue) {
    const Lock lock(g_mutex);  // of both queues, which are one
    return next_in<PFN_vkQueueWaitIdle>(state_of(queue), VK_NULL_HANDLE, "vkQueueWaitIdle")(queue);
}

VKAPI_ATTR VkResult VKAPI_CALL wait_semaphores(VkDevice device, const VkSemaphoreWaitInfo* info,
                                               std::uint64_t most_ns) {
    PFN_vkWaitSemaphores wait = nullptr;
    {
        const Lock lock(g_mutex);
        DeviceState& state = state_of(device);
        wait = next_in<PFN_vkWaitSemaphores>(state, device, "vkWaitSemaphores");
        std::uint64_t done = 0;
        next_in<PFN_vkGetSemaphoreCounterValue>(state, device, "vkGetSemaphoreCounterValue")(
            device, info->pSemaphores[0], &done);
        ++state.waits;
        if (done < info->pValues[0]) ++state.blocking;
        const std::uint64_t lost_at = number_in("BURIN_POSE_LOSE_WAIT");
        const bool loses = lost_at > 0 && state.may_be_lost && state.dispatching > 0 && state.waits >= lost_at;
        if (state.is_lost || loses) return lose(state);
    }
    return wait(device, info, most_ns);
}

// ---- The loader's questions

struct Named {
    std::string_view name;
    PFN_vkVoidFunction function;
};

template <typename Function>
PFN_vkVoidFunction as_void(Function function) {
    return reinterpret_cast<PFN_vkVoidFunction>(function);
}

PFN_vkVoidFunction found_in(std::span<const Named> all, std::string_view name) {
    const auto at = std::ranges::find(all, name, &Named::name);
    return at != all.end() ? at->function : nullptr;
}

PFN_vkVoidFunction own_of_device(std::string_view name) {
    const Named all[] = {{"vkDestroyDevice", as_void(destroy_device)},
                         {"vkAllocateMemory", as_void(allocate_memory)},
                         {"vkFreeMemory", as_void(free_memory)},
                         {"vkGetBufferMemoryRequirements", as_void(get_buffer_requirements)},
                         {"vkGetImageMemoryRequirements", as_void(get_image_requirements)},
                         {"vkBindBufferMemory", as_void(bind_buffer)},
                         {"vkBeginCommandBuffer", as_void(begin_commands)},
                         {"vkCmdDispatch", as_void(dispatch)},
                         {"vkCmdDispatchIndirect", as_void(dispatch_indirect)},
                         {"vkCmdCopyBuffer", as_void(copy_buffer)},
                         {"vkGetDeviceQueue", as_void(get_queue)},
                         {"vkQueueSubmit", as_void(queue_submit)},
                         {"vkQueueWaitIdle", as_void(queue_wait_idle)},
                         {"vkWaitSemaphores", as_void(wait_semaphores)}};
    return found_in(all, name);
}

PFN_vkVoidFunction own_of_instance(std::string_view name) {
    const Named all[] = {{"vkCreateInstance", as_void(create_instance)},
                         {"vkCreateDevice", as_void(create_device)},
                         {"vkGetPhysicalDeviceProperties", as_void(get_properties)},
                         {"vkGetPhysicalDeviceProperties2", as_void(get_properties_2)},
                         {"vkGetPhysicalDeviceFeatures2", as_void(get_features_2)},
                         {"vkGetPhysicalDeviceQueueFamilyProperties", as_void(get_queue_families)},
                         {"vkGetPhysicalDeviceMemoryProperties", as_void(get_memory_properties)}};
    return found_in(all, name);
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL
burin_posing_get_device(VkDevice device, const char* name) {
    if (std::string_view(name) == "vkGetDeviceProcAddr") return as_void(burin_posing_get_device);
    if (const auto own = own_of_device(name); own != nullptr) return own;
    const Lock lock(g_mutex);
    return state_of(device).get(device, name);
}

__attribute__((visibility("default"))) VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL
burin_posing_get_instance(VkInstance instance, const char* name) {
    if (std::string_view(name) == "vkGetInstanceProcAddr") return as_void(burin_posing_get_instance);
    if (std::string_view(name) == "vkGetDeviceProcAddr") return as_void(burin_posing_get_device);
    if (const auto own = own_of_instance(name); own != nullptr) return own;
    if (const auto own = own_of_device(name); own != nullptr) return own;
    return g_next_of_instance != nullptr ? g_next_of_instance(instance, name) : nullptr;
}

}  // extern "C"
